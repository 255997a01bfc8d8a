//! Levels of detail.

/// Half the logarithm to base 2 of a square, so the logarithm of its root, by straight lines between powers of 2: at
/// most 0.043 below the true one. Mesa selects mip levels by it.
#[inline]
pub(super) fn log2_of_root(square: f32) -> f32 {
    const MANTISSA: u32 = 0x007f_ffff;
    let bits = square.to_bits();
    let exponent = ((bits >> 23) & 0xff) as i32 - 127;
    let mantissa = f32::from_bits(bits & MANTISSA | 0x3f80_0000);
    0.5 * (exponent as f32 + (mantissa - 1.0))
}

/// Level of detail of a footprint whose sides along x and y are these many texels.
#[inline]
pub(super) fn of_footprint(dx: [f32; 2], dy: [f32; 2]) -> f32 {
    let square = |v: [f32; 2]| v[0] * v[0] + v[1] * v[1];
    log2_of_root(square(dx).max(square(dy)))
}

/// The finer of two neighbouring levels and the weight of the coarser one; `last` is the coarsest there is.
#[inline]
pub(super) fn split(lod: f32, last: usize) -> (usize, f32) {
    if lod <= 0.0 || lod.is_nan() {
        return (0, 0.0);
    }
    let level = lod as usize;
    if level >= last { (last, 0.0) } else { (level, lod - level as f32) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_is_exact_at_powers_of_two_grows_and_stays_within_its_error() {
        let mut before = f32::NEG_INFINITY;
        for i in 1..4000 {
            let length = i as f32 * 0.01;
            let lod = log2_of_root(length * length);
            let error = f64::from(length).log2() - f64::from(lod);
            assert!((-1e-6..0.0431).contains(&error), "{length}: {error}");
            assert!(lod >= before);
            before = lod;
        }
        for power in -3..12 {
            assert_eq!(log2_of_root(4f32.powi(power)), power as f32);
        }
    }

    #[test]
    fn footprints_take_their_longer_side() {
        assert_eq!(of_footprint([4.0, 0.0], [0.0, 1.0]), 2.0);
        assert_eq!(of_footprint([0.0, 1.0], [0.0, -8.0]), 3.0);
        assert_eq!(of_footprint([3.0, 4.0], [0.0, 0.0]), of_footprint([5.0, 0.0], [0.0, 0.0]));
    }

    #[test]
    fn levels_end_at_the_coarsest() {
        assert_eq!(split(-1.0, 3), (0, 0.0));
        assert_eq!(split(f32::NAN, 3), (0, 0.0));
        assert_eq!(split(1.25, 3), (1, 0.25));
        assert_eq!(split(3.5, 3), (3, 0.0));
        assert_eq!(split(f32::INFINITY, 3), (3, 0.0));
    }
}
