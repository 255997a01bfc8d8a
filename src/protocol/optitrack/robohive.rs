//! The packet of RoboHive's OptiTrack server: one datagram of nine single-precision numbers a frame, in the byte order of the
//! machine that sends them, which is little-endian on all that are in use: time, id, x, y, z, and the quaternion w-x-y-z.

use super::Body;

/// Bytes of a packet.
pub const SIZE: usize = 36;

/// A packet.
pub fn encode(time: f64, body: &Body) -> [u8; SIZE] {
    let [x, y, z] = body.position;
    let [qw, qx, qy, qz] = body.orientation;
    let mut bytes = [0; SIZE];
    let values = [time, f64::from(body.id), x, y, z, qw, qx, qy, qz];
    for (place, value) in bytes.chunks_exact_mut(4).zip(values) {
        place.copy_from_slice(&(value as f32).to_le_bytes());
    }
    bytes
}

/// The time and the body of a packet; `None` for datagrams of another length, and for numbers that are not finite.
pub fn decode(bytes: &[u8]) -> Option<(f64, Body)> {
    let bytes: &[u8; SIZE] = bytes.try_into().ok()?;
    let mut values = [0.0; 9];
    for (value, four) in values.iter_mut().zip(bytes.chunks_exact(4)) {
        *value = f64::from(f32::from_le_bytes(four.try_into().ok()?));
    }
    let [time, id, x, y, z, qw, qx, qy, qz] = values;
    let body =
        Body { id: id as i32, position: [x, y, z], orientation: [qw, qx, qy, qz], error: 0.0, tracked: true };
    values.iter().all(|value| value.is_finite()).then_some((time, body))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_packet_comes_back_in_single_precision() {
        let body = Body {
            id: 3,
            position: [0.5, -0.25, 1.75],
            orientation: [0.5, -0.5, 0.5, 0.5],
            error: 0.0,
            tracked: true,
        };
        let bytes = encode(12.125, &body);
        assert_eq!(bytes[..8], [0x00, 0x00, 0x42, 0x41, 0x00, 0x00, 0x40, 0x40]);
        assert_eq!(decode(&bytes), Some((12.125, body)));
        assert_eq!(decode(&bytes[..35]), None);
        assert_eq!(decode(&encode(f64::NAN, &body)), None);
    }
}
