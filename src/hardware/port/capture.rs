//! Sources of frames: requests to a camera, and the frames that it sends.

use robot::Fault;
use std::fmt;
use std::io;
use std::time::Duration;

/// Encoding of pixels in the bytes of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Two pixels in four bytes: brightness, blue, brightness, red.
    Yuyv,
    /// Two pixels in four bytes: blue, brightness, red, brightness.
    Uyvy,
    /// A JPEG picture, whose Huffman tables may be left out.
    Mjpg,
    /// Depth, 16 bits a pixel, little-endian.
    Z16,
}

impl Encoding {
    /// Encodings of colours, in order of preference: uncompressed ones first.
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

    /// Bytes of a frame of `pixels` pixels; `None` where the size varies.
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

/// Format of the frames of a stream.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Format {
    /// Encoding of the bytes.
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

/// The stream that is requested from a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// The camera.
    pub source: Source,
    /// Accepted encodings, in order of preference.
    pub encodings: Vec<Encoding>,
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Frames a second.
    pub rate: f64,
}

/// A frame as received.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// Its bytes.
    pub bytes: &'a [u8],
    /// Its number in the camera's count, which wraps around at 2³².
    pub sequence: u32,
    /// Time at which it was taken \[s\], on the clock of the camera's driver.
    pub time: f64,
    /// The driver says that bytes of it are missing.
    pub damaged: bool,
}

/// A stream of frames.
pub trait Capture: Send {
    /// Format of the frames.
    fn format(&self) -> Format;

    /// Whether the exposure of the first frames has to settle.
    fn settles(&self) -> bool {
        true
    }

    /// The next frame, in order; waits for it up to `wait`. `None` if it does not come.
    ///
    /// # Errors
    /// The camera is gone.
    fn next(&mut self, wait: Duration) -> io::Result<Option<Frame<'_>>>;
}

/// Opens cameras.
pub trait Captures: Send + Sync {
    /// Begins the requested stream of the camera that a config calls `name`.
    ///
    /// # Errors
    /// There is no such camera, it is in use, or it does not support the request; the error lists what it supports.
    fn open(&self, name: &str, request: &Request) -> Result<Box<dyn Capture>, Fault>;
}

/// For simulated devices without simulated cameras.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NoCaptures;

impl Captures for NoCaptures {
    fn open(&self, _: &str, request: &Request) -> Result<Box<dyn Capture>, Fault> {
        Err(Fault::Unreachable(format!("there is no simulated camera for {}", request.source)))
    }
}
