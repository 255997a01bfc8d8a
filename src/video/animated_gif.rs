//! Videos as GIF 89a, which every browser plays.

use std::io::{self, Write};

use gif::{Encoder, EncodingError, Repeat};

use crate::changes::Changes;
use crate::frame::Frame;
use crate::palette::indexed;

/// Units of time a second; a GIF counts in hundredths.
const UNITS: f64 = 100.0;

/// Fewest units that a frame is shown: players slow faster videos down to ten frames a second.
const SHORTEST: u64 = 2;

/// Writes a video frame by frame, repeated without end. Of each frame the rectangle that changed is stored, with a palette
/// of its own.
///
/// Frame i begins at `100 i / rate` hundredths of a second, rounded down. A video of more than 50 frames a second plays at its own
/// speed too: of frames that would be shown for less than 0.02 s only one is kept.
pub(crate) struct GifWriter<W: Write> {
    encoder: Encoder<W>,
    frames_per_second: f64,
    changes: Changes,
    /// Frames pushed.
    pushed: u64,
    /// Units of time taken by the frames written.
    written: u64,
}

impl<W: Write> GifWriter<W> {
    /// Writes the beginning of the file.
    pub(crate) fn new(out: W, (width, height): (u32, u32), frames_per_second: f64) -> io::Result<Self> {
        // Frame sizes are at most 16384.
        let mut encoder = Encoder::new(out, width as u16, height as u16, &[]).map_err(into_io)?;
        encoder.set_repeat(Repeat::Infinite).map_err(into_io)?;
        Ok(GifWriter { encoder, frames_per_second, changes: Changes::default(), pushed: 0, written: 0 })
    }

    /// Adds a frame.
    pub(crate) fn push(&mut self, frame: &Frame<'_>) -> io::Result<()> {
        self.pushed += 1;
        let end = (self.pushed as f64 * UNITS / self.frames_per_second) as u64;
        let mut shown = end.saturating_sub(self.written);
        // The first frame is kept in any case, so that a video has one.
        if self.written == 0 {
            shown = shown.max(SHORTEST);
        }
        if shown < SHORTEST {
            return Ok(());
        }
        self.written += shown;
        let change = self.changes.next(frame);
        let part = change.image.frame();
        let indexed = indexed(&part);
        self.encoder
            .write_frame(&gif::Frame {
                left: change.left as u16,
                top: change.top as u16,
                width: part.width() as u16,
                height: part.height() as u16,
                delay: shown as u16,
                dispose: gif::DisposalMethod::Keep,
                palette: Some(indexed.palette.into_flattened()),
                buffer: indexed.indices.into(),
                ..gif::Frame::default()
            })
            .map_err(into_io)
    }

    /// Writes the end of the file and returns the writer.
    pub(crate) fn finish(self) -> io::Result<W> {
        self.encoder.into_inner().map_err(into_io)
    }
}

fn into_io(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}
