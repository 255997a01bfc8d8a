//! Pictures of at most 256 colours.
//!
//! Many colours are divided by variance (Wan, Prusinkiewicz and Wong 1990): the part of the colours with the largest
//! squared error is cut at its mean, across the channel that varies most, until there are 256 parts.

use crate::frame::Frame;

/// Most colours of a palette.
const COLOURS: usize = 256;

/// Bits of a channel by which similar colours are counted as one.
const BITS: u32 = 6;

/// A picture as indices into a palette.
#[derive(Debug)]
pub(crate) struct Indexed {
    /// 1 to 256 colours.
    pub(crate) palette: Vec<[u8; 3]>,
    /// One a pixel, rows from the top.
    pub(crate) indices: Vec<u8>,
}

/// Reduces a frame to 256 colours; one that has no more keeps them exactly, in order of appearance.
pub(crate) fn indexed(frame: &Frame<'_>) -> Indexed {
    let pixels = frame.rgb().as_chunks::<3>().0;
    exact(pixels).unwrap_or_else(|| divided(pixels))
}

/// The frame's own colours, if they are at most 256.
fn exact(pixels: &[[u8; 3]]) -> Option<Indexed> {
    let mut palette: Vec<[u8; 3]> = Vec::new();
    let mut indices = Vec::with_capacity(pixels.len());
    // Neighbours mostly agree: a slot remembers the last colour of its kind.
    let mut slots = [None; 4096];
    for &pixel in pixels {
        let slot: &mut Option<([u8; 3], u8)> = &mut slots[slot(pixel)];
        let index = match *slot {
            Some((colour, index)) if colour == pixel => index,
            _ => {
                let known = palette.iter().position(|&colour| colour == pixel);
                let index = known.unwrap_or(palette.len());
                if index == COLOURS {
                    return None;
                }
                if known.is_none() {
                    palette.push(pixel);
                }
                index as u8
            }
        };
        *slot = Some((pixel, index));
        indices.push(index);
    }
    Some(Indexed { palette, indices })
}

/// One of 4096 slots, different for most colours of a picture.
fn slot([r, g, b]: [u8; 3]) -> usize {
    let colour = u32::from(r) << 16 | u32::from(g) << 8 | u32::from(b);
    (colour.wrapping_mul(2_654_435_769) >> 20) as usize
}

/// Similar colours: how many pixels, and the sum of their channels.
#[derive(Clone, Copy, Debug)]
struct Cell {
    key: usize,
    count: u64,
    sum: [u64; 3],
}

impl Cell {
    /// The mean of a channel.
    fn mean(&self, channel: usize) -> f64 {
        self.sum[channel] as f64 / self.count as f64
    }
}

/// The cell of a colour.
fn key(pixel: [u8; 3]) -> usize {
    pixel.iter().fold(0, |key, &channel| key << BITS | usize::from(channel >> (8 - BITS)))
}

/// A palette of means, and for each pixel the mean of its part.
fn divided(pixels: &[[u8; 3]]) -> Indexed {
    let mut cells = count(pixels);
    let mut parts = vec![Part::of(&cells, 0..cells.len())];
    while parts.len() < COLOURS {
        let Some(largest) = (0..parts.len()).max_by(|&a, &b| parts[a].error.total_cmp(&parts[b].error))
        else {
            break;
        };
        if parts[largest].error <= 0.0 {
            break;
        }
        let (low, high) = parts[largest].cut(&mut cells);
        parts[largest] = low;
        parts.push(high);
    }
    let mut index_of_key = vec![0; 1 << (3 * BITS)];
    for (part, index) in parts.iter().zip(0..=255) {
        for cell in &cells[part.cells.clone()] {
            index_of_key[cell.key] = index;
        }
    }
    let palette = parts.iter().map(|part| part.mean.map(|channel| channel.round() as u8)).collect();
    Indexed { palette, indices: pixels.iter().map(|&pixel| index_of_key[key(pixel)]).collect() }
}

