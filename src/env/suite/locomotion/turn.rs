//! Turning on the spot: the body is to look in another direction, and to stay near where it began.

use super::mark::Mark;
use super::walker::{Disturbance, Walker};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn as Step, Verdict, View};
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;

/// Error of the direction that solves the task \[rad\].
const NEAR: f64 = 0.15;
/// Steps in the direction that make a success: 1 s.
const STEPS: usize = 50;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the body.
    roles: String,
    #[serde(default)]
    disturbance: Disturbance,
    /// Smallest and largest angle to turn by, to either side \[rad\].
    turn_range: [f64; 2],
    /// How far the body may walk away, in heights of its root.
    radius: f64,
}

/// The task.
#[derive(Clone)]
pub struct Turn {
    walker: Walker,
    mark: Mark,
    range: [f64; 2],
}

impl Turn {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no site `target`.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let walker = Walker::new(&args.roles, "turn", args.disturbance, setup)?;
        let mark = Mark::new(args.radius, &walker, setup)?;
        Ok(Turn { walker, mark, range: args.turn_range })
    }
}

impl Task for Turn {
    fn defaults(&self) -> Defaults {
        let weights = [("direction", 1.0), ("upright", 0.5), ("away", 0.5), ("bonus", 1.0), ("fallen", 10.0)];
        Walker::defaults(&["direction_error", "away"], &weights, STEPS)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(&scene.model, pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.walker.start(episode)?;
        let angle = episode.rng.uniform(self.range[0], self.range[1])?;
        let side = if episode.rng.uniform(-1.0, 1.0)? < 0.0 { -angle } else { angle };
        let [x, y] = self.walker.ahead_at_start();
        let (sine, cosine) = ops::sincos(side);
        // Far away, so that the direction hardly depends on where the body is.
        let place = [10.0 * (cosine * x - sine * y), 10.0 * (sine * x + cosine * y)];
        self.mark.put(episode.scene, place)
    }

    fn act(&mut self, step: &mut Step<'_>) -> Result<(), EnvError> {
        self.walker.act(step)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let posture = self.walker.observe(view, rows);
        let [x, y] = self.mark.place(view);
        let [c, s] = posture.ahead;
        let length = norm(&[x, y]);
        rows.set("direction_error", "rad", [ops::angle((c * y - s * x) / length, (c * x + s * y) / length)]);
        rows.set("away", "m", [norm(&posture.place[..2])]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (error, away) = (rows["direction_error"][0].abs(), rows["away"][0]);
        let solved = error < NEAR && away < self.mark.radius;
        terms.set("direction", "rad", [-error]);
        terms.set("away", "m", [-away]);
        self.walker.judge(solved, rows, terms)
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
    }
}
