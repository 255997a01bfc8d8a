//! What is written to files while a session goes on.

use crate::session::Session;
use physics::{Data, Model, step};
use record::{Kept, RecordError, Recording, StateRecording};
use std::fmt;
use std::path::{Path, PathBuf};

/// Episodes of an environment that are being recorded.
pub(crate) struct EpisodeTape {
    recording: Recording,
    path: PathBuf,
    /// The present episode, unless it had begun before the recording.
    episode: Option<Kept>,
}

/// States of a simulation that are being recorded.
pub(crate) struct StateTape {
    recording: StateRecording,
    path: PathBuf,
}

/// A recording that goes on, or has ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Recorded {
    /// The file.
    pub path: PathBuf,
    /// Its states, or its finished episodes.
    pub count: u64,
    /// What is counted.
    pub unit: &'static str,
}

impl fmt::Display for Recorded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} in {}", self.count, self.unit, self.path.display())
    }
}

impl StateTape {
    pub(crate) fn new(path: &Path, data: &Data) -> Result<Self, String> {
        let recording = StateRecording::create(path, data).map_err(|error| unwritable(path, &error))?;
        Ok(StateTape { recording, path: path.to_owned() })
    }

    /// A step starts from `data`.
    pub(crate) fn before(&mut self, data: &Data) -> Result<(), String> {
        self.recording.state(data).map_err(|error| unwritable(&self.path, &error))
    }

    /// The step was taken, or failed.
    pub(crate) fn after(&mut self, data: &Data, taken: bool) -> Result<(), String> {
        self.recording.measurements(data, taken).map_err(|error| unwritable(&self.path, &error))
    }

    pub(crate) fn so_far(&self) -> Recorded {
        Recorded { path: self.path.clone(), count: self.recording.rows(), unit: "states" }
    }

    /// Adds the last state, with what a step from it would measure, and completes the file.
    pub(crate) fn finish(mut self, model: &Model, data: &Data) -> Result<Recorded, String> {
        let mut last = data.clone();
        self.before(&last)?;
        let taken = step(model, &mut last).is_ok();
        self.after(&last, taken)?;
        let (path, count) = (self.path.clone(), self.recording.rows());
        self.recording.finish().map_err(|error| unwritable(&path, &error))?;
        Ok(Recorded { path, count, unit: "states" })
    }
}

fn unwritable(path: &Path, error: &dyn fmt::Display) -> String {
    format!("{}: {error}", path.display())
}

impl EpisodeTape {
    pub(crate) fn new(recording: Recording, path: &Path) -> Self {
        EpisodeTape { recording, path: path.to_owned(), episode: None }
    }

    /// An episode begins from the reset with `seed`; one that had begun and is not over is not kept.
    pub(crate) fn begin(&mut self, seed: u64) {
        self.episode = Some(Kept::new(seed));
    }

    /// An action is taken in the present state.
    pub(crate) fn row(&mut self, env: &env::Env, action: &[f64]) -> Result<(), RecordError> {
        self.episode.as_mut().map_or(Ok(()), |episode| episode.row(env, action))
    }

    /// The episode is over: the file has it from now on.
    pub(crate) fn end(&mut self, env: &env::Env) -> Result<(), RecordError> {
        let Some(mut episode) = self.episode.take() else { return Ok(()) };
        episode.row(env, &vec![f64::NAN; env.action_len()])?;
        self.recording.add(&episode)
    }

    pub(crate) fn so_far(&self) -> Recorded {
        Recorded { path: self.path.clone(), count: self.recording.episodes() as u64, unit: "episodes" }
    }

    /// Completes the file. An episode that is not over is not kept.
    pub(crate) fn finish(self) -> Result<Recorded, RecordError> {
        let (path, episodes, _) = self.recording.close()?;
        Ok(Recorded { path, count: episodes as u64, unit: "episodes" })
    }
}

impl Session {
    /// Begins to record: an environment's episodes, from the start of the next one on, into a recording in RoboHive's layout
    /// (`.h5` or `.npz`); else the state before every step, into a numpy archive. A recording that goes on is completed first.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn record(&mut self, path: &Path) -> Result<(), String> {
        self.stop_recording()?;
        match &mut self.play {
            Some(play) => play.record(path).map_err(|error| error.to_string()),
            None => {
                self.tape = Some(StateTape::new(path, &self.data)?);
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
    pub fn stop_recording(&mut self) -> Result<Option<Recorded>, String> {
        if let Some(tape) = self.tape.take() {
            return tape.finish(&self.model, &self.data).map(Some);
        }
        let ended = self.play.as_mut().map(|play| play.stop_recording()).transpose();
        ended.map(Option::flatten).map_err(|error| error.to_string())
    }
}
