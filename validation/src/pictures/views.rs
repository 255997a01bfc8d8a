//! Where pictures come from: drawn, or recorded.

use super::items::Differences;
use super::measures::Geometry;
use super::recording::Recording;

/// Pictures of one scene, from wherever they come.
pub trait Views {
    /// Colours, three bytes a pixel, row 0 at the top.
    ///
    /// # Errors
    /// The picture cannot be drawn.
    fn colours(&mut self, side: usize, shadows: bool) -> Result<Vec<u8>, String>;

    /// Depth and segmentation.
    ///
    /// # Errors
    /// The picture cannot be drawn.
    fn geometry(&mut self, side: usize) -> Result<Geometry, String>;

    /// How the list of what is drawn differs from the recorded one; none where there is no such list.
    ///
    /// # Errors
    /// The scene cannot be assembled.
    fn differences(&mut self, recorded: &Recording) -> Result<Option<Differences>, String>;
}

impl Views for Recording {
    fn colours(&mut self, side: usize, shadows: bool) -> Result<Vec<u8>, String> {
        Recording::colours(self, side, if shadows { "rgb" } else { "rgb_no_shadow" })
    }

    fn geometry(&mut self, side: usize) -> Result<Geometry, String> {
        Recording::geometry(self, side)
    }

    fn differences(&mut self, _: &Recording) -> Result<Option<Differences>, String> {
        Ok(None)
    }
}
