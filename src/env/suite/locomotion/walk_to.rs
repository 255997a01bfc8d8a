//! Walking to a place that is marked on the ground.

use super::FRAME_SKIP;
use super::floor::{Floor, FloorArgs};
use super::walker::{Disturbance, Walker};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::SiteId;
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
    target: SiteId,
    distance: [f64; 2],
    angle: [f64; 2],
    radius: f64,
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
            target: setup.scene.site("target")?,
            distance: args.target_distance_range.map(|distance| distance * height),
            angle: args.target_angle_range,
            radius: args.radius * height,
            floor,
            walker,
        })
    }
}

impl Task for WalkTo {
    fn defaults(&self) -> Defaults {
        let weights =
            [("distance", 1.0), ("heading", 0.5), ("upright", 0.5), ("bonus", 2.0), ("fallen", 10.0)];
        let rows = [&Walker::ROWS[..], &["target_error"]].concat();
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP);
        Defaults { success: Success::MoreThan(STEPS), ..defaults }.proprio(&["joint_pos", "joint_vel"])
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(pose);
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
        let place = [distance * (cosine * x - sine * y), distance * (sine * x + cosine * y), 0.0];
        episode.scene.overwrite(|m| m.site_pos[self.target.index()] = place)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.walker.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let posture = self.walker.observe(view, rows);
        rows.set("target_error", "m", posture.towards(view.data.site(self.target).xpos()));
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (error, up) = (&rows["target_error"], rows["up"][2]);
        let distance = norm(error);
        let solved = distance < self.radius;
        let fallen = self.walker.has_fallen(rows["height"][0], up);
        terms.set("distance", "m", [-distance]);
        terms.set("heading", "", [if solved { 1.0 } else { error[0] / distance }]);
        terms.set("upright", "", [up]);
        terms.set("bonus", "", [f64::from(solved)]);
        terms.set("fallen", "", [-f64::from(fallen)]);
        Verdict { sparse: f64::from(solved), solved, done: fallen }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
    }
}
