//! What is written to files while a session goes on.

use physics::{Data, Model, step};
use record::{Kept, RecordError, Recording, StateRecording};
use std::fmt;
use std::io;
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
    pub(crate) fn new(path: &Path, data: &Data) -> io::Result<Self> {
        Ok(StateTape { recording: StateRecording::create(path, data)?, path: path.to_owned() })
    }

    /// A step starts from `data`.
    pub(crate) fn before(&mut self, data: &Data) -> io::Result<()> {
        self.recording.state(data)
    }

    /// The step was taken, or failed.
    pub(crate) fn after(&mut self, data: &Data, taken: bool) -> io::Result<()> {
        self.recording.measurements(data, taken)
    }

    pub(crate) fn so_far(&self) -> Recorded {
        Recorded { path: self.path.clone(), count: self.recording.rows(), unit: "states" }
    }

    /// Adds the last state, with what a step from it would measure, and completes the file.
    pub(crate) fn finish(mut self, model: &Model, data: &Data) -> io::Result<Recorded> {
        let mut last = data.clone();
        self.before(&last)?;
        let taken = step(model, &mut last).is_ok();
        self.after(&last, taken)?;
        let count = self.recording.finish()?;
        Ok(Recorded { path: self.path, count, unit: "states" })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }
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
