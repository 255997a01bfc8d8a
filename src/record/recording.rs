//! Recordings of an environment's episodes, under the names that RoboHive's logger gives its rows.

use crate::SEED;
use crate::error::RecordError;
use crate::kept::Kept;
use crate::row::{push_row, set_drawn};
use dataset::trace::{Layout, Precision, Recorder, Trial};
use dataset::{Array, Values};
use env::Env;
use std::path::{Path, PathBuf};

/// A file of episodes that is being written.
pub struct Recording {
    recorder: Recorder,
    path: PathBuf,
    episodes: usize,
    images: bool,
}

impl Recording {
    /// Makes the file.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn create(
        path: &Path,
        layout: Layout,
        precision: Precision,
        attributes: &[(&str, &str)],
    ) -> Result<Self, RecordError> {
        let recorder = Recorder::create_with(path, layout, precision, attributes)?;
        Ok(Recording { recorder, path: path.to_owned(), episodes: 0, images: false })
    }

    /// Records the images of the visual keys too.
    pub fn with_images(self) -> Self {
        Recording { images: true, ..self }
    }

    /// Begins the next episode, which starts from the reset with `seed`. Without [`EpisodeRecording::finish`] it is not
    /// kept.
    ///
    /// # Errors
    /// Writing fails.
    pub fn begin(&mut self, seed: u64) -> Result<EpisodeRecording<'_>, RecordError> {
        let mut trial = self.recorder.begin(&format!("Trial{}", self.episodes))?;
        let seed = Array { shape: Vec::new(), values: Values::U64(vec![seed]) };
        trial.set(SEED, &seed)?;
        Ok(EpisodeRecording { trial, episodes: &mut self.episodes, images: self.images, rows: 0 })
    }

    /// Adds an episode that was kept in memory.
    ///
    /// # Errors
    /// Writing fails, or a number does not fit the precision.
    pub fn add(&mut self, episode: &Kept) -> Result<(), RecordError> {
        let mut recording = self.begin(episode.seed())?;
        episode.write(&mut recording.trial)?;
        recording.trial.finish()?;
        *recording.episodes += 1;
        Ok(())
    }

    /// Finished episodes so far.
    pub fn episodes(&self) -> usize {
        self.episodes
    }

    /// Completes the file: where it is, its finished episodes, and the names that had no place in its layout.
    ///
    /// # Errors
    /// Writing fails.
    pub fn close(self) -> Result<(PathBuf, usize, Vec<String>), RecordError> {
        let unmapped = self.recorder.unmapped().map(str::to_owned).collect();
        self.recorder.close()?;
        Ok((self.path, self.episodes, unmapped))
    }
}

/// An episode that is being recorded.
pub struct EpisodeRecording<'a> {
    trial: Trial<'a>,
    episodes: &'a mut usize,
    images: bool,
    rows: usize,
}

impl EpisodeRecording<'_> {
    /// Adds the row of the current state and of the action that is taken in it.
    ///
    /// # Errors
    /// Writing fails, a number does not fit the precision, or an image cannot be drawn.
    pub fn row(&mut self, env: &mut Env, action: &[f64]) -> Result<(), RecordError> {
        if self.images {
            env.exteroception()?;
        }
        if self.rows == 0 {
            set_drawn(&mut self.trial, env)?;
        }
        self.rows += 1;
        Ok(push_row(&mut self.trial, env, action)?)
    }

    /// Completes the episode with the row of its last state, in which no action is taken. An HDF5 file holds it from then
    /// on, whatever ends the process.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(mut self, env: &mut Env) -> Result<(), RecordError> {
        self.row(env, &vec![f64::NAN; env.action_len()])?;
        self.trial.finish()?;
        *self.episodes += 1;
        Ok(())
    }
}
