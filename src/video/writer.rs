//! Videos: frames in, one file out.

use std::fmt;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use crate::animated_gif::GifWriter;
use crate::animated_png::ApngWriter;
use crate::error::VideoError;
use crate::frame::{Frame, pixels};
use crate::h264::{self, FrameEncoder};
use crate::limits::FRAME_RATES;
use crate::mp4::{Mp4Writer, Shape};
use crate::unfinished::UnfinishedFile;
use crate::yuv::even;

/// Bytes gathered before they go to the disk.
const BUFFER: usize = 1 << 18;

/// What a video is stored as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum VideoFormat {
    /// H.264 in MP4, extension `.mp4`: small, plays everywhere. Sides are rounded up to even numbers.
    Mp4,
    /// GIF, extension `.gif`: plays in every browser, 256 colours a frame, at most 50 frames a second.
    Gif,
    /// Animated PNG, extension `.png`: lossless, large.
    Apng,
}

impl VideoFormat {
    /// The format that an extension names, in letters of either case.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        [("mp4", VideoFormat::Mp4), ("gif", VideoFormat::Gif), ("png", VideoFormat::Apng)]
            .into_iter()
            .find_map(|(name, format)| name.eq_ignore_ascii_case(extension).then_some(format))
    }
}

/// Writes a video frame by frame; memory does not grow with its length, but for 4 bytes a frame in MP4.
///
/// The file has its name only after [`finish`](Self::finish). Until then it is a hidden one beside it,
/// `.NAME.0.unfinished`, which a writer that is dropped removes.
pub struct VideoWriter {
    path: PathBuf,
    size: (u32, u32),
    frames: u64,
    /// None after a failure: a video with a gap is not continued.
    video: Option<Stream>,
}

type Out = BufWriter<UnfinishedFile>;

enum Stream {
    Mp4 { encoder: Box<FrameEncoder>, out: Mp4Writer<Out> },
    Gif(GifWriter<Out>),
    Apng(ApngWriter<Out>),
}

/// Why a video does not go on.
enum Failure {
    Io(io::Error),
    Encoder(String),
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Failure::Io(error)
    }
}

impl VideoWriter {
    /// Begins a video of frames of `width` x `height` pixels, shown at [`FRAME_RATES`](crate::FRAME_RATES) frames a second; the extension of
    /// the path gives the format.
    ///
    /// MP4 holds pictures of at most 36864 blocks of 16 x 16 pixels (4096 x 2304) and stores even sides: the last column
    /// or row of an odd picture is repeated. The other formats take all sizes of [`Frame`].
    pub fn create(
        path: impl AsRef<Path>,
        (width, height): (u32, u32),
        frames_per_second: f64,
    ) -> Result<Self, VideoError> {
        let path = path.as_ref();
        let format =
            VideoFormat::of(path).ok_or_else(|| VideoError::UnknownFormat { path: path.to_owned() })?;
        pixels(width, height)?;
        if !FRAME_RATES.contains(&frames_per_second) {
            return Err(VideoError::FrameRate { value: frames_per_second });
        }
        if format == VideoFormat::Mp4 && !h264::fits(width, height) {
            let (path, size) = (path.to_owned(), (width, height));
            return Err(VideoError::FormatSize { path, size, limit: h264::LIMIT });
        }
        let out = BufWriter::with_capacity(BUFFER, UnfinishedFile::create(path)?);
        let video = Stream::begin(format, out, (width, height), frames_per_second)
            .map_err(|failure| explain(path, failure))?;
        Ok(VideoWriter { path: path.to_owned(), size: (width, height), frames: 0, video: Some(video) })
    }

    /// Adds a frame. After a failure to write, the video is abandoned: its unfinished file is gone and every further
    /// call fails. A frame of a wrong size is refused and leaves the video as it was.
    pub fn push(&mut self, frame: &Frame<'_>) -> Result<(), VideoError> {
        let found = (frame.width(), frame.height());
        if found != self.size {
            let (path, index, expected) = (self.path.clone(), self.frames, self.size);
            return Err(VideoError::SizeChanged { path, index, expected, found });
        }
        let Some(video) = &mut self.video else {
            return Err(VideoError::Broken { path: self.path.clone() });
        };
        if let Err(failure) = video.push(frame) {
            self.video = None;
            return Err(explain(&self.path, failure));
        }
        self.frames += 1;
        Ok(())
    }

    /// Frames pushed so far.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Completes the file and gives it its name, replacing a file of that name.
    pub fn finish(mut self) -> Result<(), VideoError> {
        let Some(video) = self.video.take() else {
            return Err(VideoError::Broken { path: self.path });
        };
        if self.frames == 0 {
            return Err(VideoError::NoFrames { path: self.path });
        }
        let out = video.finish().and_then(|out| out.into_inner().map_err(|error| error.into_error()));
        out.map_err(VideoError::io(&self.path))?.finish()
    }
}

impl fmt::Debug for VideoWriter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("VideoWriter");
        shown.field("path", &self.path).field("size", &self.size).field("frames", &self.frames);
        shown.finish_non_exhaustive()
    }
}

impl Stream {
    fn begin(
        format: VideoFormat,
        out: Out,
        (width, height): (u32, u32),
        frames_per_second: f64,
    ) -> Result<Self, Failure> {
        Ok(match format {
            VideoFormat::Mp4 => {
                let encoder = FrameEncoder::new(width, height, frames_per_second)
                    .map_err(|error| Failure::Encoder(error.to_string()))?;
                // A thousandth of a frame is the unit of time.
                let shape = Shape {
                    width: even(width),
                    height: even(height),
                    units_per_second: (frames_per_second * 1000.0).round() as u32,
                    units_per_sample: 1000,
                };
                Stream::Mp4 { encoder: Box::new(encoder), out: Mp4Writer::new(out, shape)? }
            }
            VideoFormat::Gif => Stream::Gif(GifWriter::new(out, (width, height), frames_per_second)?),
            VideoFormat::Apng => Stream::Apng(ApngWriter::new(out, frames_per_second)),
        })
    }

    fn push(&mut self, frame: &Frame<'_>) -> Result<(), Failure> {
        match self {
            Stream::Mp4 { encoder, out } => {
                let sample = encoder.encode(frame).map_err(Failure::Encoder)?;
                out.push(&sample)?;
            }
            Stream::Gif(out) => out.push(frame)?,
            Stream::Apng(out) => out.push(frame)?,
        }
        Ok(())
    }

    fn finish(self) -> io::Result<Out> {
        match self {
            Stream::Mp4 { encoder, out } => out.finish(encoder.parameter_sets()),
            Stream::Gif(out) => out.finish(),
            Stream::Apng(out) => out.finish(),
        }
    }
}

fn explain(path: &Path, failure: Failure) -> VideoError {
    let path = path.to_owned();
    match failure {
        Failure::Io(error) => VideoError::Io { path, error },
        Failure::Encoder(reason) => VideoError::Encoder { path, reason },
    }
}
