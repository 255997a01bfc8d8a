//! Pictures that are encoded.

use crate::error::EncoderError;

/// Most pixels of a side.
pub const MAX_SIDE: usize = 16_384;

/// A picture of 8-bit red, green and blue, row by row from the top left.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a> {
    height: usize,
    width: usize,
    pixels: &'a [u8],
}

impl<'a> Picture<'a> {
    /// A picture over height × width × 3 bytes.
    ///
    /// # Errors
    /// [`EncoderError::Picture`]: a side is zero or longer than 16384, or the bytes do not fill the picture.
    pub fn new(height: usize, width: usize, pixels: &'a [u8]) -> Result<Self, EncoderError> {
        let wrong = |reason: String| EncoderError::Picture { height, width, reason };
        if !(1..=MAX_SIDE).contains(&height) || !(1..=MAX_SIDE).contains(&width) {
            return Err(wrong(format!("each side should have 1 to {MAX_SIDE} pixels")));
        }
        let expected = height * width * 3;
        if pixels.len() != expected {
            return Err(wrong(format!("{} bytes were given, and {expected} are needed", pixels.len())));
        }
        Ok(Picture { height, width, pixels })
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Columns.
    pub fn width(&self) -> usize {
        self.width
    }

    /// The bytes, height × width × 3.
    pub fn pixels(&self) -> &'a [u8] {
        self.pixels
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_must_fit_the_bytes() {
        assert!(Picture::new(1, 2, &[0; 6]).is_ok());
        for (height, width, length) in [(0, 2, 0), (1, 2, 5), (MAX_SIDE + 1, 1, 3), (1, usize::MAX, 3)] {
            let error = Picture::new(height, width, &vec![0; length]).unwrap_err();
            assert!(error.to_string().contains("picture of"), "{error}");
        }
    }
}
