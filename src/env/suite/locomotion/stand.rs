//! Standing: the body keeps the height that is asked of it, which changes every few seconds, whoever pushes it.

use super::interval::Interval;
use super::walker::{Disturbance, Walker};
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;

/// Share of the standing height by which the root may be off.
const NEAR: f64 = 0.03;
/// Lean that still counts as standing \[rad\].
const LEAN: f64 = 0.2;
/// Steps at the height that make a success, of an episode of 500.
const STEPS: usize = 350;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the body.
    roles: String,
    #[serde(default)]
    disturbance: Disturbance,
    /// Smallest and largest height that is asked for, as shares of the standing height.
    height_range: [f64; 2],
    /// Steps from one height to the next.
    every: Interval,
}

/// The task.
#[derive(Clone)]
pub struct Stand {
    walker: Walker,
    range: [f64; 2],
    every: Interval,
    wanted: f64,
}

impl Stand {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let walker = Walker::new(&args.roles, "stand", args.disturbance, setup)?;
        let range = args.height_range.map(|share| share * walker.height);
        Ok(Stand { wanted: walker.height, walker, range, every: args.every })
    }

    fn draw(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        self.wanted = rng.uniform(self.range[0], self.range[1])?;
        Ok(())
    }
}

impl Task for Stand {
    fn defaults(&self) -> Defaults {
        let weights = [("height", 1.0), ("upright", 1.0), ("still", 0.2), ("bonus", 1.0), ("fallen", 10.0)];
        Walker::defaults(&["height_command"], &weights, STEPS)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(&scene.model, pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.walker.start(episode)?;
        self.every.restart();
        self.draw(episode.rng)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        if self.every.passes() {
            self.draw(turn.rng)?;
        }
        self.walker.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.walker.observe(view, rows);
        rows.set("height_command", "m", [self.wanted]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let off = (rows["height"][0] - rows["height_command"][0]).abs() / self.walker.height;
        let solved = off < NEAR && rows["up"][2] > ops::cos(LEAN);
        terms.set("height", "", [-off]);
        terms.set("still", "m/s", [-norm(&rows["velocity"][..2])]);
        self.walker.judge(solved, rows, terms)
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
        keeper.number(&mut self.wanted);
        self.every.keep(keeper);
    }
}
