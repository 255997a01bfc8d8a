//! Episodes that controllers solve: how they end, and clips of them.

use crate::failure::Failure;
use crate::pictures::drawing::{Drawing, Plan};
use crate::pictures::film::Film;
use crate::pictures::framing::{AZIMUTHS, Body};
use crate::pictures::look::Size;
use env::Env;
use env::episode::{Summary, evaluate};
use render::scene::{Camera, SceneOptions};
use render::{Painters, Settings};
use std::path::{Path, PathBuf};

/// How long a task is to stay solved before the episode is left \[s\].
const REST: f64 = 0.5;
/// Frames of a clip for each simulated second.
const RATE: f64 = 25.0;

/// Plays an episode with the best controller of the environment until the task has been solved for a while, or the episode ends, and
/// shows every state. Whether it was solved for a while at the end, or the episode counts as a success of the environment.
///
/// # Errors
/// No controller serves the environment; it fails; what `each` fails with.
pub fn solve(
    env: &mut Env,
    seed: u64,
    mut each: impl FnMut(&Env) -> Result<(), Failure>,
) -> Result<bool, Failure> {
    let entry = control::serving(env.spec()).next().ok_or_else(|| Failure::new("no controller serves it"))?;
    let mut controller = control::make(entry.name, env).map_err(Failure::new)?;
    env.reset(Some(seed)).map_err(Failure::new)?;
    controller.reset(env, seed).map_err(Failure::new)?;
    each(env)?;
    let (mut action, mut rested) = (vec![0.0; env.action_len()], 0.0);
    let mut episode = Summary::default();
    loop {
        controller.act(env, &mut action).map_err(Failure::new)?;
        let step = env.step(&action).map_err(Failure::new)?;
        episode.add(env, &step);
        each(env)?;
        rested = if env.verdict().solved { rested + env.dt() } else { 0.0 };
        if rested > REST || step.terminated || step.truncated {
            return Ok(rested > 0.0 || evaluate(&[episode], env.success()).success_percentage > 0.0);
        }
    }
}

/// Writes a clip of an episode that is solved, from a side on which all of it is in the picture; whether it is solved.
///
/// # Errors
/// As [`solve`]; it cannot be drawn or written.
pub fn clip(
    folder: &Path,
    env: &mut Env,
    seed: u64,
    size: Size,
    painters: &dyn Painters,
) -> Result<bool, Failure> {
    let mut seen = Body::default();
    let solved = solve(env, seed, |env| {
        let scene = env.scene();
        seen.join(Body::of(&scene.model, &scene.data).map_err(Failure::new)?);
        Ok(())
    })?;
    if !solved {
        return Ok(false);
    }
    let model = &env.scene().model;
    let camera = Camera::Free(seen.camera(model, AZIMUTHS[0], size));
    let plan = Plan { camera, size, options: SceneOptions::default(), settings: Settings::of(model) };
    let mut film =
        Film::to_file(&file_of(folder, &env.spec().id), Drawing::new(model, plan, painters)?, size, RATE)?;
    solve(env, seed, |env| film.show(&env.scene().model, &env.scene().data, env.steps() as f64 * env.dt()))?;
    film.finish()?;
    Ok(true)
}

/// The file of the clip of an environment.
fn file_of(folder: &Path, id: &str) -> PathBuf {
    folder.join(format!("{}.mp4", id.replace('/', "_")))
}
