//! The arctangent in single precision as the C library of the reference computes it (FreeBSD's and Sun's fdlibm: reduction
//! to five intervals, then an odd polynomial). Rounding the double-precision one differs in the last bit of every fifth.

use std::f32::consts::{FRAC_PI_2, PI};

/// Coefficients of the even powers of the argument's square, and of the odd ones, lowest first.
const EVEN: [f32; 6] = [0.333_333_34, 0.142_857_15, 0.090_908_87, 0.066_610_73, 0.049_768_78, 0.016_285_82];
const ODD: [f32; 5] = [-0.2, -0.111_111_104, -0.076_918_76, -0.058_335_703, -0.036_531_57];

/// What is left of pi beyond single precision, negative.
const PI_REST: f32 = -8.742_278e-8;

/// The angle of the point `(x, y)` for positive `y`.
pub(super) fn arctangent2(y: f32, x: f32) -> f32 {
    if x == 0.0 {
        return FRAC_PI_2;
    }
    let acute = arctangent((y / x).abs());
    if x > 0.0 { acute } else { PI - (acute - PI_REST) }
}

/// The arctangent of a number that is not negative.
fn arctangent(x: f32) -> f32 {
    // An angle that is near, as a sum of two numbers, and the tangent of what is left.
    let (t, near) = match x {
        _ if x < 0.4375 => (x, None),
        _ if x < 0.6875 => ((2.0 * x - 1.0) / (2.0 + x), Some((0.463_647_6, 5.012_158_2e-9))),
        _ if x < 1.1875 => ((x - 1.0) / (x + 1.0), Some((0.785_398_1, 3.774_894_7e-8))),
        _ if x < 2.4375 => ((x - 1.5) / (1.0 + 1.5 * x), Some((0.982_793_7, 3.447_321_7e-8))),
        _ => (-1.0 / x, Some((1.570_796_3, 7.549_789_4e-8))),
    };
    let square = t * t;
    let fourth = square * square;
    let sum = |terms: &[f32]| terms.iter().rev().fold(0.0, |sum, term| term + fourth * sum);
    let correction = t * (square * sum(&EVEN) + fourth * sum(&ODD));
    match near {
        None => t - correction,
        Some((angle, rest)) => angle - ((correction - rest) - t),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_of_view_are_those_that_the_reference_computed() {
        // Half a sensor, focal length, field of view in degrees, as bits.
        let recorded: [(u32, u32, u64); 3] = [
            (1_019_403_159, 1_027_767_904, 4_632_686_287_381_100_111),
            (1_009_917_536, 1_017_934_522, 4_632_884_938_285_835_378),
            (983_173_419, 1_021_326_580, 4_617_222_559_756_009_259),
        ];
        for (half, focal, fovy) in recorded {
            let angle = arctangent2(f32::from_bits(half), f32::from_bits(focal));
            let degrees = f64::from(angle) * 360.0 / std::f64::consts::PI;
            assert_eq!(degrees.to_bits(), fovy);
        }
    }

    #[test]
    fn angles_are_those_of_the_double_precision_function_within_two_roundings() {
        let mut differing = 0;
        for k in 1..20_000 {
            let (y, x) = (k as f32 * 0.37, (7_919 * k % 20_011) as f32 - 9_000.0);
            let exact = f64::from(y).atan2(f64::from(x));
            let single = arctangent2(y, x);
            let spacing = f64::from(f32::from_bits(single.to_bits() + 1) - single);
            assert!((f64::from(single) - exact).abs() <= 2.0 * spacing, "{y} {x}");
            differing += u32::from(single != exact as f32);
        }
        assert!((500..8000).contains(&differing), "{differing}");
    }
}
