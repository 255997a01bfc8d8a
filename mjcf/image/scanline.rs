//! Rows of PNG images: how samples are packed, filtered and widened to bytes.

use crate::asset::AssetError;

/// What the samples of a pixel mean; the values are PNG's colour types.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Color {
    Grey,
    Rgb,
    Palette,
    GreyAlpha,
    RgbAlpha,
}

/// How pixels are stored in a row.
pub(super) struct Layout {
    color: Color,
    /// Bits of a sample: 1, 2, 4, 8 or 16.
    depth: u8,
    /// Colours and opacities that indices stand for.
    palette: Vec<[u8; 4]>,
    /// The pixel that each sample stands for, where a pixel is one sample of at most eight bits.
    colors: Vec<[u8; 4]>,
    /// The colour, in samples as stored, that is transparent.
    transparent: Option<[u16; 3]>,
}

impl Layout {
    /// The layout of a colour type and depth; `None` for pairs that PNG does not define.
    pub(super) fn new(color: u8, depth: u8) -> Option<Self> {
        let (color, depths): (Color, &[u8]) = match color {
            0 => (Color::Grey, &[1, 2, 4, 8, 16]),
            2 => (Color::Rgb, &[8, 16]),
            3 => (Color::Palette, &[1, 2, 4, 8]),
            4 => (Color::GreyAlpha, &[8, 16]),
            6 => (Color::RgbAlpha, &[8, 16]),
            _ => return None,
        };
        depths.contains(&depth).then_some(Layout {
            color,
            depth,
            palette: Vec::new(),
            colors: Vec::new(),
            transparent: None,
        })
    }

    /// Takes the colours of chunk `PLTE`, three bytes each.
    pub(super) fn set_palette(&mut self, data: &[u8]) -> Result<(), AssetError> {
        let (colors, []) = data.as_chunks::<3>() else {
            return Err(AssetError::malformed("the palette ends inside a colour"));
        };
        if colors.len() > 256 {
            return Err(AssetError::malformed("the palette has more than 256 colours"));
        }
        self.palette = colors.iter().map(|&[r, g, b]| [r, g, b, 255]).collect();
        Ok(())
    }

    /// Takes chunk `tRNS`: opacities of the palette, or the one colour that is transparent.
    pub(super) fn set_transparency(&mut self, data: &[u8]) -> Result<(), AssetError> {
        let word = |k: usize| u16::from_be_bytes([data[2 * k], data[2 * k + 1]]);
        match (self.color, data.len()) {
            (Color::Palette, n) if n <= self.palette.len() => {
                self.palette.iter_mut().zip(data).for_each(|(color, &opacity)| color[3] = opacity);
            }
            (Color::Grey, 2) => self.transparent = Some([word(0); 3]),
            (Color::Rgb, 6) => self.transparent = Some([word(0), word(1), word(2)]),
            _ => return Err(AssetError::malformed("the transparency (chunk tRNS) does not fit the colours")),
        }
        Ok(())
    }

    /// Completes the layout once its palette and transparency are known.
    pub(super) fn complete(&mut self) -> Result<(), AssetError> {
        if self.color == Color::Palette && self.palette.is_empty() {
            return Err(AssetError::malformed("the palette (chunk PLTE) is missing"));
        }
        if self.samples() == 1 && self.depth <= 8 {
            // Indices beyond the palette are an error of the file that the standard leaves open: black.
            let color = |sample: u8| match self.color {
                Color::Palette => self.palette.get(usize::from(sample)).copied().unwrap_or([0, 0, 0, 255]),
                _ => {
                    let grey = (u32::from(sample) * 255 / ((1 << self.depth) - 1)) as u8;
                    let opaque = self.transparent.is_none_or(|[clear, ..]| clear != sample.into());
                    [grey, grey, grey, if opaque { 255 } else { 0 }]
                }
            };
            self.colors = (0..1u16 << self.depth).map(|sample| color(sample as u8)).collect();
            self.colors.resize(256, [0; 4]);
        }
        Ok(())
    }

    /// Samples of a pixel.
    fn samples(&self) -> usize {
        match self.color {
            Color::Grey | Color::Palette => 1,
            Color::GreyAlpha => 2,
            Color::Rgb => 3,
            Color::RgbAlpha => 4,
        }
    }

    /// Bytes of a pixel, at least one: the distance over which filters predict.
    pub(super) fn pixel_bytes(&self) -> usize {
        (self.samples() * usize::from(self.depth)).div_ceil(8)
    }

    /// Bytes of a row of `columns` pixels without its filter byte.
    pub(super) fn row_bytes(&self, columns: usize) -> Option<usize> {
        columns.checked_mul(self.samples() * usize::from(self.depth)).map(|bits| bits.div_ceil(8))
    }

    /// Writes the pixels of a row to `out`: the first `channels` of red, green, blue and opacity, the start of each
    /// pixel `stride` bytes after that of the last.
    pub(super) fn expand(&self, row: &[u8], columns: usize, out: &mut [u8], channels: usize, stride: usize) {
        match channels {
            1 => self.expand_to::<1>(row, columns, out, stride),
            3 => self.expand_to::<3>(row, columns, out, stride),
            _ => self.expand_to::<4>(row, columns, out, stride),
        }
    }

