//! A bar that one arm takes from the table and hands over to the other, which brings it to a place in the air.
//!
//! Each observes the direction of the bar, from the left grip to the right one (`load_axis`), in the frame of its base.

use super::arms::{Arms, vector};
use super::part::{Part, STEPS, defaults};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};
use crate::team::Team;
use physics::math::{norm, ops};
use serde::Deserialize;

/// Number of the arm that is to have the bar at the end.
const RECEIVER: usize = 1;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of both arms.
    roles: String,
    /// Largest difference of a joint from its pose at home at the start \[rad or m\].
    joint_noise: f64,
    /// Where the bar is at the start \[m\].
    load_range: Ranges<2>,
    /// How far it is turned there \[rad\].
    turn_range: [f64; 2],
    /// Where it is to go \[m\].
    target_range: Ranges,
    /// Distance from there that solves the task, if the receiver alone holds the bar \[m\].
    radius: f64,
}

/// The task.
#[derive(Clone)]
pub struct HandOver {
    arms: Arms,
    start: Ranges<2>,
    turn: [f64; 2],
    targets: Ranges,
    radius: f64,
}

impl HandOver {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles of `left` and `right`; it lacks a body `load` with a free joint, a site on it for each arm
    /// (`left_grip`), or a site `target`.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let part = |name| Part {
            name,
            rows: &["load_axis"],
            own: &[("reach", 0.5)],
            shared: &[("distance", 1.0), ("handed", 1.0), ("bonus", 2.0)],
        };
        let parts = [part("left"), part("right")];
        Ok(HandOver {
            arms: Arms::new((&args.roles, args.joint_noise), "hand over", &parts, setup)?,
            start: args.load_range,
            turn: args.turn_range,
            targets: args.target_range,
            radius: args.radius,
        })
    }
}

impl Task for HandOver {
    fn defaults(&self) -> Defaults {
        defaults(&self.arms.team, STEPS)
    }

    fn team(&self) -> Option<&Team> {
        Some(&self.arms.team)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.arms.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let place = self.start.draw(episode.rng)?;
        let (sine, cosine) = ops::sincos(episode.rng.uniform(self.turn[0], self.turn[1])? / 2.0);
        let target = self.targets.draw(episode.rng)?;
        let turn = self.arms.pose.start + 3..self.arms.pose.end;
        episode.start.qpos[turn].copy_from_slice(&[cosine, 0.0, 0.0, sine]);
        self.arms.start(episode, place, target)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let axes = view.data.kin.xmat[self.arms.load.index()];
        self.arms.observe(view, rows, |local, rows| {
            rows.set("load_axis", "", local([axes[1], axes[4], axes[7]]));
        });
        rows.set("receiver_alone", "", [f64::from(self.arms.alone(view, RECEIVER))]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = norm(vector(self.arms.row(rows, 0, "target_error")));
        let handed = rows["receiver_alone"][0] > 0.0 && self.arms.row(rows, RECEIVER, "hold")[0] > 0.0;
        let solved = handed && distance < self.radius;
        terms.set("distance", "m", [-distance]);
        terms.set("handed", "", [f64::from(handed)]);
        terms.set("bonus", "", [f64::from(solved)]);
        self.arms.judge(rows, terms);
        Verdict { sparse: f64::from(solved), solved, done: false }
    }

    fn resting_rows(&self) -> Vec<String> {
        self.arms.resting_rows()
    }
}