/// The cells that a picture has, in order of appearance.
fn count(pixels: &[[u8; 3]]) -> Vec<Cell> {
    let mut cells: Vec<Cell> = Vec::new();
    let mut number_of_key = vec![u32::MAX; 1 << (3 * BITS)];
    for &pixel in pixels {
        let key = key(pixel);
        if number_of_key[key] == u32::MAX {
            number_of_key[key] = cells.len() as u32;
            cells.push(Cell { key, count: 0, sum: [0; 3] });
        }
        let cell = &mut cells[number_of_key[key] as usize];
        cell.count += 1;
        for (sum, channel) in cell.sum.iter_mut().zip(pixel) {
            *sum += u64::from(channel);
        }
    }
    cells
}

/// A range of cells that will share a colour.
#[derive(Debug)]
struct Part {
    cells: std::ops::Range<usize>,
    mean: [f64; 3],
    /// The channel that varies most.
    channel: usize,
    /// Sum of the squared distances from the mean of that channel; zero for a single cell.
    error: f64,
}

impl Part {
    fn of(cells: &[Cell], range: std::ops::Range<usize>) -> Self {
        let (mut pixels, mut sum, mut squares) = (0.0, [0.0; 3], [0.0; 3]);
        for cell in &cells[range.clone()] {
            pixels += cell.count as f64;
            for channel in 0..3 {
                let mean = cell.mean(channel);
                sum[channel] += mean * cell.count as f64;
                squares[channel] += mean * mean * cell.count as f64;
            }
        }
        let mean = sum.map(|sum| sum / pixels);
        let errors: [f64; 3] = std::array::from_fn(|i| squares[i] - sum[i] * mean[i]);
        let channel = (0..3).max_by(|&a, &b| errors[a].total_cmp(&errors[b])).unwrap_or(0);
        // One cell is not divided, whatever rounding says of its error.
        let error = if range.len() == 1 { 0.0 } else { errors[channel] };
        Part { cells: range, mean, channel, error }
    }

    /// Sorts the cells into those up to the mean and those above; neither is empty.
    fn cut(&self, cells: &mut [Cell]) -> (Part, Part) {
        let (channel, mean) = (self.channel, self.mean[self.channel]);
        let range = &mut cells[self.cells.clone()];
        range.sort_by(|a, b| a.mean(channel).total_cmp(&b.mean(channel)));
        let low = range.partition_point(|cell| cell.mean(channel) <= mean).clamp(1, range.len() - 1);
        let middle = self.cells.start + low;
        (Part::of(cells, self.cells.start..middle), Part::of(cells, middle..self.cells.end))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest difference of a channel between a frame and its indexed form.
    fn worst(pixels: &[u8], found: &Indexed) -> u8 {
        let shown = found.indices.iter().flat_map(|&index| found.palette[index as usize]);
        pixels.iter().zip(shown).map(|(&a, b)| a.abs_diff(b)).max().unwrap()
    }

    #[test]
    fn few_colours_stay_exact() {
        let pixels: Vec<u8> = (0..64 * 64).flat_map(|i| [(i % 256) as u8, 7, (i % 256 / 2) as u8]).collect();
        let found = indexed(&Frame::new(64, 64, &pixels).unwrap());
        assert_eq!(found.palette.len(), 256);
        assert_eq!(worst(&pixels, &found), 0);
    }

    #[test]
    fn many_colours_become_near_ones() {
        let pixels: Vec<u8> =
            (0..64 * 64).flat_map(|i| [(i % 64 * 4) as u8, (i / 64 * 4) as u8, 90]).collect();
        let found = indexed(&Frame::new(64, 64, &pixels).unwrap());
        assert_eq!(found.palette.len(), 256);
        assert!(worst(&pixels, &found) <= 24, "{}", worst(&pixels, &found));
    }
}
