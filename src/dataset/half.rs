//! Half-precision numbers, IEEE 754 binary16, which numpy calls float16.
//!
//! ```
//! use robohive_dataset::F16;
//!
//! // Eleven bits hold a third to three digits.
//! let third = F16::from_f64(1.0 / 3.0).to_f64();
//! assert!(third != 1.0 / 3.0 && (third - 1.0 / 3.0).abs() < 2e-4);
//! ```

/// A half-precision number: its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct F16(pub u16);

const SIGN: u16 = 0x8000;
const INFINITY: u16 = 0x7c00;
const NAN: u16 = 0x7e00;

/// Half of the distance from the largest finite number to the next power of two rounds to infinity.
const OVERFLOW: f64 = 65520.0;

impl F16 {
    /// The nearest half-precision number; of two equally near ones the even one. From 65520 on that is infinity.
    pub fn from_f64(x: f64) -> Self {
        let sign = if x.is_sign_negative() { SIGN } else { 0 };
        let size = x.abs();
        let bits = if x.is_nan() {
            NAN
        } else if size >= OVERFLOW {
            INFINITY
        } else if size < 2f64.powi(-14) {
            // Multiples of the smallest subnormal number; 1024 of them are the bits of the first normal one.
            (size * 2f64.powi(24)).round_ties_even() as u16
        } else {
            let exponent = (size.to_bits() >> 52) as i32 - 1023;
            let fraction = ((size * 2f64.powi(-exponent) - 1.0) * 1024.0).round_ties_even() as u16;
            // A fraction that rounds up to one carries into the exponent.
            (((exponent + 15) as u16) << 10) + fraction
        };
        F16(sign | bits)
    }

    /// The same number in double precision.
    pub fn to_f64(self) -> f64 {
        let (exponent, fraction) = (i32::from(self.0 >> 10 & 31), f64::from(self.0 & 1023));
        let size = match exponent {
            0 => fraction * 2f64.powi(-24),
            31 if fraction > 0.0 => f64::NAN,
            31 => f64::INFINITY,
            _ => (1.0 + fraction / 1024.0) * 2f64.powi(exponent - 15),
        };
        if self.0 & SIGN == 0 { size } else { -size }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_half_survives_double_precision() {
        for bits in 0..=u16::MAX {
            let half = F16(bits);
            if half.to_f64().is_nan() {
                assert!(F16::from_f64(half.to_f64()).to_f64().is_nan());
            } else {
                assert_eq!(F16::from_f64(half.to_f64()), half, "{bits:#x}");
            }
        }
    }

    #[test]
    fn ties_go_to_the_even_neighbour() {
        for bits in 0..INFINITY - 1 {
            let (low, high) = (F16(bits).to_f64(), F16(bits + 1).to_f64());
            let middle = 0.5 * (low + high);
            assert_eq!(F16::from_f64(middle).0, bits + (bits & 1), "between {low} and {high}");
            assert_eq!(F16::from_f64(middle.next_up()).0, bits + 1);
            assert_eq!(F16::from_f64(-middle.next_down()).0, bits | SIGN);
        }
    }

    #[test]
    fn the_ends_of_the_range_are_known() {
        assert_eq!(F16::from_f64(65504.0).0, 0x7bff);
        assert_eq!(F16::from_f64(65519.999).0, 0x7bff);
        assert_eq!(F16::from_f64(65520.0).0, INFINITY);
        assert_eq!(F16::from_f64(f64::NEG_INFINITY).0, INFINITY | SIGN);
        assert_eq!(F16::from_f64(1.0).0, 0x3c00);
        assert_eq!(F16::from_f64(5e-324).0, 0);
        assert_eq!(F16::from_f64(-0.0).0, SIGN);
    }
}
