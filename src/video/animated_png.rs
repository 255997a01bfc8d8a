//! Videos as animated PNG (ISO/IEC 15948:2024): lossless, and a still picture for what does not know animations.

use std::io::{self, Seek, SeekFrom, Write};

use crate::changes::{Change, Changes};
use crate::frame::Frame;
use crate::png_file::encode_png;

/// Bytes of the signature that begins a PNG.
const SIGNATURE: usize = 8;

/// Writes a video frame by frame, repeated without end. Of each frame the rectangle that changed is stored.
#[derive(Debug)]
pub(crate) struct ApngWriter<W> {
    out: W,
    changes: Changes,
    /// Seconds that a frame is shown, as a fraction.
    delay: (u16, u16),
    frames: u32,
    /// Number of the next chunk of the animation.
    sequence: u32,
    /// Where the chunk with the count of frames begins, once it is written.
    control: u64,
    /// The still picture that a frame is first compressed to.
    still: Vec<u8>,
}

impl<W: Write + Seek> ApngWriter<W> {
    /// A video at the beginning of an empty writer.
    pub(crate) fn new(out: W, frames_per_second: f64) -> Self {
        ApngWriter {
            out,
            changes: Changes::default(),
            delay: delay(frames_per_second),
            frames: 0,
            sequence: 0,
            control: 0,
            still: Vec::new(),
        }
    }

    /// Adds a frame; all frames have the size of the first.
    pub(crate) fn push(&mut self, frame: &Frame<'_>) -> io::Result<()> {
        self.still.clear();
        let change = self.changes.next(frame);
        encode_png(&mut self.still, &change.image.frame())?;
        if self.frames == 0 {
            self.begin()?;
        }
        let too_long = || io::Error::new(io::ErrorKind::FileTooLarge, "an animated PNG holds fewer frames");
        let next = self.frames.checked_add(1).ok_or_else(too_long)?;
        write_chunk(&mut self.out, b"fcTL", &frame_control(&change, self.sequence, self.delay))?;
        self.sequence = self.sequence.checked_add(1).ok_or_else(too_long)?;
        for (name, data) in chunks(&self.still) {
            if name != b"IDAT" {
                continue;
            }
            if self.frames == 0 {
                write_chunk(&mut self.out, b"IDAT", data)?;
            } else {
                let numbered = [&self.sequence.to_be_bytes(), data].concat();
                write_chunk(&mut self.out, b"fdAT", &numbered)?;
                self.sequence = self.sequence.checked_add(1).ok_or_else(too_long)?;
            }
        }
        self.frames = next;
        Ok(())
    }

    /// Writes the count of frames and the end of the file, and returns the writer.
    pub(crate) fn finish(mut self) -> io::Result<W> {
        write_chunk(&mut self.out, b"IEND", &[])?;
        self.out.seek(SeekFrom::Start(self.control))?;
        write_chunk(&mut self.out, b"acTL", &animation_control(self.frames))?;
        self.out.flush()?;
        Ok(self.out)
    }

    /// Writes what comes before the first frame; its still picture has the header.
    fn begin(&mut self) -> io::Result<()> {
        self.out.write_all(&self.still[..SIGNATURE])?;
        let mut position = SIGNATURE as u64;
        for (name, data) in chunks(&self.still).take_while(|(name, _)| *name != b"IDAT") {
            write_chunk(&mut self.out, name, data)?;
            position += data.len() as u64 + 12;
        }
        self.control = position;
        // Until the end is written the video claims no frames, which no reader accepts.
        write_chunk(&mut self.out, b"acTL", &animation_control(0))
    }
}

/// Count of frames, and 0 for a repetition without end.
fn animation_control(frames: u32) -> [u8; 8] {
    let [a, b, c, d] = frames.to_be_bytes();
    [a, b, c, d, 0, 0, 0, 0]
}

/// Number, size, offset and time of a part that replaces what was there and stays.
fn frame_control(change: &Change, sequence: u32, (seconds, parts): (u16, u16)) -> Vec<u8> {
    let part = change.image.frame();
    let place = [sequence, part.width(), part.height(), change.left, change.top].map(u32::to_be_bytes);
    let time = [seconds, parts].map(u16::to_be_bytes);
    [place.as_flattened(), time.as_flattened(), &[0, 0]].concat()
}

/// The time of a frame as the fraction with the largest parts that 16 bits hold.
fn delay(frames_per_second: f64) -> (u16, u16) {
    let most = f64::from(u16::MAX);
    let seconds = (most / frames_per_second).floor().min(most).clamp(1.0, 1000.0);
    (seconds as u16, (seconds * frames_per_second).round() as u16)
}

/// Name and data of each chunk of a PNG that this library has written.
fn chunks(png: &[u8]) -> impl Iterator<Item = (&[u8; 4], &[u8])> {
    let mut rest = &png[SIGNATURE..];
    std::iter::from_fn(move || {
        let (length, after) = rest.split_first_chunk::<4>()?;
        let (name, after) = after.split_first_chunk::<4>()?;
        let (data, after) = after.split_at_checked(u32::from_be_bytes(*length) as usize)?;
        rest = after.get(4..)?;
        Some((name, data))
    })
}

/// Writes length, name, data and check sum.
fn write_chunk(out: &mut impl Write, name: &[u8; 4], data: &[u8]) -> io::Result<()> {
    let mut sum = crc32fast::Hasher::new();
    sum.update(name);
    sum.update(data);
    out.write_all(&(data.len() as u32).to_be_bytes())?;
    out.write_all(name)?;
    out.write_all(data)?;
    out.write_all(&sum.finalize().to_be_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_of_a_frame_is_the_rate() {
        for rate in [0.1, 1.0, 12.5, 24.0, 25.0, 1.0 / 0.03, 60.0, 62.5, 500.0, 1000.0] {
            let (seconds, parts) = delay(rate);
            let found = f64::from(parts) / f64::from(seconds);
            assert!((found / rate - 1.0).abs() < 1e-4, "{rate}: {seconds}/{parts}");
        }
    }
}
