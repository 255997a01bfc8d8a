//! Standing: the body keeps its height and stays where it is, whoever pushes it.

use super::FRAME_SKIP;
use super::walker::{BodyArgs, Walker};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;

/// Share of the standing height by which the root may be off.
const HEIGHT: f64 = 0.1;
/// Lean that still counts as standing \[rad\].
const LEAN: f64 = 0.2;
/// Steps of standing that make a success: 5 s.
const STEPS: usize = 250;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    body: BodyArgs,
}

/// The task.
#[derive(Clone)]
pub struct Stand {
    walker: Walker,
}

impl Stand {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(Stand { walker: Walker::new(&args.body, "stand", setup)? })
    }
}

impl Task for Stand {
    fn defaults(&self) -> Defaults {
        let weights = [("height", 1.0), ("upright", 1.0), ("still", 0.2), ("solved", 1.0), ("fallen", 10.0)];
        let defaults = Defaults::new(&Walker::ROWS, &weights, FRAME_SKIP);
        Defaults { success: Success::MoreThan(STEPS), ..defaults }.proprio(&["joint_pos", "joint_vel"])
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.walker.start(episode)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.walker.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.walker.observe(view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let off = (rows["height"][0] / self.walker.height - 1.0).abs();
        let upright = rows["up"][2];
        let solved = off < HEIGHT && upright > ops::cos(LEAN);
        let fallen = self.walker.has_fallen(rows["height"][0], upright);
        terms.set("height", "", [-off]);
        terms.set("upright", "", [upright]);
        terms.set("still", "m/s", [-norm(&rows["velocity"][..2])]);
        terms.set("solved", "", [f64::from(solved)]);
        terms.set("fallen", "", [-f64::from(fallen)]);
        Verdict { sparse: f64::from(solved), solved, done: fallen }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
    }
}
