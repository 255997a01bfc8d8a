//! Poses: the joints are to take a configuration, given or drawn.

use super::text_precision::round_frames;
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::suite::bonus::bonus;
use crate::task::{Defaults, Episode, Setup, Task, Verdict, View};
use physics::Model;
use robot::{Compat, Keeper};
use serde::Deserialize;

/// Beyond this distance \[rad\] in the space of joints the episode ends.
const FAR: f64 = 10.0;

/// Joints of the arm and the one that drives the gripper; the gripper's other joints follow it.
const ROBOTIQ_JOINTS: usize = 8;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    target_pose: Target,
}

#[derive(Clone, Deserialize)]
#[serde(untagged)]
enum Target {
    Given(Vec<f64>),
    Drawn(Drawn),
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Drawn {
    /// Uniform over the ranges of the actuators, one joint each.
    Random,
}

#[derive(Clone)]
pub struct Reach {
    joints: usize,
    /// Whether every episode draws a target.
    random: bool,
    target: Vec<f64>,
    compat: Compat,
}

impl Reach {
    /// The task over all joints.
    ///
    /// # Errors
    /// The target has no value for each joint; targets are to be drawn, and joints and actuators are not one to one.
    pub fn of_robot(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Self::over(setup.scene.model.nq, args, setup)
    }

    /// The task over the joints of an arm with a Robotiq gripper.
    ///
    /// # Errors
    /// As [`Reach::of_robot`].
    pub fn of_robotiq(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Self::over(ROBOTIQ_JOINTS, args, setup)
    }

    fn over(joints: usize, args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        if setup.compat == Compat::RoboHive07 {
            round_frames(setup.scene)?;
        }
        let m = &setup.scene.model;
        if joints > m.nq.min(m.nv) {
            return Err(setup.wrong(format!("the task needs {joints} joints, and the model has {}", m.nq)));
        }
        let (random, mut target) = match args.target_pose {
            Target::Given(target) => (false, target),
            Target::Drawn(Drawn::Random) => (true, vec![0.0; joints.min(m.nu)]),
        };
        if target.len() != joints {
            let found = target.len();
            return Err(setup.wrong(format!("target_pose has {found} values, and the robot {joints} joints")));
        }
        if random {
            draw(m, setup.rng, &mut target)?;
        }
        Ok(Reach { joints, random, target, compat: setup.compat })
    }
}

/// Draws a target from the ranges of the actuators, the first one first.
fn draw(m: &Model, rng: &mut Rng, target: &mut [f64]) -> Result<(), EnvError> {
    for (value, [low, high]) in target.iter_mut().zip(&m.actuator_ctrlrange) {
        *value = rng.uniform(*low, *high)?;
    }
    Ok(())
}

impl Task for Reach {
    fn defaults(&self) -> Defaults {
        let weights = [("pose", -1.0), ("bonus", 4.0), ("penalty", -50.0)];
        Defaults::new(&["qp", "qv", "pose_err"], &weights, 40)
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        if self.random {
            draw(&episode.scene.model, episode.rng, &mut self.target)?;
        }
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let qp = &state.qpos[..self.joints];
        rows.set("qp", "rad, m", qp);
        rows.set("qv", "rad/s, m/s", &state.qvel[..self.joints]);
        rows.set("pose_err", "rad, m", qp.iter().zip(&self.target).map(|(q, target)| q - target));
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = norm(&rows["pose_err"]);
        terms.set("pose", "rad", [distance]);
        terms.set("bonus", "", [bonus(self.compat, &[distance < 1.0, distance < 2.0])]);
        terms.set("penalty", "", [f64::from(distance > FAR)]);
        Verdict { sparse: -distance, solved: distance < 0.5, done: distance > FAR }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        keeper.numbers(&mut self.target);
    }
}
