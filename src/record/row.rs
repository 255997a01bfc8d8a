//! What a recording has of a state: names and values.

use crate::{IMAGES, LOOK, MECHANICS, STATE};
use dataset::trace::{TraceError, Trial};
use dataset::{Array, Scalar, Values};
use env::{Env, Pixels, WorldState};

/// What takes the rows of an episode: a trial of a file, or memory.
pub trait Sink {
    /// Adds a row under a name: its shape, empty for a scalar, and its scalars, row-major.
    ///
    /// # Errors
    /// Shape or type differ from earlier rows, or writing fails.
    fn push<T: Scalar>(&mut self, key: &str, shape: &[usize], row: &[T]) -> Result<(), TraceError>;

    /// Sets what has no rows.
    ///
    /// # Errors
    /// The name is taken.
    fn set(&mut self, key: &str, array: &Array) -> Result<(), TraceError>;
}

impl Sink for Trial<'_> {
    fn push<T: Scalar>(&mut self, key: &str, shape: &[usize], row: &[T]) -> Result<(), TraceError> {
        Trial::push(self, key, shape, row)
    }

    fn set(&mut self, key: &str, array: &Array) -> Result<(), TraceError> {
        Trial::set(self, key, array)
    }
}

/// What `rwd_dict` has of a step beside the terms of the reward.
const VERDICTS: [&str; 4] = ["dense", "sparse", "solved", "done"];

/// Adds the row of the current state of an environment and of the action that is taken in it.
///
/// # Errors
/// The sink refuses it.
pub fn push_row(trial: &mut impl Sink, env: &Env, action: &[f64]) -> Result<(), TraceError> {
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
    // A term may be called as a verdict, as `done` of RoboHive's walks: it is recorded once.
    for (row, values) in env.terms().iter().filter(|(row, _)| !VERDICTS.contains(&row.name())) {
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

/// The rows of the proprioception, its time first.
fn push_proprioception(trial: &mut impl Sink, env: &Env) -> Result<(), TraceError> {
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
fn push_images(trial: &mut impl Sink, env: &Env) -> Result<(), TraceError> {
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

/// Adds what the reset drew of look and physics of the scene.
///
/// # Errors
/// The sink refuses it.
pub fn set_drawn(trial: &mut impl Sink, env: &Env) -> Result<(), TraceError> {
    for (folder, drawn) in [(LOOK, env.look()), (MECHANICS, env.mechanics())] {
        for (row, values) in drawn.into_iter().flat_map(|drawn| drawn.iter()) {
            let array = Array { shape: vec![values.len()], values: Values::F64(values.to_vec()) };
            trial.set(&format!("{folder}{}", row.name()), &array)?;
        }
    }
    Ok(())
}

/// The parts of the state, bodies and sites a row each; NaN where the model has no such part, as the original writes it.
fn push_state(trial: &mut impl Sink, env: &Env) -> Result<(), TraceError> {
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
