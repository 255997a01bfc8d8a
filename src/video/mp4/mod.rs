//! Videos in the ISO base media file format (ISO/IEC 14496-12), one H.264 track (ISO/IEC 14496-15).
//!
//! Samples go to the disk as they come; the tables that describe them follow at the end. What grows with the length of
//! a video is 4 bytes a frame and 4 bytes a key frame.

mod header;
mod samples;
mod tree;

use std::io::{self, Seek, SeekFrom, Write};

use crate::h264::{ParameterSets, Sample};
use samples::Samples;

pub(crate) use samples::Shape;

/// Writes a video sample by sample.
#[derive(Debug)]
pub(crate) struct Mp4Writer<W> {
    out: W,
    shape: Shape,
    samples: Samples,
    /// Bytes written.
    position: u64,
    /// Where the box of the samples begins.
    media: u64,
}

impl<W: Write + Seek> Mp4Writer<W> {
    /// Writes the beginning of the file to an empty writer.
    pub(crate) fn new(mut out: W, shape: Shape) -> io::Result<Self> {
        let kind = header::file_type();
        out.write_all(&kind)?;
        // Length 1 says that the true one follows in 8 bytes. It is filled in at the end: until then it is 0, which no
        // reader takes for a video.
        out.write_all(&[0, 0, 0, 1])?;
        out.write_all(b"mdat")?;
        out.write_all(&[0; 8])?;
        let media = kind.len() as u64;
        let samples = Samples { start: media + 16, ..Samples::default() };
        Ok(Mp4Writer { out, shape, position: samples.start, samples, media })
    }

    /// Adds a frame.
    pub(crate) fn push(&mut self, sample: &Sample) -> io::Result<()> {
        let too_long =
            || io::Error::new(io::ErrorKind::FileTooLarge, "a video holds at most 4294967295 frames");
        let number = u32::try_from(self.samples.sizes.len() + 1).map_err(|_| too_long())?;
        self.out.write_all(&sample.bytes)?;
        self.position += sample.bytes.len() as u64;
        self.samples.sizes.push(sample.bytes.len() as u32);
        if sample.key {
            self.samples.keys.push(number);
        }
        Ok(())
    }

    /// Writes the tables and returns the writer.
    pub(crate) fn finish(mut self, sets: &ParameterSets) -> io::Result<W> {
        self.out.write_all(&header::movie(&self.shape, &self.samples, sets))?;
        self.out.seek(SeekFrom::Start(self.media + 8))?;
        self.out.write_all(&(self.position - self.media).to_be_bytes())?;
        self.out.flush()?;
        Ok(self.out)
    }
}
