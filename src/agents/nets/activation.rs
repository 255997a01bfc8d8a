//! What follows the affine map of a hidden layer.
//!
//! Exponentials are our own, of additions and products alone, so that they have the same bits on every machine and the compiler makes vectors of
//! them.

use serde::{Deserialize, Serialize};

/// A function of one number.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[non_exhaustive]
#[serde(rename_all = "snake_case")]
pub enum Activation {
    /// The hyperbolic tangent.
    Tanh,
    /// The positive part.
    Relu,
    /// `x` where it is positive, `exp(x) - 1` elsewhere (Clevert et al., 2016, with α = 1).
    Elu,
}

impl Activation {
    /// Replaces each number by the function of it.
    pub fn apply(self, values: &mut [f32]) {
        match self {
            Activation::Tanh => values.iter_mut().for_each(|value| *value = tanh(*value)),
            // Comparisons are such that a NaN stays one.
            Activation::Relu => values.iter_mut().for_each(|x| *x = if *x < 0.0 { 0.0 } else { *x }),
            Activation::Elu => values.iter_mut().for_each(|x| *x = if *x > 0.0 { *x } else { exp(*x) - 1.0 }),
        }
    }

    /// Multiplies each number of `slopes` by the derivative of the function where its value is that of `values`.
    pub fn scale_by_derivative(self, values: &[f32], slopes: &mut [f32]) {
        let pairs = slopes.iter_mut().zip(values);
        match self {
            Activation::Tanh => pairs.for_each(|(slope, value)| *slope *= 1.0 - value * value),
            Activation::Relu => {
                pairs.for_each(|(slope, value)| *slope *= if *value > 0.0 { 1.0 } else { 0.0 })
            }
            Activation::Elu => {
                pairs.for_each(|(slope, value)| *slope *= if *value > 0.0 { 1.0 } else { value + 1.0 })
            }
        }
    }
}

/// The hyperbolic tangent, within 2e-7.
pub fn tanh(x: f32) -> f32 {
    // Beyond 10 it is ±1 in single precision.
    let doubled = exp(2.0 * x.clamp(-10.0, 10.0));
    1.0 - 2.0 / (doubled + 1.0)
}

/// The exponential, within 3e-7 of its value, from -87 to 88; that of the nearer end beyond.
pub fn exp(x: f32) -> f32 {
    /// Added to a number below 2²², it leaves the nearest integer in the last bits.
    const ROUND: f32 = 12_582_912.0;
    /// The natural logarithm of 2 in two parts, of which multiples of the first are exact.
    const LN_2: [f32; 2] = [0.693_359_375, -2.121_944_4e-4];
    let x = x.clamp(-87.0, 88.0);
    let shifted = x * std::f32::consts::LOG2_E + ROUND;
    let whole = shifted - ROUND;
    let rest = x - whole * LN_2[0] - whole * LN_2[1];
    // The Taylor series, whose next term is below 2e-8 where |rest| ≤ ln 2 / 2.
    let terms = [1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0];
    let series = terms.iter().fold(1.0 / 5040.0, |sum, term| sum * rest + term);
    // The power of two by its exponent; the shift drops what `ROUND` itself has there.
    let power = f32::from_bits((shifted.to_bits() << 23).wrapping_add(127 << 23));
    series * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponentials_are_near_those_of_double_precision() {
        let (mut worst, mut worst_tanh) = (0.0_f64, 0.0_f64);
        for k in -8000..=8000 {
            let x = k as f32 * 0.01;
            let exact = f64::from(x).exp();
            worst = worst.max((f64::from(exp(x)) - exact).abs() / exact);
            worst_tanh = worst_tanh.max((f64::from(tanh(x * 0.2)) - f64::from(x * 0.2).tanh()).abs());
        }
        assert!(worst < 3e-7 && worst_tanh < 2e-7, "{worst:e} {worst_tanh:e}");
        assert_eq!([exp(0.0), tanh(0.0), tanh(50.0), tanh(-50.0)], [1.0, 0.0, 1.0, -1.0]);
        assert!(exp(f32::NAN).is_nan() && tanh(f32::NAN).is_nan(), "a NaN stays one");
    }

    #[test]
    fn derivatives_are_slopes() {
        for activation in [Activation::Tanh, Activation::Relu, Activation::Elu] {
            for x in [-2.5_f32, -0.7, 0.3, 1.9] {
                let step = 1e-2;
                let mut around = [x - step, x + step, x];
                activation.apply(&mut around);
                let mut slope = [1.0];
                activation.scale_by_derivative(&around[2..], &mut slope);
                let difference = (around[1] - around[0]) / (2.0 * step);
                assert!(
                    (slope[0] - difference).abs() < 2e-4,
                    "{activation:?} at {x}: {slope:?} {difference}"
                );
            }
        }
    }
}
