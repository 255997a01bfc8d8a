//! Walking to a place that is marked on the ground.

use super::floor::{Floor, FloorArgs};
use super::mark::Mark;
use super::walker::{Disturbance, Walker};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;

/// Steps at the place that make a success: 0.5 s.
const STEPS: usize = 25;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the body.
    roles: String,
    #[serde(default)]
    disturbance: Disturbance,
    /// Ground that is not level.
    #[serde(default)]
    ground: Option<FloorArgs>,
    /// Distance of the place, in heights of the root.
    target_distance_range: [f64; 2],
    /// Direction of the place, from where the body looks at the start, counterclockwise \[rad\].
    target_angle_range: [f64; 2],
    /// Distance from the place that solves the task, in heights of the root.
    radius: f64,
}

/// The task.
#[derive(Clone)]
pub struct WalkTo {
    walker: Walker,
    floor: Option<Floor>,
    mark: Mark,
    distance: [f64; 2],
    angle: [f64; 2],
}

impl WalkTo {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no site `target`.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let walker = Walker::new(&args.roles, "walk to", args.disturbance, setup)?;
        let height = walker.height;
        let floor = args.ground.as_ref().map(|ground| Floor::new(ground, &walker, setup)).transpose()?;
        Ok(WalkTo {
            mark: Mark::new(args.radius, &walker, setup)?,
            distance: args.target_distance_range.map(|distance| distance * height),
            angle: args.target_angle_range,
            floor,
            walker,
        })
    }
}

impl Task for WalkTo {
    fn defaults(&self) -> Defaults {
        Walker::defaults(&["target_error"], &Mark::WEIGHTS, STEPS)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(&scene.model, pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.walker.start(episode)?;
        if let Some(floor) = &self.floor {
            floor.start(episode)?;
        }
        let distance = episode.rng.uniform(self.distance[0], self.distance[1])?;
        let (sine, cosine) = ops::sincos(episode.rng.uniform(self.angle[0], self.angle[1])?);
        let [x, y] = self.walker.ahead_at_start();
        let place = [distance * (cosine * x - sine * y), distance * (sine * x + cosine * y)];
        self.mark.put(episode.scene, place)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.walker.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let posture = self.walker.observe(view, rows);
        self.mark.observe(&posture, view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        self.mark.reward(&self.walker, rows, terms)
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
    }
}
