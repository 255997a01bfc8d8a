//! Resizing with a filter that widens when pictures shrink, as Pillow does it on bytes and torchvision on numbers.
//!
//! Each output pixel is a weighted mean of the input pixels below the filter; columns are filtered first, then rows. On bytes,
//! weights have 22 fractional bits and each of the two passes rounds, which gives Pillow's bytes. Only the window of the
//! output that is asked for is computed, so a crop costs no more than its pixels. (Where the height shrinks much
//! more than the width, Pillow 13 filters rows first; resizing that keeps proportions never does.)
//!
//! Source: Pillow, `src/libImaging/Resample.c`; PyTorch, `upsample_bicubic2d` with antialiasing, has the same weights.

use crate::picture::Picture;

/// Fractional bits of a weight on bytes: 32 less 8 of a byte and 2 of headroom.
const FRACTION: u32 = 32 - 8 - 2;

/// Slope of the cubic filter one pixel from its centre.
const CUBIC: f64 = -0.5;

/// Channels of a pixel.
const CHANNELS: usize = 3;

/// How input pixels are weighted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Filter {
    /// A triangle over 2 pixels.
    Bilinear,
    /// Keys' cubic with a = −1/2, over 4 pixels.
    Bicubic,
}

impl Filter {
    /// Pixels from the centre to the end.
    fn support(self) -> f64 {
        match self {
            Filter::Bilinear => 1.0,
            Filter::Bicubic => 2.0,
        }
    }

    /// Height at a distance from the centre.
    fn at(self, x: f64) -> f64 {
        let x = x.abs();
        match self {
            Filter::Bilinear => (1.0 - x).max(0.0),
            Filter::Bicubic if x < 1.0 => ((CUBIC + 2.0) * x - (CUBIC + 3.0)) * x * x + 1.0,
            Filter::Bicubic if x < 2.0 => (((x - 5.0) * x + 8.0) * x - 4.0) * CUBIC,
            Filter::Bicubic => 0.0,
        }
    }
}

/// A part of one axis of the resized picture.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// Pixels of the whole axis after resizing.
    pub whole: usize,
    /// First of the pixels that are computed.
    pub first: usize,
    /// How many are computed.
    pub count: usize,
}

/// Input pixels that an output pixel is made of, and their weights, which sum to one.
struct Tap {
    first: usize,
    weights: Vec<f64>,
}

/// Taps of the pixels of a window over an axis of `length` input pixels; where that is the axis's length after resizing too, each
/// pixel is its own. `hold` rounds places and weights to the precision in which they are kept.
fn taps(filter: Filter, length: usize, window: Window, hold: fn(f64) -> f64) -> Vec<Tap> {
    let places = window.first..window.first + window.count;
    if length == window.whole {
        return places.map(|place| Tap { first: place, weights: vec![1.0] }).collect();
    }
    let scale = hold(length as f64 / window.whole as f64);
    let stretch = scale.max(1.0);
    let support = hold(filter.support() * stretch);
    let inverse = hold(1.0 / stretch);
    let tap = |place: usize| {
        let centre = hold((place as f64 + 0.5) * scale);
        let first = (centre - support + 0.5).max(0.0) as usize;
        let end = ((centre + support + 0.5) as usize).min(length);
        let reach = |k: usize| hold((hold((k + first) as f64 - centre) + 0.5) * inverse);
        let mut weights: Vec<f64> = (0..end - first).map(|k| hold(filter.at(reach(k)))).collect();
        let sum: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight = hold(*weight / sum));
        Tap { first, weights }
    };
    places.map(tap).collect()
}

/// Keeps double precision.
fn double(x: f64) -> f64 {
    x
}

/// Rounds to single precision.
fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

/// Input rows from the first to the last that any of the taps reads.
fn span(taps: &[Tap]) -> std::ops::Range<usize> {
    let first = taps.iter().map(|tap| tap.first).min().unwrap_or(0);
    let end = taps.iter().map(|tap| tap.first + tap.weights.len()).max().unwrap_or(0);
    first..end
}

