//! Powers of numbers from 0 to 1, eight at a time, the same bits everywhere: highlights need one a corner and light.

use wide::bytemuck::cast;
use wide::{f32x8, i32x8};

/// `x` to the power of `exponent`, for `x` from 0 to 1 and an exponent above 0, else 1; relative error below 1e-6 times the
/// exponent.
pub fn power(x: f32x8, exponent: f32) -> f32x8 {
    if exponent.is_nan() || exponent <= 0.0 {
        return f32x8::ONE;
    }
    let tiny = x.simd_lt(f32x8::splat(1e-20));
    tiny.select(f32x8::ZERO, exp2(log2(x) * f32x8::splat(exponent)))
}

/// Logarithm to base 2 of positive normal numbers: the exponent of the float, and an odd series in (m - 1) / (m + 1) for the
/// mantissa m between sqrt(1/2) and sqrt(2).
fn log2(x: f32x8) -> f32x8 {
    const SQRT_HALF: i32 = 0x3f35_04f3;
    let bits: i32x8 = cast(x);
    let shifted = bits - i32x8::splat(SQRT_HALF);
    let exponent = shifted >> 23;
    let mantissa: f32x8 = cast((shifted & i32x8::splat(0x007f_ffff)) + i32x8::splat(SQRT_HALF));
    let t = (mantissa - f32x8::ONE) / (mantissa + f32x8::ONE);
    let s = t * t;
    // 2 / ln 2 times 1, 1/3, 1/5, 1/7, 1/9.
    let series = [2.0 * std::f32::consts::LOG2_E, 0.961_796_7, 0.577_078_04, 0.412_198_6, 0.320_598_9];
    let sum = series.iter().rev().fold(f32x8::ZERO, |sum, &c| sum * s + f32x8::splat(c));
    f32x8::from_i32x8(exponent) + t * sum
}

/// 1.5 * 2^23: adding it rounds to an integer on every machine alike, which the conversions of vectors do not.
const ROUND: f32 = 12_582_912.0;

/// 2 to the power of `x`, for `x` of at most 0; 0 below -126.
fn exp2(x: f32x8) -> f32x8 {
    let least = f32x8::splat(-126.0);
    let small = x.simd_lt(least);
    let x = x.simd_gt(least).select(x, least);
    // The sum is a whole number, ties to even, in its lowest bits.
    let sum = x + f32x8::splat(ROUND);
    let whole = sum - f32x8::splat(ROUND);
    let rest = x - whole;
    // Taylor series of 2^rest, |rest| <= 1/2.
    let series = [
        1.0,
        std::f32::consts::LN_2,
        0.240_226_51,
        0.055_504_11,
        0.009_618_129,
        0.001_333_355_8,
        0.000_154_035_3,
    ];
    let power = series.iter().rev().fold(f32x8::ZERO, |sum, &c| sum * rest + f32x8::splat(c));
    let exponent = cast::<f32x8, i32x8>(sum) - i32x8::splat(ROUND.to_bits() as i32 - 127);
    let scale: f32x8 = cast(exponent << 23);
    small.select(f32x8::ZERO, power * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_those_of_double_precision() {
        for i in 1..=1000 {
            let x = i as f32 / 1000.0;
            for exponent in [1e-6, 0.5, 1.0, 7.3, 64.0, 128.0] {
                let found = f64::from(power(f32x8::splat(x), exponent).to_array()[3]);
                let expected = f64::from(x).powf(f64::from(exponent));
                assert!((found - expected).abs() <= 1e-6 * (1.0 + f64::from(exponent)) * expected + 1e-30);
            }
        }
    }

    #[test]
    fn the_ends_are_exact() {
        assert_eq!(power(f32x8::ZERO, 3.0), f32x8::ZERO);
        assert_eq!(power(f32x8::ZERO, 0.0), f32x8::ONE);
        assert_eq!(power(f32x8::ONE, 100.0), f32x8::ONE);
    }
}
