//! Pictures in memory: borrowed frames and owned images.

use crate::error::VideoError;
use crate::limits::MAX_SIDE;

/// A borrowed picture: rows from the top, pixels from the left, 3 bytes (red, green, blue; sRGB) a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    width: u32,
    height: u32,
    rgb: &'a [u8],
}

impl<'a> Frame<'a> {
    /// Checks that each side has 1 to [`MAX_SIDE`] pixels and that `rgb` has `3 * width * height` bytes.
    pub fn new(width: u32, height: u32, rgb: &'a [u8]) -> Result<Self, VideoError> {
        let expected = 3 * pixels(width, height)?;
        if rgb.len() != expected {
            let found = rgb.len();
            return Err(VideoError::Length { what: "RGB", width, height, expected, found });
        }
        Ok(Frame { width, height, rgb })
    }

    /// Pixels a row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, `3 * width * height` bytes.
    pub fn rgb(&self) -> &'a [u8] {
        self.rgb
    }

    /// The bytes of one row, `3 * width`.
    ///
    /// # Panics
    /// If `y` is not below [`height`](Self::height).
    pub fn row(&self, y: u32) -> &'a [u8] {
        let stride = 3 * self.width as usize;
        &self.rgb[y as usize * stride..][..stride]
    }
}

/// An owned picture in the layout of [`Frame`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    rgb: Vec<u8>,
}

impl Image {
    /// A picture of one colour; sides of 1 to [`MAX_SIDE`] pixels.
    pub fn filled(width: u32, height: u32, colour: [u8; 3]) -> Result<Self, VideoError> {
        let rgb = colour.repeat(pixels(width, height)?);
        Ok(Image { width, height, rgb })
    }

    /// A picture of the pixels that an iterator gives row by row; it must give `width * height` of them.
    pub(crate) fn collect(width: u32, height: u32, colours: impl Iterator<Item = [u8; 3]>) -> Self {
        let rgb: Vec<u8> = colours.flatten().collect();
        debug_assert_eq!(rgb.len(), 3 * width as usize * height as usize);
        Image { width, height, rgb }
    }

    /// The picture as a frame.
    pub fn frame(&self) -> Frame<'_> {
        Frame { width: self.width, height: self.height, rgb: &self.rgb }
    }

    /// Sets a pixel; one outside of the picture is clipped.
    pub(crate) fn set(&mut self, x: u32, y: u32, colour: [u8; 3]) {
        if x < self.width && y < self.height {
            let at = 3 * (y as usize * self.width as usize + x as usize);
            self.rgb[at..at + 3].copy_from_slice(&colour);
        }
    }

    /// Copies a frame to (left, top), where it must fit.
    pub(crate) fn place(&mut self, frame: &Frame<'_>, left: u32, top: u32) {
        let stride = 3 * self.width as usize;
        for y in 0..frame.height() {
            let row = frame.row(y);
            let start = (top + y) as usize * stride + 3 * left as usize;
            self.rgb[start..start + row.len()].copy_from_slice(row);
        }
    }
}

/// Pixels of a picture with sides in the supported range.
pub(crate) fn pixels(width: u32, height: u32) -> Result<usize, VideoError> {
    let supported = 1..=MAX_SIDE;
    match supported.contains(&width) && supported.contains(&height) {
        true => Ok(width as usize * height as usize),
        false => Err(VideoError::Size { width, height }),
    }
}

/// Checks a buffer with one element a pixel.
pub(crate) fn check_length(
    what: &'static str,
    width: u32,
    height: u32,
    found: usize,
) -> Result<(), VideoError> {
    let expected = pixels(width, height)?;
    match found == expected {
        true => Ok(()),
        false => Err(VideoError::Length { what, width, height, expected, found }),
    }
}
