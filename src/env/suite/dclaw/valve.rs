//! The valve under the claw and the mark that shows the angle it is to have, which turning and screwing share.

use super::claw::{Fingers, JOINTS, distance_to, excess, last_action};
use crate::error::EnvError;
use crate::rotation::quat_of_euler;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Setup, Verdict, View};
use physics::elements::BodyId;
use physics::math::ops;
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_3, PI, TAU};

/// The joints of a finger where episodes start, and which they are to stay near \[rad\].
const NOMINAL: [f64; JOINTS] = [0.0, -FRAC_PI_3, FRAC_PI_3];

/// Velocity \[rad/s\] from which a joint of the claw counts as fast.
const FAST: f64 = 0.5;

/// The settings of both tasks.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// First and last joint of the claw.
    pub dof_range_names: [String; 2],
    #[serde(default = "joint")]
    valve_joint_name: String,
    #[serde(default = "target")]
    target_body_name: String,
    /// Where the valve starts \[rad\].
    pub initial_angle_range: [f64; 2],
    /// Error of the angle \[rad\] below which the task is solved.
    pub success_threshold: Option<f64>,
    /// Where a valve that is turned is to come to \[rad\].
    pub target_angle_range: Option<[f64; 2]>,
    /// How fast the mark of a screw turns \[rad/s\].
    pub target_velocity_range: Option<[f64; 2]>,
}

fn joint() -> String {
    "valve_OBJRx".into()
}

fn target() -> String {
    "target".into()
}

/// The claw, the valve and the mark in the model.
#[derive(Clone)]
pub struct Valve {
    fingers: Fingers,
    /// Places of the valve in `qpos` and `qvel`.
    place: [usize; 2],
    target: BodyId,
    initial: [f64; 2],
    threshold: f64,
}

impl Valve {
    /// Finds the parts in the model; the task is solved below an error of `threshold` \[rad\] unless the id gives another.
    ///
    /// # Errors
    /// Elements are missing, or of another kind.
    pub fn new(args: &Args, threshold: f64, setup: &Setup<'_>) -> Result<Self, EnvError> {
        let scene = &*setup.scene;
        let joint = scene.model.joint(scene.joint(&args.valve_joint_name)?);
        Ok(Valve {
            fingers: Fingers::new(setup.spec, scene, &args.dof_range_names)?,
            place: [joint.qpos_range().start, joint.dof_range().start],
            target: scene.body(&args.target_body_name)?,
            initial: args.initial_angle_range,
            threshold: args.success_threshold.unwrap_or(threshold),
        })
    }

    /// Observation, proprioception and weights.
    pub fn defaults() -> Defaults {
        let weights = [
            ("target_dist_cost", 5.0),
            ("pose_diff_cost", 1.0),
            ("joint_vel_cost", 1.0),
            ("bonus_small", 10.0),
            ("bonus_big", 50.0),
        ];
        Defaults::new(&["claw_qpos", "object_x", "object_y", "last_action", "target_error"], &weights, 40)
            .proprio(&["claw_qpos"])
    }

    /// Starts an episode at rest, the claw in its nominal pose and the valve at an angle that is drawn and returned \[rad\].
    ///
    /// # Errors
    /// A range that cannot be drawn from.
    pub fn start(&self, episode: &mut Episode<'_>) -> Result<f64, EnvError> {
        let claw = &mut episode.start.qpos[self.fingers.qpos.clone()];
        claw.iter_mut().zip(NOMINAL.into_iter().cycle()).for_each(|(angle, at)| *angle = at);
        episode.start.qvel.fill(0.0);
        let angle = episode.rng.uniform(self.initial[0], self.initial[1])?;
        episode.start.qpos[self.place[0]] = angle;
        Ok(angle)
    }

    /// Turns the mark to an angle \[rad\]. It holds no mass and touches nothing.
    ///
    /// # Errors
    /// The angle is not a number.
    pub fn point(&self, scene: &mut Scene, angle: f64) -> Result<(), EnvError> {
        scene.overwrite(|m| m.body_quat[self.target.index()] = quat_of_euler([0.0, 0.0, angle]))
    }

    /// Writes the observation.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let mark = view.data.body(self.target).xmat();
        let angle = state.qpos[self.place[0]];
        rows.set("claw_qpos", "rad", &state.qpos[self.fingers.qpos.clone()]);
        rows.set("claw_qvel", "rad/s", &state.qvel[self.fingers.qvel.clone()]);
        rows.set("object_x", "", [ops::cos(angle)]);
        rows.set("object_y", "", [ops::sin(angle)]);
        rows.set("object_qvel", "rad/s", [state.qvel[self.place[1]]]);
        rows.set("last_action", "", last_action(view));
        rows.set("target_error", "rad", [within_half_a_turn(ops::atan2(mark[3], mark[0]) - angle)]);
    }

    /// Writes the terms of the reward.
    pub fn reward(&self, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distance = rows["target_error"][0].abs();
        terms.set("target_dist_cost", "rad", [-distance]);
        terms.set("pose_diff_cost", "rad", [-distance_to(&rows["claw_qpos"], NOMINAL)]);
        terms.set("joint_vel_cost", "rad/s", [-excess(&rows["claw_qvel"], FAST)]);
        terms.set("bonus_small", "", [f64::from(distance < 0.25)]);
        terms.set("bonus_big", "", [f64::from(distance < 0.1)]);
        Verdict { sparse: 1.0 - distance / PI, solved: distance < self.threshold, done: false }
    }
}

/// The same angle \[rad\] above minus half a turn, up to half a turn.
fn within_half_a_turn(angle: f64) -> f64 {
    angle - TAU * ((angle - PI) / TAU).ceil()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_take_the_shorter_way() {
        for (angle, expected) in
            [(0.0, 0.0), (PI, PI), (-PI, PI), (3.5, 3.5 - TAU), (-3.5, TAU - 3.5), (20.0, 20.0 - 3.0 * TAU)]
        {
            let found = within_half_a_turn(angle);
            assert!((found - expected).abs() < 1e-14, "{angle}: {found}");
        }
    }
}
