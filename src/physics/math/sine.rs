//! Sine and cosine, correctly rounded in all but six calls of a million (measured by `examples/sines.rs`): the result
//! is computed with some fifteen bits more than an f64 has, then rounded once.
//!
//! The angle is reduced to `k π/256 + r`, `|r| ≤ π/512`; a table holds the sines of the multiples, Taylor's series
//! does the rest (Tang 1991, "Table-lookup algorithms for elementary functions and their error analysis").

use super::double_double::{Double, ordered_sum, split};

/// Multiples of π/256 in a quarter turn.
const QUARTER: usize = 128;
/// π/2.
const HALF_PI: Double = Double { head: std::f64::consts::FRAC_PI_2, tail: 6.123233995736766e-17 };
/// π/256 in three parts. The first two have 32 bits each, so that their products with the number of a multiple are exact.
const STEP: [f64; 3] = [0.012271846302610356, 4.747734770549973e-13, 1.5798955068718364e-23];
/// 256/π.
const STEPS_PER_RADIAN: f64 = 81.48733086305042;
/// Angles beyond it are reduced by `libm`, whose results are within one unit of the last place.
pub(super) const LARGEST: f64 = 2.0e4;

/// Sines of the multiples of π/256 in a quarter turn, the head with at most 26 bits.
static SINES: [Double; QUARTER + 1] = sines();

const fn sines() -> [Double; QUARTER + 1] {
    let mut table = [Double { head: 0.0, tail: 0.0 }; QUARTER + 1];
    let mut k = 1;
    while k <= QUARTER {
        let turn = HALF_PI.times(Double { head: k as f64 / QUARTER as f64, tail: 0.0 });
        let sine = taylor_sine(turn);
        let [head, rest] = split(sine.head);
        table[k] = Double { head, tail: rest + sine.tail };
        k += 1;
    }
    table
}

const fn taylor_sine(x: Double) -> Double {
    let square = x.times(x).negated();
    let (mut term, mut sum) = (x, x);
    let mut n = 2.0;
    while n < 40.0 {
        term = term.times(square).over(n * (n + 1.0));
        sum = sum.plus(term);
        n += 2.0;
    }
    sum
}

/// Sine and cosine.
pub fn sincos(x: f64) -> (f64, f64) {
    if x.abs() <= LARGEST {
        let [sine, cosine] = precise_sincos(x);
        (sine.round(), cosine.round())
    } else {
        libm::sincos(x)
    }
}

/// Sine and cosine with errors below 2^-67, for angles up to [`LARGEST`].
#[inline]
pub(super) fn precise_sincos(x: f64) -> [Double; 2] {
    let (multiple, r) = reduce(x.abs());
    let k = multiple % QUARTER;
    let (s, c) = (SINES[k], SINES[QUARTER - k]);

    // sin r = r + odd, cos r = 1 + even, as far as r^7 reaches beyond the bits that are kept.
    let square = r.head * r.head;
    let odd = r.head * square * (-1.0 / 6.0 + square * (1.0 / 120.0 + square * (-1.0 / 5040.0)));
    let even = square * (-0.5 + square * (1.0 / 24.0 + square * (-1.0 / 720.0)));
    let [r0, r1] = split(r.head);
    let rest = r1 + r.tail;
    // s cos r + c sin r, and with s and c exchanged. Products of heads are exact; all others are small.
    let (whole_s, whole_c) = (s.round(), c.round());
    let sine = ordered_sum(s.head, c.head * r0)
        .extended(s.tail + (c.head * rest + c.tail * r.head + (whole_s * even + whole_c * odd)));
    let cosine = ordered_sum(c.head, -(s.head * r0))
        .extended(c.tail - (s.head * rest + s.tail * r.head + (whole_s * odd - whole_c * even)));
    let [sine, cosine] = match multiple / QUARTER % 4 {
        0 => [sine, cosine],
        1 => [cosine, sine.negated()],
        2 => [sine.negated(), cosine.negated()],
        _ => [cosine.negated(), sine],
    };
    [if x < 0.0 { sine.negated() } else { sine }, cosine]
}

/// An angle between zero and [`LARGEST`] as a multiple of π/256 and the rest (Cody and Waite 1980).
#[inline]
fn reduce(x: f64) -> (usize, Double) {
    const SHIFT: f64 = 6_755_399_441_055_744.0; // 1.5 2^52: adding it leaves the nearest integer in the last bits.
    let shifted = x * STEPS_PER_RADIAN + SHIFT;
    let n = shifted - SHIFT;
    let near = ordered_sum(x - n * STEP[0], -n * STEP[1]);
    ((shifted.to_bits() & 0xffff_ffff) as usize, near.extended(-n * STEP[2]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values computed with 300 bits and rounded, where a result within one unit of the last place may be another.
    #[test]
    fn hard_values_are_correctly_rounded() {
        let sine = |x| sincos(x).0;
        let cosine = |x| sincos(x).1;
        for (f, x, expected) in [
            (&sine as &dyn Fn(f64) -> f64, -0.7919999999999998, -0.7117595414043807),
            (&sine, -0.9497999999999998, -0.8132991519039464),
            (&sine, -1.8978, -0.9470090341154946),
            (&sine, 3.1415925, 1.53589793450488e-7),
            (&sine, 1234.5, 0.14539565052293643),
            (&cosine, 0.5958000000000006, 0.8276998268763153),
            (&cosine, 1.5876000000000001, -0.016802882425791893),
            (&cosine, 2.4924, -0.7965721341211842),
        ] {
            assert_eq!(f(x), expected, "{x}");
        }
    }

    /// `sin² + cos² = 1` with each error below 2^-67, in every part of the table and every quadrant.
    #[test]
    fn squares_add_up_to_one() {
        for i in 0..2000 {
            let x = -7.0 + 0.0071 * f64::from(i);
            let zero = Double { head: 0.0, tail: 0.0 };
            let [s, c] = precise_sincos(x).map(|value| zero.plus(value));
            let one = s.times(s).plus(c.times(c));
            assert!(((one.head - 1.0) + one.tail).abs() < 2.0_f64.powi(-65), "{x}");
        }
    }

    #[test]
    fn ends_of_the_domains() {
        assert!(sincos(f64::INFINITY).0.is_nan());
        assert!((sincos(3.0e4).0 - 3.0e4_f64.sin()).abs() < 1e-15);
    }
}
