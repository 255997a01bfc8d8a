//! Walking: the robot is to come to a target, looking at it.

use super::kitty::{Args, Kitty};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};

/// Distance of the target \[m\], where the id gives none.
const DISTANCE: [f64; 2] = [2.3, 2.3];

/// What a walk is measured by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gait {
    /// Height of the torso's vertical axis below which the robot has fallen.
    pub upright: f64,
    /// Mean distance of the target \[m\].
    pub distance: f64,
    /// Height of the torso \[m\].
    pub height: f64,
}

impl Gait {
    /// Weights of the terms.
    pub const WEIGHTS: [(&str, f64); 7] = [
        ("target_dist_cost", 4.0),
        ("upright", 1.0),
        ("falling", 100.0),
        ("heading", 2.0),
        ("height", 0.5),
        ("bonus_small", 5.0),
        ("bonus_big", 10.0),
    ];
}

/// Rewards a robot at this `distance` \[m\] from its target, by the cosine of its `heading` and how high the tip of its vertical
/// axis and its torso \[m\] are.
pub(super) fn reward(
    gait: &Gait,
    distance: f64,
    heading: f64,
    [upright, height]: [f64; 2],
    terms: &mut Rows,
) -> Verdict {
    let fallen = upright < gait.upright;
    let near = |share: f64| f64::from(distance < share * gait.distance);
    let ahead = f64::from(heading > 0.9);
    terms.set("target_dist_cost", "m", [-distance]);
    terms.set("upright", "", [upright - gait.upright]);
    terms.set("falling", "", [-f64::from(fallen)]);
    terms.set("heading", "", [(heading - 0.9) / 0.1]);
    terms.set("height", "m", [-(height - gait.height).abs()]);
    terms.set("bonus_small", "", [near(0.75) + ahead]);
    terms.set("bonus_big", "", [near(0.5) * ahead]);
    Verdict { sparse: -distance, solved: distance < 0.5, done: fallen }
}

#[derive(Clone)]
pub struct Walk {
    kitty: Kitty,
    gait: Gait,
}

impl Walk {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings, elements or the configuration are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let distance = args.target_distance_range.unwrap_or(DISTANCE);
        let mean = |[low, high]: [f64; 2]| (low + high) / 2.0;
        Ok(Walk {
            kitty: Kitty::new(&args, distance, setup)?,
            gait: Gait {
                upright: args.upright_threshold.unwrap_or(0.9),
                distance: mean(distance),
                height: mean(args.target_height_range),
            },
        })
    }
}

impl Task for Walk {
    fn defaults(&self) -> Defaults {
        Kitty::defaults(&["upright", "kitty_qpos", "heading", "target_error", "last_a"], &Gait::WEIGHTS)
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
        reward(&self.gait, norm(&rows["target_error"]), heading, [upright, height], terms)
    }
}
