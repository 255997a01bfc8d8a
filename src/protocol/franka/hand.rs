//! The hand: a server of its own, version 3, whose header has 10 bytes.

use super::command::double;

/// Version of the hand's interface.
pub const VERSION: u16 = 3;
/// Bytes of a state.
pub const STATE: usize = 23;
/// Widths that a grasped object may differ from what was asked for \[m\].
pub const EPSILON: f64 = 0.005;

/// Commands, as their number.
pub mod command {
    #![allow(missing_docs)]
    pub const CONNECT: u16 = 0;
    pub const HOMING: u16 = 1;
    pub const GRASP: u16 = 2;
    pub const MOVE: u16 = 3;
    pub const STOP: u16 = 4;
}

/// How a command ended, as its number.
pub mod status {
    #![allow(missing_docs)]
    pub const SUCCESS: u16 = 0;
    pub const FAIL: u16 = 1;
    pub const UNSUCCESSFUL: u16 = 2;
    pub const ABORTED: u16 = 3;
}

/// Appends a message to `out`: a request, or a reply whose payload begins with its status.
pub fn encode(out: &mut Vec<u8>, command: u16, id: u32, payload: &[u8]) {
    out.extend(command.to_le_bytes());
    out.extend(id.to_le_bytes());
    out.extend((10 + payload.len() as u32).to_le_bytes());
    out.extend(payload);
}

/// Numbers of a payload.
pub fn numbers<const N: usize>(payload: &[u8]) -> Option<[f64; N]> {
    if payload.len() != 8 * N {
        return None;
    }
    let mut values = [0.0; N];
    for (k, value) in values.iter_mut().enumerate() {
        *value = double(payload, 8 * k)?;
    }
    Some(values)
}

/// Numbers as a payload: of a grasp width, inner and outer epsilon, speed, force; of a motion width, speed.
pub fn payload(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// What a hand says of itself.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Number of the message.
    pub message: u32,
    /// Distance of the fingers \[m\].
    pub width: f64,
    /// Largest distance; 0 before homing \[m\].
    pub max_width: f64,
    /// It holds something.
    pub grasped: bool,
    /// Temperature \[°C\].
    pub temperature: u16,
}

impl State {
    /// The datagram.
    pub fn encode(&self) -> Vec<u8> {
        let mut out = Vec::with_capacity(STATE);
        out.extend(self.message.to_le_bytes());
        out.extend(self.width.to_le_bytes());
        out.extend(self.max_width.to_le_bytes());
        out.push(u8::from(self.grasped));
        out.extend(self.temperature.to_le_bytes());
        out
    }

    /// Reads a datagram; `None` where its length is another.
    pub fn decode(bytes: &[u8]) -> Option<State> {
        if bytes.len() != STATE {
            return None;
        }
        Some(State {
            message: u32::from_le_bytes(bytes[..4].try_into().ok()?),
            width: double(bytes, 4)?,
            max_width: double(bytes, 12)?,
            grasped: bytes[20] != 0,
            temperature: u16::from_le_bytes([bytes[21], bytes[22]]),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::franka::Decoder;

    #[test]
    fn messages_and_states_lie_where_they_should_and_come_back() {
        let mut bytes = Vec::new();
        encode(&mut bytes, command::MOVE, 9, &payload(&[0.04, 0.1]));
        assert_eq!(bytes[..10], [3, 0, 9, 0, 0, 0, 26, 0, 0, 0]);
        let mut decoder = Decoder::hand();
        decoder.push(&bytes);
        let frame = decoder.next_frame().unwrap().unwrap();
        assert_eq!((frame.command, frame.id, numbers::<2>(frame.payload)), (3, 9, Some([0.04, 0.1])));
        let state = State { message: 5, width: 0.03, max_width: 0.08, grasped: true, temperature: 0x0102 };
        let bytes = state.encode();
        assert_eq!((bytes.len(), bytes[0], bytes[20], bytes[21], bytes[22]), (23, 5, 1, 2, 1));
        assert_eq!(bytes[12..20], 0.08_f64.to_le_bytes());
        assert_eq!(State::decode(&bytes), Some(state));
        assert_eq!(State::decode(&bytes[1..]), None);
    }
}
