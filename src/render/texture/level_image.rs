//! An image that a texture is drawn from, for renderers that keep textures of their own.

/// The image of one mip level, or of one face of it.
#[derive(Clone, Copy, Debug)]
pub struct LevelImage<'a> {
    /// Mip level, 0 for the finest.
    pub level: usize,
    /// Face of a cube, 0 otherwise.
    pub face: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Pixels from one row to the next.
    pub stride: usize,
    /// Pixels from the first on, packed as red, green, blue, alpha from the lowest byte on.
    pub pixels: &'a [u32],
}
