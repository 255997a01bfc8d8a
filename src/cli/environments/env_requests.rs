//! `bench-env --requests`: the parts of an environment's time one by one, for a program that measures processor time
//! around each.

use crate::environments::batch_speed::batch_speed;
use crate::failure::Failure;
use crate::input::library::Making;
use crate::terminal::show_json;
use env::{Env, EnvState, Rng, Scene};
use serde_json::{Value, json};
use std::time::Instant;

/// Most steps that a request can ask for.
const MAX_STEPS: usize = 1_000_000;

/// One line of the standard input.
#[derive(Clone, Copy)]
enum Request {
    /// `record N`: take N steps under random actions, and keep what the two below repeat.
    Record(usize),
    /// `env`: the recorded actions once more, without resets.
    Env,
    /// `images`: the recorded actions once more, with the images of the visual keys after each.
    Images,
    /// `physics`: the recorded controls through physics alone.
    Physics,
    /// `resets N`
    Resets(usize),
    /// `makes N`: make the environment N times.
    Makes(usize),
    /// `batch T`: a batch on T threads, for the time that the command line states.
    Batch(usize),
}

impl Request {
    fn parse(line: &str) -> Option<Request> {
        let mut words = line.split_whitespace();
        let name = words.next()?;
        let mut number = || words.next()?.parse().ok().filter(|number| (1..=MAX_STEPS).contains(number));
        Some(match name {
            "record" => Request::Record(number()?),
            "env" => Request::Env,
            "images" => Request::Images,
            "physics" => Request::Physics,
            "resets" => Request::Resets(number()?),
            "makes" => Request::Makes(number()?),
            "batch" => Request::Batch(number()?),
            _ => return None,
        })
    }
}

/// An episode, or the part of it that was recorded.
struct Episode {
    /// After the reset.
    start: EnvState,
    scene: Scene,
    /// Row after row.
    actions: Vec<f64>,
    controls: Vec<f64>,
}

/// What requests are about.
pub struct Subject<'a> {
    /// Its id.
    pub id: &'a str,
    /// How it is made.
    pub making: &'a Making,
    /// The environment itself.
    pub env: Env,
    /// Environments of a batch.
    pub count: usize,
    /// Time to step batches for [s].
    pub seconds: f64,
}

impl Subject<'_> {
    /// Answers every line of standard input by a line of JSON, until the input ends.
    pub fn answer(mut self) -> Result<(), Failure> {
        let mut episodes = Vec::new();
        for line in std::io::stdin().lines() {
            let line = line.map_err(Failure::new)?;
            let request = Request::parse(&line).ok_or_else(|| {
                Failure::usage(format!(
                    "request {line:?} is not `record N`, `env`, `images`, `physics`, `resets N`, `makes N` or `batch T`"
                ))
            })?;
            show_json(&self.serve(request, &mut episodes)?);
        }
        Ok(())
    }

    fn serve(&mut self, request: Request, episodes: &mut Vec<Episode>) -> Result<Value, Failure> {
        match request {
            Request::Record(steps) => *episodes = record(&mut self.env, steps)?,
            Request::Env => {
                episodes.iter().try_for_each(|episode| repeat(&mut self.env, episode, |_| Ok(())))?;
            }
            Request::Images => {
                let draw = |env: &mut Env| env.exteroception().map(drop).map_err(Failure::usage);
                episodes.iter().try_for_each(|episode| repeat(&mut self.env, episode, draw))?;
            }
            Request::Physics => {
                let mut scene = self.env.scene().clone();
                episodes.iter().for_each(|episode| physics(&mut scene, episode, self.env.frame_skip()));
            }
            Request::Resets(count) => {
                for _ in 0..count {
                    self.env.reset(None).map_err(Failure::new)?;
                }
            }
            Request::Makes(count) => {
                let began = Instant::now();
                for _ in 0..count {
                    self.making.make(self.id)?;
                }
                return Ok(json!({"seconds": began.elapsed().as_secs_f64() / count as f64}));
            }
            Request::Batch(threads) => {
                let speed = batch_speed(&self.env, self.count, threads, self.seconds)?;
                return Ok(json!({"steps_per_second": speed}));
            }
        }
        let width = self.env.action_len().max(1);
        let steps: usize = episodes.iter().map(|episode| episode.actions.len() / width).sum();
        Ok(json!({"episodes": episodes.len(), "steps": steps}))
    }
}

fn record(env: &mut Env, steps: usize) -> Result<Vec<Episode>, Failure> {
    let mut rng = Rng::pcg64(0_u64);
    let mut action = vec![0.0; env.action_len()];
    let mut episodes: Vec<Episode> = Vec::new();
    let mut ended = true;
    for _ in 0..steps {
        if ended {
            env.reset(episodes.is_empty().then_some(0)).map_err(Failure::new)?;
            let (start, scene) = (env.state(), env.scene().clone());
            episodes.push(Episode { start, scene, actions: Vec::new(), controls: Vec::new() });
        }
        env.random_action(&mut rng, &mut action).map_err(Failure::new)?;
        let step = env.step(&action).map_err(Failure::new)?;
        if let Some(episode) = episodes.last_mut() {
            episode.actions.extend_from_slice(&action);
            episode.controls.extend_from_slice(env.robot().last_control());
        }
        ended = step.terminated || step.truncated;
    }
    Ok(episodes)
}

/// Takes the actions of an episode, and does something after each.
fn repeat(
    env: &mut Env,
    episode: &Episode,
    each: impl Fn(&mut Env) -> Result<(), Failure>,
) -> Result<(), Failure> {
    env.set_state(&episode.start).map_err(Failure::new)?;
    for action in episode.actions.chunks_exact(env.action_len().max(1)) {
        env.step(action).map_err(Failure::new)?;
        each(env)?;
    }
    Ok(())
}

/// Time steps and the forward pass of the observation. A step that is refused was refused in the environment too, and
/// ends the episode.
fn physics(scene: &mut Scene, episode: &Episode, frame_skip: usize) {
    scene.clone_from(&episode.scene);
    for control in episode.controls.chunks_exact(scene.data.state.ctrl.len().max(1)) {
        scene.data.state.ctrl.copy_from_slice(control);
        if scene.advance(frame_skip, |_| ()).is_err() {
            return;
        }
        scene.complete();
    }
}
