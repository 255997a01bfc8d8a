//! A video of what a session shows.

use crate::drawing::Drawing;
use crate::session::Session;
use std::path::{Path, PathBuf};
use video::{Frame, VideoWriter};

/// Columns and rows.
const SIZE: [usize; 2] = [640, 480];
/// Frames for a second of simulated time.
const RATE: f64 = 30.0;
/// Names of files that are tried.
const MOST: usize = 10_000;
/// A share of a frame by which its time may be missed, since times are sums of rounded steps.
const EARLY: f64 = 1e-6;

/// A video that is being written, drawn by the CPU whatever draws the window.
pub(super) struct Film {
    drawing: Drawing,
    writer: VideoWriter,
    path: PathBuf,
    /// Simulated time of the next frame \[s\].
    due: f64,
}

impl Film {
    /// Begins `video.mp4`, or the next free name, in the folder where the program runs.
    pub(super) fn begin_new(session: &Session) -> Result<Self, String> {
        let names = (0..MOST).map(|i| if i == 0 { "video.mp4".into() } else { format!("video-{i}.mp4") });
        let free = names.map(PathBuf::from).find(|path| !path.exists());
        Film::begin(session, &free.ok_or_else(|| format!("there are {MOST} videos here already"))?)
    }

    /// Begins a video with the present state. The ending of the file decides its format: `.mp4`, `.gif` or `.png`.
    pub(super) fn begin(session: &Session, path: &Path) -> Result<Self, String> {
        let drawing = Drawing::new(session.model()).map_err(|error| error.to_string())?;
        let size = SIZE.map(|side| side as u32).into();
        let writer = VideoWriter::create(path, size, RATE).map_err(|error| error.to_string())?;
        let mut film = Film { drawing, writer, path: path.to_owned(), due: session.data().time() };
        film.show(session)?;
        Ok(film)
    }

    /// Adds the present state as often as frames are due; where time went back, filming goes on from there.
    pub(super) fn show(&mut self, session: &Session) -> Result<(), String> {
        let (time, period) = (session.data().time(), 1.0 / RATE);
        if time < self.due - 2.0 * period {
            self.due = time;
        }
        if time < self.due - EARLY * period {
            return Ok(());
        }
        let picture = self.drawing.draw(session, SIZE).map_err(|error| error.to_string())?;
        let [width, height] = SIZE.map(|side| side as u32);
        let frame = Frame::new(width, height, &picture.rgb).map_err(|error| error.to_string())?;
        while time >= self.due - EARLY * period {
            self.writer.push(&frame).map_err(|error| error.to_string())?;
            self.due += period;
        }
        Ok(())
    }

    /// Completes the file, and says what it holds.
    pub(super) fn finish(self) -> Result<String, String> {
        let frames = self.writer.frames();
        self.writer.finish().map_err(|error| error.to_string())?;
        Ok(format!("{frames} frames in {}", self.path.display()))
    }
}
