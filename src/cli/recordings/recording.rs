//! Recordings of an environment's episodes, under the names that RoboHive's logger gives its rows.

use crate::failure::Failure;
use clap::ValueEnum;
use dataset::Array;
use dataset::Values;
use dataset::trace::{Layout, Precision, Recorder, TraceError, Trial};
use env::{Env, Pixels, WorldState};
use std::path::{Path, PathBuf};

/// Names of rows in the files.
#[derive(Clone, Copy, ValueEnum)]
pub enum LayoutName {
    /// By environment: time, observations, actions, rewards, done, env_infos/...
    Robohive,
    /// By robot: data/..., derived/..., config/...
    Roboset,
}

impl From<LayoutName> for Layout {
    fn from(name: LayoutName) -> Self {
        match name {
            LayoutName::Robohive => Layout::RoboHive,
            LayoutName::Roboset => Layout::RoboSet,
        }
    }
}

/// Bits of numbers in the files.
#[derive(Clone, Copy, ValueEnum)]
pub enum PrecisionName {
    /// All bits
    Full,
    /// Uint8, int8, float16
    Reduced,
}

impl From<PrecisionName> for Precision {
    fn from(name: PrecisionName) -> Self {
        match name {
            PrecisionName::Full => Precision::Full,
            PrecisionName::Reduced => Precision::Reduced,
        }
    }
}

/// The attribute that holds the id of the environment.
pub const ID: &str = "env";
/// The attribute that says whose behaviour the environment had.
pub const COMPAT: &str = "compat";
/// The attribute that holds the settings that were changed, in TOML.
pub const SETTINGS: &str = "settings";
/// The dataset of a trial that holds the seed of its reset.
pub const SEED: &str = "seed";
/// The datasets of a trial that hold its states.
pub const STATE: &str = "env_infos/state/";

/// The datasets of a trial that hold what was drawn of the look of its scene.
pub const LOOK: &str = "visual_randomization/";
/// The datasets of a trial that hold its images.
const IMAGES: &str = "env_infos/visual_dict/";

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
    ) -> Result<Self, Failure> {
        let recorder = Recorder::create_with(path, layout, precision, attributes).map_err(Failure::new)?;
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
    pub fn begin(&mut self, seed: u64) -> Result<EpisodeRecording<'_>, Failure> {
        let mut trial = self.recorder.begin(&format!("Trial{}", self.episodes)).map_err(Failure::new)?;
        let seed = Array { shape: Vec::new(), values: Values::U64(vec![seed]) };
        trial.set(SEED, &seed).map_err(Failure::new)?;
        Ok(EpisodeRecording { trial, episodes: &mut self.episodes, images: self.images, rows: 0 })
    }

    /// Completes the file: where it is, its finished episodes, and the names that had no place in its layout.
    ///
    /// # Errors
    /// Writing fails.
    pub fn close(self) -> Result<(PathBuf, usize, Vec<String>), Failure> {
        let unmapped = self.recorder.unmapped().map(str::to_owned).collect();
        self.recorder.close().map_err(Failure::new)?;
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
    pub fn row(&mut self, env: &mut Env, action: &[f64]) -> Result<(), Failure> {
        if self.images {
            env.exteroception().map_err(Failure::usage)?;
        }
        if self.rows == 0 {
            set_look(&mut self.trial, env).map_err(Failure::new)?;
        }
        self.rows += 1;
        self.push(env, action).map_err(Failure::new)
    }

    fn push(&mut self, env: &Env, action: &[f64]) -> Result<(), TraceError> {
        let trial = &mut self.trial;
        let (verdict, time) = (env.verdict(), env.scene().data.time());
        trial.push("time", &[], &[time])?;
        trial.push("observations", &[env.observation().len()], env.observation())?;
        trial.push("actions", &[action.len()], action)?;
        trial.push("rewards", &[], &[env.reward()])?;
        trial.push("done", &[], &[verdict.done])?;
        trial.push("env_infos/time", &[], &[env.rows()["time"][0]])?;
        for folder in ["env_infos/rwd_", "env_infos/rwd_dict/"] {
            trial.push(&format!("{folder}dense"), &[], &[env.dense()])?;
            trial.push(&format!("{folder}sparse"), &[], &[verdict.sparse])?;
        }
        for folder in ["env_infos/", "env_infos/rwd_dict/"] {
            trial.push(&format!("{folder}solved"), &[], &[verdict.solved])?;
            trial.push(&format!("{folder}done"), &[], &[verdict.done])?;
        }
        for (row, values) in env.terms().iter() {
            let shape: &[usize] = if values.len() == 1 { &[] } else { &[values.len()] };
            trial.push(&format!("env_infos/rwd_dict/{}", row.name()), shape, values)?;
        }
        for (row, values) in env.rows().iter() {
            let shape: &[usize] = if row.name() == "time" { &[] } else { &[values.len()] };
            trial.push(&format!("env_infos/obs_dict/{}", row.name()), shape, values)?;
        }
        push_proprioception(trial, env)?;
        push_images(trial, env)?;
        push_state(trial, env)
    }

    /// Completes the episode with the row of its last state, in which no action is taken. An HDF5 file holds it from then
    /// on, whatever ends the process.
    ///
    /// # Errors
    /// Writing fails.
    pub fn finish(mut self, env: &mut Env) -> Result<(), Failure> {
        self.row(env, &vec![f64::NAN; env.action_len()])?;
        self.trial.finish().map_err(Failure::new)?;
        *self.episodes += 1;
        Ok(())
    }
}

