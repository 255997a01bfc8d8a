//! Smaller pictures.

use crate::frame::{Frame, Image};

/// The largest size with the aspect of `size` inside of `limit`, never larger than `size` and at least one pixel a side.
pub(crate) fn fit(size: (u32, u32), limit: (u32, u32)) -> (u32, u32) {
    let (width, height) = (u64::from(size.0), u64::from(size.1));
    let (most_width, most_height) = (u64::from(limit.0).min(width), u64::from(limit.1).min(height));
    // The side that the limit shortens more decides.
    match most_width * height <= most_height * width {
        true => (most_width.max(1) as u32, rounded_ratio(height * most_width, width)),
        false => (rounded_ratio(width * most_height, height), most_height.max(1) as u32),
    }
}

/// `a / b` to the nearest whole number, at least 1.
fn rounded_ratio(a: u64, b: u64) -> u32 {
    ((a + b / 2) / b).max(1) as u32
}

/// A picture of another size: each pixel is the mean of the area it covers (of sRGB values; the error against light is
/// invisible in a preview).
pub(crate) fn scaled(frame: &Frame<'_>, (width, height): (u32, u32)) -> Image {
    if (width, height) == (frame.width(), frame.height()) {
        return Image::collect(width, height, frame.rgb().as_chunks::<3>().0.iter().copied());
    }
    let columns = cover(frame.width(), width);
    let rows = cover(frame.height(), height);
    let pixels = rows.iter().flat_map(|rows| columns.iter().map(|columns| mean(frame, columns, rows)));
    Image::collect(width, height, pixels)
}

/// Pixels of a side that one pixel of the shorter side covers.
struct Span {
    first: u32,
    /// Share of each, in units of the shorter side; all spans have the same sum.
    weights: Vec<u32>,
}

/// The spans of all pixels of a side of `to` pixels over one of `from`.
fn cover(from: u32, to: u32) -> Vec<Span> {
    (0..to)
        .map(|i| {
            // In units of 1/to of a pixel of the longer side.
            let (start, end) = (u64::from(i) * u64::from(from), u64::from(i + 1) * u64::from(from));
            let unit = u64::from(to);
            let (first, last) = (start / unit, (end - 1) / unit);
            let share = |pixel: u64| ((pixel + 1) * unit).min(end) - (pixel * unit).max(start);
            Span { first: first as u32, weights: (first..=last).map(|pixel| share(pixel) as u32).collect() }
        })
        .collect()
}

fn mean(frame: &Frame<'_>, columns: &Span, rows: &Span) -> [u8; 3] {
    let (mut sum, mut total) = ([0_u64; 3], 0);
    for (y, &vertical) in (rows.first..).zip(&rows.weights) {
        let row = &frame.row(y).as_chunks::<3>().0[columns.first as usize..];
        for (pixel, &horizontal) in row.iter().zip(&columns.weights) {
            let weight = u64::from(vertical) * u64::from(horizontal);
            total += weight;
            for (sum, &channel) in sum.iter_mut().zip(pixel) {
                *sum += weight * u64::from(channel);
            }
        }
    }
    sum.map(|sum| ((sum + total / 2) / total) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fitting_keeps_the_aspect_and_never_enlarges() {
        assert_eq!(fit((640, 480), (80, 80)), (80, 60));
        assert_eq!(fit((480, 640), (80, 80)), (60, 80));
        assert_eq!(fit((64, 48), (80, 80)), (64, 48));
        assert_eq!(fit((16384, 1), (80, 80)), (80, 1));
        assert_eq!(fit((1, 16384), (80, 80)), (1, 80));
        assert_eq!(fit((16384, 16384), (1, 1)), (1, 1));
        assert_eq!(fit((640, 480), (0, 0)), (1, 1));
    }

    #[test]
    fn means_are_those_of_the_areas() {
        let pixels: Vec<u8> = [0, 90, 30, 60, 120, 180].iter().flat_map(|&g| [g, 0, 255 - g]).collect();
        let frame = Frame::new(3, 2, &pixels).unwrap();
        assert_eq!(scaled(&frame, (3, 2)).frame().rgb(), pixels);
        assert_eq!(scaled(&frame, (1, 1)).frame().rgb(), [80, 0, 175]);
        // Columns 0 to 1.5 and 1.5 to 3 of (0, 90, 30) and (60, 120, 180).
        let halves: Vec<u8> = scaled(&frame, (2, 1)).frame().rgb().iter().step_by(3).copied().collect();
        assert_eq!(halves, [55, 105]);
    }
}
