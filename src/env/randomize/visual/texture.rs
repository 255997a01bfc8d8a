//! Patterns that replace the pixels of a texture.

use super::config::Pattern;
use crate::draws::Rng;
use physics::Model;

/// What a texture is filled with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fill {
    pattern: Pattern,
    colors: [[f64; 3]; 2],
    /// Squares of a checker along a side.
    squares: usize,
    seed: u64,
}

impl Fill {
    /// From the values of a dial: the number of the pattern, both colours, squares, seed.
    pub fn of(values: &[f64]) -> Self {
        let color = |first: usize| std::array::from_fn(|k| values[first + k]);
        let pattern = Pattern::ALL[(values[0] as usize).min(Pattern::ALL.len() - 1)];
        Fill {
            pattern,
            colors: [color(1), color(4)],
            squares: (values[7] as usize).max(1),
            seed: values[8] as u64,
        }
    }
}

/// Replaces the pixels of a texture, face by face where it is a cube with six of them. Opacity stays.
pub(super) fn fill(model: &Model, texture: usize, fill: &Fill, data: &mut [u8]) {
    let size = |side: i32| usize::try_from(side).unwrap_or(0);
    let (rows, columns) = (size(model.tex_height[texture]), size(model.tex_width[texture]));
    let channels = size(model.tex_nchannel[texture]);
    let first = usize::try_from(model.tex_adr[texture]).unwrap_or(usize::MAX);
    let Some(pixels) = first.checked_add(rows * columns * channels).and_then(|end| data.get_mut(first..end))
    else {
        return;
    };
    let face = if columns > 0 && rows == 6 * columns { columns } else { rows };
    let mut rng = Rng::pcg64(fill.seed);
    for (k, pixel) in pixels.chunks_exact_mut(channels.max(1)).enumerate() {
        let (row, column) = (k / columns % face, k % columns);
        let share = match fill.pattern {
            Pattern::Color => 0.0,
            Pattern::Checker => ((row * fill.squares / face + column * fill.squares / columns) % 2) as f64,
            Pattern::Gradient => row as f64 / (face - 1).max(1) as f64,
            Pattern::Noise => rng.random(),
        };
        let color = |c: usize| fill.colors[0][c] + share * (fill.colors[1][c] - fill.colors[0][c]);
        for (c, byte) in pixel.iter_mut().enumerate().take(3) {
            *byte = (255.0 * color(c)).round() as u8;
        }
    }
}