/// Resizes on bytes, as Pillow does: window height × window width × 3. An axis that keeps its length is copied.
pub fn bytes(picture: &Picture<'_>, filter: Filter, rows: Window, columns: Window) -> Vec<u8> {
    let across = fixed_point(taps(filter, picture.width(), columns, double));
    let down = taps(filter, picture.height(), rows, double);
    let needed = span(&down);
    let down = fixed_point(down);
    let stride = columns.count * CHANNELS;
    let mut narrow = vec![0u8; needed.len() * stride];
    for (row, out) in needed.clone().zip(narrow.chunks_exact_mut(stride)) {
        let line = &picture.pixels()[row * picture.width() * CHANNELS..];
        for (pixel, (first, weights)) in out.as_chunks_mut::<CHANNELS>().0.iter_mut().zip(&across) {
            let pixels = line[first * CHANNELS..].as_chunks::<CHANNELS>().0;
            *pixel = mean_of_bytes(pixels.iter(), weights);
        }
    }
    let mut out = vec![0u8; rows.count * stride];
    let narrow = narrow.as_chunks::<CHANNELS>().0;
    for (row, (first, weights)) in out.chunks_exact_mut(stride).zip(&down) {
        for (column, pixel) in row.as_chunks_mut::<CHANNELS>().0.iter_mut().enumerate() {
            let start = (first - needed.start) * columns.count + column;
            *pixel = mean_of_bytes(narrow[start..].iter().step_by(columns.count), weights);
        }
    }
    out
}

/// First pixels and weights of taps, the weights with [`FRACTION`] fractional bits.
fn fixed_point(taps: Vec<Tap>) -> Vec<(usize, Vec<i32>)> {
    let scaled = |weight: f64| (weight * f64::from(1u32 << FRACTION) + 0.5f64.copysign(weight)) as i32;
    taps.into_iter().map(|tap| (tap.first, tap.weights.into_iter().map(scaled).collect())).collect()
}

/// The rounded mean of pixels, each channel held within a byte.
fn mean_of_bytes<'a>(pixels: impl Iterator<Item = &'a [u8; CHANNELS]>, weights: &[i32]) -> [u8; CHANNELS] {
    let mut sums = [1i32 << (FRACTION - 1); CHANNELS];
    for (pixel, weight) in pixels.zip(weights) {
        for channel in 0..CHANNELS {
            sums[channel] += i32::from(pixel[channel]) * weight;
        }
    }
    sums.map(|sum| (sum >> FRACTION).clamp(0, 255) as u8)
}

/// Resizes on numbers, as torchvision does with tensors of floats: window height × window width × 3, neither rounded nor
/// held within 0 to 255.
pub fn numbers(picture: &Picture<'_>, filter: Filter, rows: Window, columns: Window) -> Vec<f32> {
    let across = taps(filter, picture.width(), columns, single);
    let down = taps(filter, picture.height(), rows, single);
    let needed = span(&down);
    let stride = columns.count * CHANNELS;
    let mut narrow = vec![0f32; needed.len() * stride];
    for (row, out) in needed.clone().zip(narrow.chunks_exact_mut(stride)) {
        let line = &picture.pixels()[row * picture.width() * CHANNELS..];
        for (pixel, tap) in out.as_chunks_mut::<CHANNELS>().0.iter_mut().zip(&across) {
            for (from, weight) in
                line[tap.first * CHANNELS..].as_chunks::<CHANNELS>().0.iter().zip(&tap.weights)
            {
                for channel in 0..CHANNELS {
                    pixel[channel] += f32::from(from[channel]) * *weight as f32;
                }
            }
        }
    }
    let mut out = vec![0f32; rows.count * stride];
    for (row, tap) in out.chunks_exact_mut(stride).zip(&down) {
        let lines = narrow[(tap.first - needed.start) * stride..].chunks_exact(stride);
        for (line, weight) in lines.zip(&tap.weights) {
            for (sum, value) in row.iter_mut().zip(line) {
                *sum += value * *weight as f32;
            }
        }
    }
    out
}
