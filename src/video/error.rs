//! What goes wrong with pictures and videos, in sentences that say what to do about it.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use crate::limits::{FRAME_RATES, MAX_SIDE};

/// Why a picture or video could not be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum VideoError {
    /// A side of zero pixels or of more than [`MAX_SIDE`].
    Size {
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A buffer that does not hold `width * height` pixels.
    Length {
        /// What the buffer holds: "RGB", "depth" or "segmentation".
        what: &'static str,
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Elements that such a picture has.
        expected: usize,
        /// Elements of the buffer.
        found: usize,
    },
    /// A depth range that is empty or not finite.
    DepthRange {
        /// Distance drawn in the first colour \[m\].
        near: f32,
        /// Distance drawn in the last colour \[m\].
        far: f32,
    },
    /// A contact sheet without cells, or one too large for a picture.
    SheetSize {
        /// Cells a row.
        columns: u32,
        /// Width and height of a cell in pixels.
        cell: (u32, u32),
        /// Pictures on the sheet.
        pictures: usize,
    },
    /// A frame whose size differs from the video's.
    SizeChanged {
        /// The video.
        path: PathBuf,
        /// Number of the frame, from 0.
        index: u64,
        /// Width and height of the video.
        expected: (u32, u32),
        /// Width and height of the frame.
        found: (u32, u32),
    },
    /// A size that the format cannot hold.
    FormatSize {
        /// The video.
        path: PathBuf,
        /// Width and height of the video.
        size: (u32, u32),
        /// What the format can hold.
        limit: &'static str,
    },
    /// A rate outside of the supported range.
    FrameRate {
        /// Frames per second.
        value: f64,
    },
    /// A file name whose extension names no format.
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// A video that was finished without a frame.
    NoFrames {
        /// The video.
        path: PathBuf,
    },
    /// The target exists and is a folder or a device.
    NotAFile {
        /// The target.
        path: PathBuf,
    },
    /// The file system refuses.
    Io {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// An earlier frame failed, so that the video has a gap.
    Broken {
        /// The video.
        path: PathBuf,
    },
    /// An encoder refuses its input.
    Encoder {
        /// The file.
        path: PathBuf,
        /// What the encoder says.
        reason: String,
    },
}

impl VideoError {
    /// Names the file that an operation failed on.
    pub(crate) fn io(path: &Path) -> impl FnOnce(io::Error) -> VideoError + '_ {
        move |error| VideoError::Io { path: path.to_owned(), error }
    }
}

/// What to do when the file system refuses.
fn remedy(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::NotFound => "create the folder first, or choose another one",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "choose a folder that you may write to"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            "free some space on this disk, or choose another one; no incomplete file was left"
        }
        io::ErrorKind::NotADirectory => "a part of this path is a file; choose a folder",
        _ => "check the path and the disk",
    }
}

impl fmt::Display for VideoError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            VideoError::Size { width, height } => write!(
                f,
                "A picture of {width} x {height} pixels is not supported; give each side 1 to {MAX_SIDE} pixels."
            ),
            VideoError::Length { what, width, height, expected, found } => write!(
                f,
                "The {what} buffer has {found} elements, but a picture of {width} x {height} pixels has {expected}; \
                 pass a buffer and the size that it was drawn with."
            ),
            VideoError::DepthRange { near, far } => write!(
                f,
                "The depth range from {near} to {far} m is empty or not finite; give two finite distances, the \
                 smaller one first."
            ),
            VideoError::SheetSize { columns, cell, pictures } => write!(
                f,
                "A sheet of {pictures} pictures in {columns} columns of {} x {} pixels has no cells or a side of more \
                 than {MAX_SIDE} pixels; choose 1 column or more, smaller cells, or several sheets.",
                cell.0, cell.1
            ),
            VideoError::SizeChanged { path, index, expected, found } => write!(
                f,
                "{}: frame {index} has {} x {} pixels, but the video has {} x {}; draw all frames of a video in one \
                 size.",
                path.display(),
                found.0,
                found.1,
                expected.0,
                expected.1
            ),
            VideoError::FormatSize { path, size, limit } => write!(
                f,
                "{}: a video of {} x {} pixels does not fit into this format, which holds {limit}; draw smaller \
                 frames, or choose .png for an animated PNG.",
                path.display(),
                size.0,
                size.1
            ),
            VideoError::FrameRate { value } => write!(
                f,
                "A rate of {value} frames per second is not supported; give a number from {} to {}.",
                FRAME_RATES.start(),
                FRAME_RATES.end()
            ),
            VideoError::UnknownFormat { path } => write!(
                f,
                "{}: the extension names no video format; use .mp4 (H.264), .gif or .png (animated PNG).",
                path.display()
            ),
            VideoError::NoFrames { path } => write!(
                f,
                "{}: the video has no frame, so no file was written; push at least one before finishing.",
                path.display()
            ),
            VideoError::NotAFile { path } => write!(
                f,
                "{} is a folder or a device; give the name of a file to create or replace.",
                path.display()
            ),
            VideoError::Io { path, error } => {
                write!(f, "{} cannot be written ({error}); {}.", path.display(), remedy(error))
            }
            VideoError::Broken { path } => write!(
                f,
                "{}: an earlier frame could not be written, so this video is abandoned; correct that error and write \
                 the video from its first frame.",
                path.display()
            ),
            VideoError::Encoder { path, reason } => write!(
                f,
                "{}: the encoder refuses a frame ({reason}); try another format (.mp4, .gif or .png).",
                path.display()
            ),
        }
    }
}

impl std::error::Error for VideoError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            VideoError::Io { error, .. } => Some(error),
            _ => None,
        }
    }
}
