//! sRGB bytes and the linear numbers they stand for.

use physics::math::ops;
use std::sync::LazyLock;

/// Linear numbers of the 256 bytes, by the polynomial that Mesa decodes with; within 0.0012 of the standard's.
static LINEAR: LazyLock<[f32; 256]> = LazyLock::new(|| {
    std::array::from_fn(|byte| {
        let x = byte as f64 / 255.0;
        let linear = match byte {
            0..=15 => x / 12.6,
            _ => 0.0023 + x * (0.003 + x * (0.6935 + x * 0.3012)),
        };
        linear as f32
    })
});

/// The four bytes as linear numbers; the last, opacity, is not encoded.
#[inline]
pub(super) fn linear(packed: u32) -> [f32; 4] {
    let table = &*LINEAR;
    let [r, g, b, a] = packed.to_le_bytes();
    [table[usize::from(r)], table[usize::from(g)], table[usize::from(b)], f32::from(a) * (1.0 / 255.0)]
}

/// Encodes linear numbers from 0 to 1 as the nearest bytes.
pub(super) struct Encoder {
    /// Where the byte `i` gives way to `i + 1`.
    thresholds: [f32; 256],
    /// A byte that is not above the right one, for each of equal steps.
    guesses: [u8; STEPS + 1],
}

const STEPS: usize = 4096;

/// The encoder that the sRGB standard defines.
pub(super) static ENCODER: LazyLock<Encoder> = LazyLock::new(|| {
    let thresholds: [f32; 256] = std::array::from_fn(|byte| match byte {
        255 => f32::INFINITY,
        _ => decode((byte as f64 + 0.5) / 255.0) as f32,
    });
    let guesses = std::array::from_fn(|step| {
        let x = step as f32 / STEPS as f32;
        thresholds.partition_point(|&threshold| threshold <= x) as u8
    });
    Encoder { thresholds, guesses }
});

impl Encoder {
    /// The byte nearest to a linear number from 0 to 1.
    pub fn byte(&self, linear: f32) -> u8 {
        let mut byte = self.guesses[((linear * STEPS as f32) as usize).min(STEPS)];
        while linear >= self.thresholds[usize::from(byte)] {
            byte += 1;
        }
        byte
    }
}

/// IEC 61966-2-1.
fn decode(x: f64) -> f64 {
    match x <= 0.04045 {
        true => x / 12.92,
        false => ops::pow((x + 0.055) / 1.055, 2.4),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decoding_is_near_the_standard_and_grows() {
        for byte in 0..256 {
            let error = f64::from(LINEAR[byte]) - decode(byte as f64 / 255.0);
            assert!(error.abs() < 0.0012, "byte {byte}: {error}");
            assert!(byte == 0 || LINEAR[byte] > LINEAR[byte - 1]);
        }
        assert_eq!(LINEAR[255], 1.0);
    }

    #[test]
    fn encoding_inverts_the_standard() {
        for byte in 0..=255u8 {
            assert_eq!(ENCODER.byte(decode(f64::from(byte) / 255.0) as f32), byte);
        }
    }
}