/// The rows of the proprioception, its time first.
fn push_proprioception(trial: &mut Trial<'_>, env: &Env) -> Result<(), TraceError> {
    let Some(keys) = env.proprio_keys() else { return Ok(()) };
    let mut pushed = Vec::new();
    for key in ["time"].into_iter().chain(keys.iter().map(String::as_str)) {
        // A row may be there twice.
        if !pushed.contains(&key) {
            let values = &env.rows()[key];
            trial.push(&format!("env_infos/proprio_dict/{key}"), &[values.len()], values)?;
            pushed.push(key);
        }
    }
    Ok(())
}

/// The images that were drawn of this state.
fn push_images(trial: &mut Trial<'_>, env: &Env) -> Result<(), TraceError> {
    let Some(seen) = env.visuals() else { return Ok(()) };
    trial.push(&format!("{IMAGES}time"), &[1], &[seen.time()])?;
    for image in seen.images() {
        let key = format!("{IMAGES}{}", image.name());
        match image.pixels() {
            Pixels::Bytes(bytes) => trial.push(&key, image.shape(), bytes)?,
            Pixels::Numbers(numbers) => trial.push(&key, image.shape(), numbers)?,
        }
    }
    Ok(())
}

/// What the reset drew of the look of the scene.
fn set_look(trial: &mut Trial<'_>, env: &Env) -> Result<(), TraceError> {
    env.look().into_iter().flat_map(|look| look.iter()).try_for_each(|(row, values)| {
        let array = Array { shape: vec![values.len()], values: Values::F64(values.to_vec()) };
        trial.set(&format!("{LOOK}{}", row.name()), &array)
    })
}

/// The parts of the state, bodies and sites a row each; NaN where the model has no such part, as the original writes it.
fn push_state(trial: &mut Trial<'_>, env: &Env) -> Result<(), TraceError> {
    let parts: Vec<_> = env.world().parts().collect();
    for name in WorldState::NAMES.into_iter().filter(|name| !name.ends_with("ctrl")) {
        let key = format!("{STATE}{name}");
        let width = if name.ends_with("_pos") { 3 } else { 4 };
        match parts.iter().find(|(part, _)| *part == name) {
            None => trial.push(&key, &[], &[f64::NAN])?,
            Some((_, values)) if name == "time" => trial.push(&key, &[], values)?,
            Some((_, values)) if name.contains('_') => {
                trial.push(&key, &[values.len() / width, width], values)?
            }
            Some((_, values)) => trial.push(&key, &[values.len()], values)?,
        }
    }
    Ok(())
}
