//! Where frames come from: what a camera is asked for, and what it sends.

use robot::Fault;
use std::fmt;
use std::io;
use std::time::Duration;

/// How the bytes of a frame stand for pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Two pixels in four bytes: brightness, blue, brightness, red.
    Yuyv,
    /// Two pixels in four bytes: blue, brightness, red, brightness.
    Uyvy,
    /// A JPEG picture, whose Huffman tables may be left out.
    Mjpg,
    /// Depth, 16 bits a pixel, lowest byte first.
    Z16,
}

impl Encoding {
    /// Those of colours, in the order in which they are preferred: those without loss before the other.
    pub const COLOURS: [Encoding; 3] = [Encoding::Yuyv, Encoding::Uyvy, Encoding::Mjpg];

    /// Its four characters in Video4Linux.
    pub fn fourcc(self) -> &'static [u8; 4] {
        match self {
            Encoding::Yuyv => b"YUYV",
            Encoding::Uyvy => b"UYVY",
            Encoding::Mjpg => b"MJPG",
            Encoding::Z16 => b"Z16 ",
        }
    }

    /// Bytes of a frame of so many pixels; `None` where they differ.
    pub fn bytes(self, pixels: usize) -> Option<usize> {
        (self != Encoding::Mjpg).then_some(2 * pixels)
    }
}

impl fmt::Display for Encoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Encoding::Yuyv => "yuyv",
            Encoding::Uyvy => "uyvy",
            Encoding::Mjpg => "mjpg",
            Encoding::Z16 => "z16",
        })
    }
}

/// What the frames of a stream are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Format {
    /// Of the bytes.
    pub encoding: Encoding,
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Frames a second.
    pub rate: f64,
}

/// Which camera.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Source {
    /// A device node.
    Node(String),
    /// A RealSense with this serial number on the USB bus, or the only one.
    RealSense(Option<String>),
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Source::Node(path) => f.write_str(path),
            Source::RealSense(Some(serial)) => write!(f, "the RealSense with serial number {serial}"),
            Source::RealSense(None) => f.write_str("the RealSense"),
        }
    }
}

/// What is asked of a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Where it is.
    pub source: Source,
    /// The encodings that will do, the best first.
    pub encodings: Vec<Encoding>,
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Frames a second.
    pub rate: f64,
}

/// A frame as it came.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// Its bytes.
    pub bytes: &'a [u8],
    /// Its number in the camera's count, which goes round at 2³².
    pub sequence: u32,
    /// When it was taken, by the camera's driver \[s\].
    pub time: f64,
    /// The driver says that bytes of it are missing.
    pub damaged: bool,
}

/// A stream of frames.
pub trait Capture: Send {
    /// What the frames are.
    fn format(&self) -> Format;

    /// Whether the first frames are too dark or too light, until exposure has settled.
    fn settles(&self) -> bool {
        true
    }

    /// The next frame, in their order; waits for it this long. `None` if it does not come.
    ///
    /// # Errors
    /// The camera is gone.
    fn next(&mut self, wait: Duration) -> io::Result<Option<Frame<'_>>>;
}

/// Opens cameras.
pub trait Captures: Send + Sync {
    /// Begins the stream that is asked for, of the camera that a config calls `name`.
    ///
    /// # Errors
    /// There is no such camera, it is in use, or it cannot do that: what it can.
    fn open(&self, name: &str, request: &Request) -> Result<Box<dyn Capture>, Fault>;
}

/// Where devices are simulated, but no cameras.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NoCaptures;

impl Captures for NoCaptures {
    fn open(&self, _: &str, request: &Request) -> Result<Box<dyn Capture>, Fault> {
        Err(Fault::Unreachable(format!("no simulated camera is in the place of {}", request.source)))
    }
}
