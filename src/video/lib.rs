//! Frames in, files and terminals out, in pure Rust.
//!
//! | what | how | notes |
//! |---|---|---|
//! | pictures | [`write_png`], [`write_depth_png`] | 8-bit RGB; 16-bit millimetres |
//! | depth and segmentation in colours | [`depth_image`], [`segmentation_image`] | fixed palettes |
//! | videos | [`VideoWriter`] | `.mp4` (H.264), `.gif`, `.png` (animated PNG) by extension |
//! | contact sheets | [`Sheet`] | a grid of pictures with captions |
//! | terminals | [`terminal::preview`] | Kitty, Sixel, iTerm2, half blocks |
//!
//! Every file appears under its name only when it is complete: it is written as a hidden file beside the target and renamed. A
//! [`VideoWriter`] needs no more memory for a long video than for a short one, but for 4 bytes a frame in MP4.
//!
//! ```
//! use robohive_video::{Frame, VideoWriter};
//!
//! let folder = std::env::temp_dir().join(format!("robohive-video-{}", std::process::id()));
//! std::fs::create_dir_all(&folder)?;
//! let path = folder.join("fade.mp4");
//! let mut video = VideoWriter::create(&path, (64, 48), 25.0)?;
//! for brightness in 0..50 {
//!     let pixels = [5 * brightness, 90, 120].repeat(64 * 48);
//!     video.push(&Frame::new(64, 48, &pixels)?)?;
//! }
//! video.finish()?;
//! assert!(path.is_file());
//! # std::fs::remove_dir_all(folder)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod animated_gif;
mod animated_png;
mod changes;
mod error;
mod false_colour;
mod frame;
mod h264;
mod label;
mod limits;
mod mp4;
mod palette;
mod png_file;
mod scale;
mod sheet;
pub mod terminal;
mod unfinished;
mod writer;
mod yuv;

pub use error::VideoError;
pub use false_colour::{
    DEPTH_COLOURS, NO_DEPTH, NO_SEGMENT, depth_image, depth_range, object_number, segment_colour,
    segmentation_image,
};
pub use frame::{Frame, Image};
pub use limits::{FRAME_RATES, MAX_SIDE};
pub use png_file::{encode_png, png_bytes, write_depth_png, write_png};
pub use sheet::Sheet;
pub use writer::{VideoFormat, VideoWriter};
