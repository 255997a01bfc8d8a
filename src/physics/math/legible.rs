//! Numbers in messages.

use std::fmt::{self, Display, LowerExp};

/// Characters above which a number is shown in powers of ten.
const LONG: usize = 15;

/// A number as a reader takes it in, and as it reads back: `0.002`, and `1e300` in place of three hundred digits.
#[derive(Clone, Copy, Debug)]
pub struct Legible<T>(pub T);

impl<T: Display + LowerExp> Display for Legible<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (plain, scientific) = (self.0.to_string(), format!("{:e}", self.0));
        f.pad(if plain.len() > LONG && scientific.len() < plain.len() { &scientific } else { &plain })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_are_powers_of_ten() {
        for (x, text) in [
            (-0.002, "-0.002"),
            (1e7, "10000000"),
            (0.1 + 0.2, "0.30000000000000004"),
            (1e300, "1e300"),
            (-1e-20, "-1e-20"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(Legible(x).to_string(), text);
        }
        assert_eq!(format!("{:>6}|{}", Legible(5.0_f32), Legible(f64::NEG_INFINITY)), "     5|-inf");
    }
}
