//! What a texture is compiled from.

use physics::model::{ColorSpace, TextureType};

/// Pattern of a computed texture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Builtin {
    /// Not computed.
    #[default]
    None,
    /// From the first colour to the second.
    Gradient,
    /// Two by two squares.
    Checker,
    /// First colour; the downward face of a cube has the second.
    Flat,
}

/// Marks on a computed texture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Mark {
    /// None.
    #[default]
    None,
    /// Outline of each face.
    Edge,
    /// Middle row and column of each face.
    Cross,
    /// Random dots.
    Random,
}

/// Largest decoded image or texture in bytes, so that a few bytes cannot ask for all memory.
pub(super) const MAX_BYTES: usize = 1 << 30;

/// An image file that was read but not decoded.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FileImage {
    /// Contents.
    pub bytes: Vec<u8>,
    /// Path, for its extension and messages.
    pub path: String,
}

/// What an `asset/texture` element says, with its files already read.
#[derive(Debug, Clone, PartialEq)]
pub struct TextureSource {
    /// Name for messages.
    pub name: String,
    /// Mapping.
    pub kind: TextureType,
    /// Attribute `colorspace`.
    pub colorspace: ColorSpace,
    /// Attribute `file`.
    pub file: Option<FileImage>,
    /// Attributes `fileright`, `fileleft`, `fileup`, `filedown`, `filefront`, `fileback`.
    pub cubefiles: [Option<FileImage>; 6],
    /// Attribute `content_type`, empty to go by the extension.
    pub content_type: String,
    /// Rows and columns of the grid of cube faces in `file`.
    pub gridsize: [usize; 2],
    /// Face symbols of the grid, row by row, out of `.RLUDFB`.
    pub gridlayout: String,
    /// Computed pattern.
    pub builtin: Builtin,
    /// Marks on a computed pattern.
    pub mark: Mark,
    /// First colour, \[0, 1\].
    pub rgb1: [f64; 3],
    /// Second colour.
    pub rgb2: [f64; 3],
    /// Colour of marks.
    pub markrgb: [f64; 3],
    /// Probability of a random dot.
    pub random: f64,
    /// Width of a computed texture in pixels.
    pub width: usize,
    /// Height of a computed image; cubes derive it.
    pub height: usize,
    /// Flip each image left to right.
    pub hflip: bool,
    /// Flip each image upside down.
    pub vflip: bool,
    /// Channels of images: 1, 3 or 4. Cubes and computed textures need 3.
    pub nchannel: usize,
}

impl Default for TextureSource {
    fn default() -> Self {
        Self {
            name: String::new(),
            kind: TextureType::Cube,
            colorspace: ColorSpace::Auto,
            file: None,
            cubefiles: Default::default(),
            content_type: String::new(),
            gridsize: [1, 1],
            gridlayout: "............".into(),
            builtin: Builtin::None,
            mark: Mark::None,
            rgb1: [0.8; 3],
            rgb2: [0.5; 3],
            markrgb: [0.0; 3],
            random: 0.01,
            width: 0,
            height: 0,
            hflip: false,
            vflip: false,
            nchannel: 3,
        }
    }
}