    fn expand_to<const N: usize>(&self, row: &[u8], columns: usize, out: &mut [u8], stride: usize) {
        let plain = self.depth == 8 && self.transparent.is_none();
        match self.color {
            Color::Grey | Color::Palette if self.depth == 8 => {
                put::<N>(out, stride, row.iter().map(|&sample| self.colors[usize::from(sample)]));
            }
            Color::Grey | Color::Palette if self.depth < 8 => {
                let color = |column| self.colors[usize::from(self.sample(row, column))];
                put::<N>(out, stride, (0..columns).map(color));
            }
            Color::Rgb | Color::RgbAlpha if plain && self.samples() == N && stride == N => {
                out[..row.len()].copy_from_slice(row);
            }
            Color::GreyAlpha if plain => {
                put::<N>(out, stride, row.as_chunks::<2>().0.iter().map(|&[grey, a]| [grey, grey, grey, a]));
            }
            Color::Rgb if plain => {
                put::<N>(out, stride, row.as_chunks::<3>().0.iter().map(|&[r, g, b]| [r, g, b, 255]));
            }
            Color::RgbAlpha if plain => put::<N>(out, stride, row.as_chunks::<4>().0.iter().copied()),
            _ => put::<N>(out, stride, (0..columns).map(|column| self.color_at(row, column))),
        }
    }

    /// The pixel at `column` of a row of samples of 8 or 16 bits that are no indices.
    fn color_at(&self, row: &[u8], column: usize) -> [u8; 4] {
        let sample = |k: usize| self.sample(row, column * self.samples() + k);
        let byte = |k: usize| if self.depth == 16 { (sample(k) >> 8) as u8 } else { sample(k) as u8 };
        let opacity = |color: [u16; 3]| if self.transparent == Some(color) { 0 } else { 255 };
        match self.color {
            Color::Grey | Color::Palette => [byte(0), byte(0), byte(0), opacity([sample(0); 3])],
            Color::Rgb => [byte(0), byte(1), byte(2), opacity([sample(0), sample(1), sample(2)])],
            Color::GreyAlpha => [byte(0), byte(0), byte(0), byte(1)],
            Color::RgbAlpha => [byte(0), byte(1), byte(2), byte(3)],
        }
    }

    /// Sample `index` of a row.
    fn sample(&self, row: &[u8], index: usize) -> u16 {
        match self.depth {
            16 => u16::from_be_bytes([row[2 * index], row[2 * index + 1]]),
            8 => row[index].into(),
            depth => {
                let bit = index * usize::from(depth);
                // The leftmost pixel stands in the highest bits.
                let shift = 8 - depth - (bit % 8) as u8;
                u16::from(row[bit / 8] >> shift & ((1 << depth) - 1))
            }
        }
    }
}

/// Writes the first `N` bytes of each pixel, `stride` bytes apart.
fn put<const N: usize>(out: &mut [u8], stride: usize, pixels: impl Iterator<Item = [u8; 4]>) {
    for (place, pixel) in out.chunks_mut(stride).zip(pixels) {
        place[..N].copy_from_slice(&pixel[..N]);
    }
}

/// Replaces the differences in `row` by the bytes they were taken of; `above` is the row before, zero for the first.
/// `None` when there is no such filter.
pub(super) fn unfilter(filter: u8, pixel_bytes: usize, above: &[u8], row: &mut [u8]) -> Option<()> {
    match pixel_bytes {
        1 => unfilter_pixels::<1>(filter, above, row),
        2 => unfilter_pixels::<2>(filter, above, row),
        3 => unfilter_pixels::<3>(filter, above, row),
        4 => unfilter_pixels::<4>(filter, above, row),
        6 => unfilter_pixels::<6>(filter, above, row),
        _ => unfilter_pixels::<8>(filter, above, row),
    }
}

fn unfilter_pixels<const N: usize>(filter: u8, above: &[u8], row: &mut [u8]) -> Option<()> {
    match filter {
        0 => {}
        1 => add_predicted::<N>(above, row, |left, _, _| left),
        2 => row.iter_mut().zip(above).for_each(|(x, up)| *x = x.wrapping_add(*up)),
        3 => add_predicted::<N>(above, row, |left, up, _| ((u16::from(left) + u16::from(up)) / 2) as u8),
        4 => add_predicted::<N>(above, row, nearest_gradient),
        _ => return None,
    }
    Some(())
}

/// Adds to each byte what the bytes at its left, above and above at its left predict, `N` bytes a pixel.
#[inline(always)]
fn add_predicted<const N: usize>(above: &[u8], row: &mut [u8], predict: impl Fn(u8, u8, u8) -> u8) {
    let (mut left, mut corner) = ([0; N], [0; N]);
    for (pixel, up) in row.as_chunks_mut::<N>().0.iter_mut().zip(above.as_chunks::<N>().0) {
        for k in 0..N {
            pixel[k] = pixel[k].wrapping_add(predict(left[k], up[k], corner[k]));
        }
        (left, corner) = (*pixel, *up);
    }
}

/// Of three neighbours the one nearest to `left + up - corner` (Paeth); ties go to the first.
#[inline(always)]
fn nearest_gradient(left: u8, up: u8, corner: u8) -> u8 {
    let [a, b, c] = [left, up, corner].map(i16::from);
    let (from_left, from_up, from_corner) = ((b - c).abs(), (a - c).abs(), (a + b - 2 * c).abs());
    if from_left <= from_up && from_left <= from_corner {
        left
    } else if from_up <= from_corner {
        up
    } else {
        corner
    }
}
