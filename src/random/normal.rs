//! Normal draws: the ziggurat of `Generator` (Marsaglia, Tsang, "The ziggurat method for generating random
//! variables", 2000) and the polar method of the legacy functions (Marsaglia, Bray, 1964).

use crate::logarithm::{log, log_one_minus};
use crate::ziggurat::LAYERS;
use crate::{BitGenerator, RandomError};

/// Where the tail begins, which the base layer carries.
const TAIL: f64 = 3.6541528853610088;
/// 1 / [`TAIL`].
const TAIL_SCALE: f64 = 0.27366123732975828;

/// A normal distribution.
#[derive(Clone, Copy)]
pub(crate) struct Normal {
    mean: f64,
    scale: f64,
}

impl Normal {
    pub fn new(mean: f64, scale: f64) -> Result<Self, RandomError> {
        if scale.is_nan() || scale.is_sign_negative() {
            return Err(RandomError::BadScale { scale });
        }
        Ok(Normal { mean, scale })
    }

    /// The draw that a standard normal draw becomes.
    pub fn of_standard(self, draw: f64) -> f64 {
        self.mean + self.scale * draw
    }
}

/// A standard normal draw by the ziggurat.
///
/// The low eight bits choose the layer, the next one the sign, 52 more the place within the layer. Only next
/// to the curve is the density itself computed, with an error that changes a decision once in about 10¹⁵ of
/// them.
#[inline]
pub(crate) fn ziggurat(source: &mut impl BitGenerator) -> f64 {
    loop {
        let word = source.next_u64();
        let index = (word & 0xff) as usize;
        let place = word >> 9 & ((1 << 52) - 1);
        let layer = &LAYERS[index];
        let size = place as f64 * layer.scale;
        let x = if word >> 8 & 1 == 1 { -size } else { size };
        if place < layer.inside {
            return x;
        }
        if index == 0 {
            let size = TAIL + beyond_tail(source);
            return if place >> 8 & 1 == 1 { -size } else { size };
        }
        let height = (LAYERS[index - 1].height - layer.height) * source.next_f64() + layer.height;
        if height < libm::exp(-0.5 * x * x) {
            return x;
        }
    }
}

/// How far a draw from the tail lies beyond its beginning (Marsaglia 1964): exponential draws, thinned out.
#[cold]
fn beyond_tail(source: &mut impl BitGenerator) -> f64 {
    loop {
        let distance = -TAIL_SCALE * log_one_minus(source.next_f64());
        let bound = -log_one_minus(source.next_f64());
        if bound + bound > distance * distance {
            return distance;
        }
    }
}

/// Two standard normal draws by the polar method, in the order in which they are given out.
pub(crate) fn polar(source: &mut impl BitGenerator) -> [f64; 2] {
    loop {
        let [x, y] = std::array::from_fn(|_| 2.0 * source.next_f64() - 1.0);
        let square = x * x + y * y;
        if square < 1.0 && square != 0.0 {
            let factor = (-2.0 * log(square) / square).sqrt();
            return [factor * y, factor * x];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of the ziggurat are what its definition says, within what floating point loses.
    #[test]
    fn layers_have_equal_areas() {
        const UNIT: f64 = (1_u64 << 52) as f64;
        let width = |k: usize| LAYERS[k].scale * UNIT;
        let area = width(0) * LAYERS[255].height;
        assert_eq!(width(255), TAIL);
        for k in 1..256 {
            let (layer, x) = (&LAYERS[k], width(k));
            assert!((layer.height - libm::exp(-0.5 * x * x)).abs() < 1e-15, "layer {k}");
            let below = if k == 1 { 1.0 } else { LAYERS[k - 1].height };
            assert!((x * (below - layer.height) - area).abs() < 1e-14, "layer {k}");
            let inner = if k == 1 { 0.0 } else { width(k - 1) };
            assert!((layer.inside as f64 / UNIT - inner / x).abs() < 1e-14, "layer {k}");
        }
        assert!((LAYERS[0].inside as f64 / UNIT - TAIL / width(0)).abs() < 1e-14);
    }
}
