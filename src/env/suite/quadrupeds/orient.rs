//! Orienting: the robot is to turn on the spot until it looks at a target.

use super::kitty::{Args, Kitty};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};

/// Cosine of the angle between heading and target at which the task is solved, some 5 degrees.
const ALIGNED: f64 = 0.996;

#[derive(Clone)]
pub struct Orient {
    kitty: Kitty,
    upright: f64,
    height: f64,
}

impl Orient {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings, elements or the configuration are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let distance = args.target_distance_range.unwrap_or([0.0, 0.0]);
        Ok(Orient {
            kitty: Kitty::new(&args, distance, setup)?,
            upright: args.upright_threshold.unwrap_or(0.9),
            height: (args.target_height_range[0] + args.target_height_range[1]) / 2.0,
        })
    }
}

impl Task for Orient {
    fn defaults(&self) -> Defaults {
        Kitty::defaults(
            &["upright", "kitty_qpos", "heading", "target_error", "last_a"],
            &[
                ("target_dist_cost", 1.0),
                ("upright", 2.0),
                ("falling", 100.0),
                ("heading", 5.0),
                ("height", 10.0),
                ("bonus_small", 5.0),
                ("bonus_big", 10.0),
            ],
        )
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.kitty.centre(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.kitty.start(episode)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.kitty.observe("last_a", view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (heading, upright, height) = (rows["heading"][0], rows["upright"][0], rows["root_pos"][2]);
        let (stands, fallen) = (upright > self.upright, upright < self.upright);
        let solved = stands && heading > ALIGNED;
        terms.set("target_dist_cost", "m", [-norm(&rows["target_error"])]);
        terms.set("upright", "", [upright - self.upright]);
        terms.set("falling", "", [-f64::from(fallen)]);
        terms.set("heading", "", [heading + 1.0]);
        terms.set("height", "m", [-(height - self.height).abs()]);
        terms.set("bonus_small", "", [f64::from(stands) + f64::from(heading > 0.9)]);
        terms.set("bonus_big", "", [f64::from(solved)]);
        Verdict { sparse: heading, solved, done: fallen }
    }
}
