//! From RGB to the planes that a video encoder takes.
//!
//! ITU-R BT.601 luma and colour differences in the limited range (luma 16..=235), chroma averaged over 2 x 2 pixels.

use std::borrow::Cow;

use crate::frame::Frame;

/// Reusable planes of one frame in 4:2:0, with sides rounded up to even numbers.
#[derive(Debug)]
pub(crate) struct Planes {
    width: usize,
    height: usize,
    pub(crate) y: Vec<u8>,
    pub(crate) u: Vec<u8>,
    pub(crate) v: Vec<u8>,
}

impl Planes {
    /// Planes for frames of a size.
    pub(crate) fn new(width: u32, height: u32) -> Self {
        let (width, height) = (even(width) as usize, even(height) as usize);
        let chroma = width * height / 4;
        Planes { width, height, y: vec![0; width * height], u: vec![0; chroma], v: vec![0; chroma] }
    }

    /// Width and height, both even.
    pub(crate) fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// Converts a frame of the size given to [`new`](Self::new). An odd last column or row is repeated.
    pub(crate) fn fill(&mut self, frame: &Frame<'_>) {
        let chroma_width = self.width / 2;
        let luma = self.y.chunks_exact_mut(2 * self.width);
        let chroma = self.u.chunks_exact_mut(chroma_width).zip(self.v.chunks_exact_mut(chroma_width));
        for ((luma, (u, v)), pair) in luma.zip(chroma).zip(0..) {
            let above = even_row(frame, 2 * pair);
            let below = even_row(frame, (2 * pair + 1).min(frame.height() - 1));
            let (luma_above, luma_below) = luma.split_at_mut(self.width);
            luma_row(&above, luma_above);
            luma_row(&below, luma_below);
            chroma_row(&above, &below, u, v);
        }
    }
}

/// The next even number.
pub(crate) fn even(side: u32) -> u32 {
    side.next_multiple_of(2)
}

/// A row with an even number of pixels: the last one of an odd row is repeated.
fn even_row<'a>(frame: &Frame<'a>, y: u32) -> Cow<'a, [u8]> {
    let row = frame.row(y);
    match frame.width() % 2 {
        0 => Cow::Borrowed(row),
        _ => Cow::Owned([row, &row[row.len() - 3..]].concat()),
    }
}

/// Luma of a row of pixels. The factors are BT.601's times 219/255, in units of 2^-16.
fn luma_row(rgb: &[u8], luma: &mut [u8]) {
    for (pixel, luma) in rgb.as_chunks::<3>().0.iter().zip(luma) {
        let [r, g, b] = pixel.map(i32::from);
        *luma = ((16_829 * r + 33_039 * g + 6_416 * b + (16 << 16) + (1 << 15)) >> 16) as u8;
    }
}

/// Colour differences of two rows of pixels, one for each 2 x 2. The factors are BT.601's times 224/255 in units of
/// 2^-16; the sum of four pixels takes two more bits.
fn chroma_row(above: &[u8], below: &[u8], u: &mut [u8], v: &mut [u8]) {
    let above = above.as_chunks::<6>().0;
    let below = below.as_chunks::<6>().0;
    for (((a, b), u), v) in above.iter().zip(below).zip(u).zip(v) {
        let sum = |i: usize| i32::from(a[i]) + i32::from(a[i + 3]) + i32::from(b[i]) + i32::from(b[i + 3]);
        let (red, green, blue) = (sum(0), sum(1), sum(2));
        let centre = (128 << 18) + (1 << 17);
        *u = ((-9_714 * red - 19_070 * green + 28_784 * blue + centre) >> 18) as u8;
        *v = ((28_784 * red - 24_103 * green - 4_681 * blue + centre) >> 18) as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grey_has_no_colour_and_primaries_are_those_of_bt_601() {
        let planes = |rgb: [u8; 3]| {
            let pixels = rgb.repeat(4);
            let mut planes = Planes::new(2, 2);
            planes.fill(&Frame::new(2, 2, &pixels).unwrap());
            assert!(planes.y.iter().all(|&y| y == planes.y[0]));
            [planes.y[0], planes.u[0], planes.v[0]]
        };
        assert_eq!(planes([0, 0, 0]), [16, 128, 128]);
        assert_eq!(planes([255, 255, 255]), [235, 128, 128]);
        // BT.601: luma 0.299, 0.587, 0.114 of 219 above 16; colour differences end at 16 and 240.
        assert_eq!(planes([255, 0, 0]), [81, 90, 240]);
        assert_eq!(planes([0, 255, 0]), [145, 54, 34]);
        assert_eq!(planes([0, 0, 255]), [41, 240, 110]);
        for grey in 0..=255 {
            assert_eq!(planes([grey; 3])[1..], [128, 128]);
        }
    }

    #[test]
    fn an_odd_last_row_and_column_are_repeated() {
        let pixels: Vec<u8> = [10, 20, 30, 40, 50, 60, 70, 80, 90].iter().flat_map(|&g| [g; 3]).collect();
        let mut planes = Planes::new(3, 3);
        planes.fill(&Frame::new(3, 3, &pixels).unwrap());
        assert_eq!(planes.size(), (4, 4));
        let rows: Vec<_> = planes.y.chunks(4).collect();
        assert!(rows.iter().all(|row| row[3] == row[2]), "{rows:?}");
        assert_eq!(rows[3], rows[2]);
        assert!(rows[0][0] < rows[0][1] && rows[1][0] < rows[2][0]);
    }
}
