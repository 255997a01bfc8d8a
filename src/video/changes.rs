//! What differs between two frames: the only part that GIF and animated PNG store again.

use crate::frame::{Frame, Image};

/// A part of a frame that replaces what was there.
#[derive(Debug)]
pub(crate) struct Change {
    /// Columns to the left of it.
    pub(crate) left: u32,
    /// Rows above it.
    pub(crate) top: u32,
    /// Its pixels.
    pub(crate) image: Image,
}

/// Remembers the last frame of a video.
#[derive(Debug, Default)]
pub(crate) struct Changes {
    last: Vec<u8>,
}

impl Changes {
    /// The smallest rectangle around the pixels that differ from the frame before: the whole frame at first, the upper
    /// left pixel if none differs. All frames have one size.
    pub(crate) fn next(&mut self, frame: &Frame<'_>) -> Change {
        let (columns, rows) = match self.last.is_empty() {
            true => (0..frame.width(), 0..frame.height()),
            false => self.differing(frame).unwrap_or((0..1, 0..1)),
        };
        self.last.clear();
        self.last.extend_from_slice(frame.rgb());
        let (left, top) = (columns.start, rows.start);
        let width = columns.end - columns.start;
        let height = rows.end - rows.start;
        let pixels = rows.flat_map(|y| {
            let row = frame.row(y).as_chunks::<3>().0;
            row[columns.start as usize..columns.end as usize].iter().copied()
        });
        Change { left, top, image: Image::collect(width, height, pixels) }
    }

    /// Columns and rows with a difference.
    fn differing(&self, frame: &Frame<'_>) -> Option<(std::ops::Range<u32>, std::ops::Range<u32>)> {
        let last = Frame::new(frame.width(), frame.height(), &self.last).ok()?;
        let (mut left, mut right) = (frame.width(), 0);
        let (mut top, mut bottom) = (frame.height(), 0);
        for y in 0..frame.height() {
            let (before, now) = (last.row(y), frame.row(y));
            if before == now {
                continue;
            }
            let mut pixels = before.as_chunks::<3>().0.iter().zip(now.as_chunks::<3>().0);
            let first = pixels.clone().position(|(a, b)| a != b)? as u32;
            let end = pixels.rposition(|(a, b)| a != b)? as u32 + 1;
            (left, right) = (left.min(first), right.max(end));
            (top, bottom) = (top.min(y), y + 1);
        }
        (top < bottom).then_some((left..right, top..bottom))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rectangle_is_the_smallest() {
        let mut image = Image::filled(9, 7, [5, 5, 5]).unwrap();
        let mut changes = Changes::default();
        let place = |change: &Change| {
            let frame = change.image.frame();
            (change.left, change.top, frame.width(), frame.height())
        };
        assert_eq!(place(&changes.next(&image.frame())), (0, 0, 9, 7));
        assert_eq!(place(&changes.next(&image.frame())), (0, 0, 1, 1));
        image.set(3, 2, [5, 5, 6]);
        image.set(7, 4, [4, 5, 5]);
        let change = changes.next(&image.frame());
        assert_eq!(place(&change), (3, 2, 5, 3));
        assert_eq!(change.image.frame().row(0)[..6], [5, 5, 6, 5, 5, 5]);
        assert_eq!(change.image.frame().row(2)[12..], [4, 5, 5]);
        image.set(8, 6, [0, 0, 0]);
        assert_eq!(place(&changes.next(&image.frame())), (8, 6, 1, 1));
    }
}
