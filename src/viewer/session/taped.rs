//! What a session writes to a file while it goes on.

use super::Session;
use crate::play::PlayError;
use crate::tape::{Recorded, StateTape};
use std::path::{Path, PathBuf};
use std::{fmt, io};

/// Why a recording cannot begin or end.
#[derive(Debug)]
pub enum TapeError {
    /// The file of states cannot be written.
    File(PathBuf, io::Error),
    /// The file of episodes cannot be written.
    Episodes(PlayError),
}

impl fmt::Display for TapeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TapeError::File(path, error) => write!(f, "{}: {error}", path.display()),
            TapeError::Episodes(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for TapeError {}

impl Session {
    /// Begins to record: an environment's episodes, from the start of the next one on, into a recording in RoboHive's layout
    /// (`.h5` or `.npz`); else the state before every step, into a numpy archive. A recording that goes on is completed first.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn record(&mut self, path: &Path) -> Result<(), TapeError> {
        self.stop_recording()?;
        match &mut self.play {
            Some(play) => play.record(path).map_err(TapeError::Episodes),
            None => {
                let tape = StateTape::new(path, &self.data);
                self.tape = Some(tape.map_err(|error| TapeError::File(path.to_owned(), error))?);
                Ok(())
            }
        }
    }

    /// The recording that goes on.
    pub fn recording(&self) -> Option<Recorded> {
        let episodes = self.play.as_ref().and_then(|play| play.recording());
        episodes.or_else(|| self.tape.as_ref().map(StateTape::so_far))
    }

    /// Completes the recording that goes on, if there is one.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn stop_recording(&mut self) -> Result<Option<Recorded>, TapeError> {
        if let Some(tape) = self.tape.take() {
            let path = tape.path().to_owned();
            let finished = tape.finish(&self.model, &self.data);
            return finished.map(Some).map_err(|error| TapeError::File(path, error));
        }
        let ended = self.play.as_mut().map(|play| play.stop_recording()).transpose();
        ended.map(Option::flatten).map_err(TapeError::Episodes)
    }

    /// Completes the recording before something else takes the place of what it is of. Why it is not complete, if it is not.
    pub(super) fn end_recording(&mut self) -> Option<String> {
        self.stop_recording().err().map(|error| error.to_string())
    }
}

impl Drop for Session {
    /// A recording that goes on is completed. Of one that cannot be, the parts stay beside the file.
    fn drop(&mut self) {
        let _ = self.stop_recording();
    }
}
