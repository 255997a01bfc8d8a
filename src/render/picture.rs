//! What a renderer fills: colours, depth and segmentation.
//!
//! ```
//! use robohive_render::Picture;
//! use robohive_render::picture::Channels;
//!
//! // A renderer fills the channels that are asked for, and leaves the others as they were.
//! let picture = Picture::new(64, 48);
//! assert!((picture.width, picture.height) == (64, 48) && picture.rgb.is_empty());
//! assert!(Channels::RGB.rgb && !Channels::RGB.depth && Channels::ALL.depth);
//! ```

/// Which arrays of a [`Picture`] are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Channels {
    /// Colours.
    pub rgb: bool,
    /// Depth.
    pub depth: bool,
    /// Segmentation.
    pub segmentation: bool,
}

impl Channels {
    /// Colours alone.
    pub const RGB: Channels = Channels { rgb: true, depth: false, segmentation: false };
    /// Depth alone.
    pub const DEPTH: Channels = Channels { rgb: false, depth: true, segmentation: false };
    /// Segmentation alone.
    pub const SEGMENTATION: Channels = Channels { rgb: false, depth: false, segmentation: true };
    /// Colours, depth and segmentation.
    pub const ALL: Channels = Channels { rgb: true, depth: true, segmentation: true };
}

/// One picture, row 0 at the top. Arrays that were not wanted are empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// Number of columns.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// Colours, `height * width * 3`.
    pub rgb: Vec<u8>,
    /// Distance from the camera's plane \[m\], `height * width`; the far plane's where there is nothing.
    pub depth: Vec<f32>,
    /// Number and type of the object seen (`ObjType`), `height * width`; -1 and -1 where there is nothing.
    pub segmentation: Vec<[i32; 2]>,
}

impl Picture {
    /// A picture of this size that is still empty.
    pub fn new(width: usize, height: usize) -> Self {
        Picture { width, height, ..Picture::default() }
    }
}
