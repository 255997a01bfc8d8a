//! Figures, texts and images that a program lays over the picture.

use super::wire::{Wire, WireError, record, split};

/// A rectangle of the window, from its lower left corner \[pixels\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Left edge.
    pub left: i32,
    /// Lower edge.
    pub bottom: i32,
    /// Width.
    pub width: i32,
    /// Height.
    pub height: i32,
}

record!(Place { left, bottom, width, height });

/// Text in a corner or at a side of the picture, in one or two columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// Letters of twice the size.
    pub big: bool,
    /// Where: top left, top right, bottom left, bottom right, top, bottom, left, right.
    pub corner: u8,
    /// The first column: the titles, where there is a second one.
    pub first: String,
    /// The second column; empty for none.
    pub second: String,
}

record!(Text { big, corner, first, second });

/// An image in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    /// The place, as wide and high as the image.
    pub place: Place,
    /// Colours, three bytes a pixel, rows from the top.
    pub rgb: Bytes,
}

record!(Image { place, rgb });

/// A line of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Its name in the legend.
    pub name: String,
    /// Its colour.
    pub rgb: [f32; 3],
    /// Its points.
    pub points: Vec<[f32; 2]>,
}

record!(Line { name, rgb, points });

/// Curves over two axes in their place.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The place.
    pub place: Place,
    /// The title.
    pub title: String,
    /// What the horizontal axis shows.
    pub across: String,
    /// Bars in place of curves.
    pub bars: bool,
    /// Whether names are shown.
    pub legend: bool,
    /// Whether the range grows with the points.
    pub grows: bool,
    /// Range of both axes; one whose end is not greater than its start follows from the points.
    pub range: [[f32; 2]; 2],
    /// Colour of the background.
    pub background: [f32; 4],
    /// The lines.
    pub lines: Vec<Line>,
}

record!(Figure { place, title, across, bars, legend, grows, range, background, lines });

/// Bytes as they are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Bytes(pub Vec<u8>);

impl Wire for Bytes {
    fn put(&self, out: &mut Vec<u8>) {
        self.0.len().put(out);
        out.extend_from_slice(&self.0);
    }

    fn take(from: &mut &[u8]) -> Result<Self, WireError> {
        let count = usize::take(from)?;
        Ok(Bytes(split(from, count)?.to_vec()))
    }
}
