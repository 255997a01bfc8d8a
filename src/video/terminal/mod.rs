//! Pictures in terminals.
//!
//! ```
//! use robohive_video::Frame;
//! use robohive_video::terminal::{Protocol, TerminalSize, preview};
//!
//! let red = [200, 30, 30].repeat(16);
//! let text = preview(&Frame::new(4, 4, &red)?, Protocol::HalfBlocks, TerminalSize::of(80, 24));
//! assert_eq!(text.matches('▀').count(), 8);
//! # Ok::<(), robohive_video::VideoError>(())
//! ```

mod detect;
mod half_blocks;
mod inline;
mod sixel;

use crate::frame::{Frame, Image};
use crate::scale::{fit, scaled};

/// How a terminal is sent a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Protocol {
    /// Kitty's graphics protocol: kitty, Ghostty, Konsole.
    Kitty,
    /// Sixel, DEC's format of 1983 with 256 colours: foot, mlterm, mintty, contour.
    Sixel,
    /// iTerm2's inline images: iTerm2, WezTerm.
    ITerm2,
    /// Upper half blocks in 24-bit colours, two pixels a cell.
    HalfBlocks,
    /// Upper half blocks in the 256 indexed colours of xterm, two pixels a cell.
    HalfBlocks256,
}

/// The room that a picture may take.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TerminalSize {
    /// Cells a line.
    pub columns: u16,
    /// Lines.
    pub rows: u16,
    /// Width and height of a cell in pixels.
    pub cell: (u16, u16),
}

impl TerminalSize {
    /// A terminal whose size is known only in cells: a cell is taken to have 8 x 16 pixels.
    pub fn of(columns: u16, rows: u16) -> Self {
        TerminalSize { columns, rows, cell: (8, 16) }
    }

    /// Width and height in pixels; no side is zero.
    fn pixels(&self) -> (u32, u32) {
        let side = |cells: u16, pixels: u16| u32::from(cells.max(1)) * u32::from(pixels.max(1));
        (side(self.columns, self.cell.0), side(self.rows, self.cell.1))
    }

    /// Columns and rows that a picture of some pixels takes.
    fn cells(&self, width: u32, height: u32) -> (u32, u32) {
        (width.div_ceil(u32::from(self.cell.0.max(1))), height.div_ceil(u32::from(self.cell.1.max(1))))
    }
}

/// The text that shows a frame and ends with a new line. A picture larger than the terminal is scaled down with its aspect
/// kept, a smaller one is shown pixel by pixel.
pub fn preview(frame: &Frame<'_>, protocol: Protocol, terminal: TerminalSize) -> String {
    match protocol {
        Protocol::Kitty | Protocol::ITerm2 | Protocol::Sixel => {
            let image = within(frame, terminal.pixels());
            let frame = image.frame();
            match protocol {
                Protocol::Kitty => inline::kitty(&frame, terminal.cells(frame.width(), frame.height())),
                Protocol::ITerm2 => inline::iterm2(&frame, terminal.cells(frame.width(), frame.height())),
                _ => sixel::text(&frame),
            }
        }
        Protocol::HalfBlocks | Protocol::HalfBlocks256 => {
            let pixels = (u32::from(terminal.columns.max(1)), 2 * u32::from(terminal.rows.max(1)));
            half_blocks::text(&within(frame, pixels).frame(), protocol == Protocol::HalfBlocks)
        }
    }
}

/// The frame, scaled down to at most `limit` columns and rows \[pixel\].
fn within(frame: &Frame<'_>, limit: (u32, u32)) -> Image {
    scaled(frame, fit((frame.width(), frame.height()), limit))
}
