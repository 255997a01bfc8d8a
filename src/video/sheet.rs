//! Contact sheets: many pictures with captions in a grid.

use crate::error::VideoError;
use crate::frame::{Frame, Image};
use crate::label::{self, LETTER};
use crate::limits::MAX_SIDE;
use crate::scale::{fit, scaled};

/// Pixels around and between the cells.
const GAP: u32 = 8;

/// Pixels between a picture and its caption.
const ABOVE_CAPTION: u32 = 4;

/// Colours of the paper, of an empty part of a cell, and of captions.
const PAPER: [u8; 3] = [250, 250, 250];
const EMPTY: [u8; 3] = [225, 225, 225];
const INK: [u8; 3] = [30, 30, 30];

/// A grid of cells of one size, filled row by row from the upper left. The sheet's height follows from how many there are.
#[derive(Clone, Debug)]
pub struct Sheet {
    columns: u32,
    cell: (u32, u32),
    pictures: Vec<(Image, String)>,
}

impl Sheet {
    /// A sheet of `columns` cells a row, each for a picture of up to `cell` (width, height) pixels.
    pub fn new(columns: u32, cell: (u32, u32)) -> Result<Self, VideoError> {
        let sheet = Sheet { columns, cell, pictures: Vec::new() };
        match sheet.size(1) {
            Some(_) if columns > 0 && cell.0 > 0 && cell.1 > 0 => Ok(sheet),
            _ => Err(VideoError::SheetSize { columns, cell, pictures: 1 }),
        }
    }

    /// Adds a picture, scaled down to its cell with its aspect kept, and one line of caption. Letters beyond Latin-1 are
    /// drawn as question marks, and a caption wider than its cell is cut.
    pub fn add(&mut self, frame: &Frame<'_>, caption: &str) -> Result<(), VideoError> {
        let pictures = self.pictures.len() + 1;
        if self.size(pictures).is_none() {
            return Err(VideoError::SheetSize { columns: self.columns, cell: self.cell, pictures });
        }
        let size = fit((frame.width(), frame.height()), self.cell);
        self.pictures.push((scaled(frame, size), caption.to_owned()));
        Ok(())
    }

    /// Pictures added so far.
    pub fn len(&self) -> usize {
        self.pictures.len()
    }

    /// Whether no picture was added yet.
    pub fn is_empty(&self) -> bool {
        self.pictures.is_empty()
    }

    /// Draws the sheet; an empty one is a row of paper.
    pub fn image(&self) -> Result<Image, VideoError> {
        let pictures = self.pictures.len();
        let error = || VideoError::SheetSize { columns: self.columns, cell: self.cell, pictures };
        let (width, height) = self.size(pictures).ok_or_else(error)?;
        let mut image = Image::filled(width, height, PAPER)?;
        let background = Image::filled(self.cell.0, self.cell.1, EMPTY)?;
        let (across, down) = self.steps();
        for ((picture, caption), number) in self.pictures.iter().zip(0..) {
            let left = GAP + number % self.columns * across;
            let top = GAP + number / self.columns * down;
            image.place(&background.frame(), left, top);
            let picture = picture.frame();
            let (beside, above) = ((self.cell.0 - picture.width()) / 2, (self.cell.1 - picture.height()) / 2);
            image.place(&picture, left + beside, top + above);
            label::draw(&mut image, caption, (left, top + self.cell.1 + ABOVE_CAPTION), self.cell.0, INK);
        }
        Ok(image)
    }

    /// Pixels from one cell to the next, to the right and down.
    fn steps(&self) -> (u32, u32) {
        (self.cell.0 + GAP, self.cell.1 + ABOVE_CAPTION + LETTER + GAP)
    }

    /// Width and height of a sheet of some pictures, if it is not too large.
    fn size(&self, pictures: usize) -> Option<(u32, u32)> {
        if self.cell.0 > MAX_SIDE || self.cell.1 > MAX_SIDE {
            return None;
        }
        let rows = u32::try_from(pictures.div_ceil(self.columns.max(1) as usize).max(1)).ok()?;
        let (across, down) = self.steps();
        let side = |count: u32, step: u32| {
            count.checked_mul(step)?.checked_add(GAP).filter(|&side| side <= MAX_SIDE)
        };
        Some((side(self.columns, across)?, side(rows, down)?))
    }
}
