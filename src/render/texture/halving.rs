//! From one level of a mip chain to the next.

use super::lerp::{lerp, lerp_f32, mean_row};
use super::srgb::{ENCODER, linear};

/// How a level of a mip chain follows from the one above it: that is read with a bilinear filter at the centres of fewer
/// pixels.
pub(super) struct Halving {
    columns: Vec<(usize, usize, u32)>,
    rows: Vec<(usize, usize, u32)>,
    /// Both sides are exactly half as long, so that four pixels mix evenly.
    even: bool,
    srgb: bool,
}

impl Halving {
    /// From an image of these columns and rows to one with fewer.
    pub fn new(from: [usize; 2], to: [usize; 2], srgb: bool) -> Self {
        Halving {
            columns: taps(from[0], to[0]),
            rows: taps(from[1], to[1]),
            even: from == to.map(|side| 2 * side),
            srgb,
        }
    }

    /// Computes one row from the rows of the level above.
    pub fn row<'a>(&self, y: usize, source: impl Fn(usize) -> &'a [u32], out: &mut [u32]) {
        let (upper, lower, weight_y) = self.rows[y];
        let (upper, lower) = (source(upper), source(lower));
        if self.even && !self.srgb {
            return mean_row(out, upper, lower);
        }
        for (pixel, &(left, right, weight_x)) in out.iter_mut().zip(&self.columns) {
            let texels = [upper[left], upper[right], lower[left], lower[right]];
            let weights = [weight_x, weight_y];
            *pixel = if self.srgb { mix_srgb(texels, weights) } else { mix(texels, weights) };
        }
    }
}

fn mix([a, b, c, d]: [u32; 4], [x, y]: [u32; 2]) -> u32 {
    lerp(lerp(a, b, x), lerp(c, d, x), y)
}

fn mix_srgb(texels: [u32; 4], weights: [u32; 2]) -> u32 {
    let [a, b, c, d] = texels.map(linear);
    let [x, y] = weights.map(|weight| weight as f32 * (1.0 / 256.0));
    let [r, g, b, alpha] = lerp_f32(lerp_f32(a, b, x), lerp_f32(c, d, x), y);
    let encoder = &*ENCODER;
    let alpha = (alpha * 255.0 + 0.5) as u8;
    u32::from_le_bytes([encoder.byte(r), encoder.byte(g), encoder.byte(b), alpha])
}

/// Which two pixels of a row of `from` a pixel of the row of `to` below it in a mip chain mixes, and the weight of the
/// second in 1/256: the source is read at the pixel's centre, so odd lengths mix unevenly.
fn taps(from: usize, to: usize) -> Vec<(usize, usize, u32)> {
    let tap = |x: usize| {
        let place = ((2 * x + 1) * from * 256 + to) / (2 * to) - 128;
        (place >> 8, ((place >> 8) + 1).min(from - 1), (place & 255) as u32)
    };
    (0..to).map(tap).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halving_of_even_rows_mixes_pairs_and_of_odd_rows_unevenly() {
        assert_eq!(taps(4, 2), [(0, 1, 128), (2, 3, 128)]);
        assert_eq!(taps(3, 1), [(1, 2, 0)]);
        assert_eq!(taps(5, 2), [(0, 1, 192), (3, 4, 64)]);
        assert_eq!(taps(1, 1), [(0, 0, 0)]);
    }
}
