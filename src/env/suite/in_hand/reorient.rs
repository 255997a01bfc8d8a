//! Reorienting: a thing in the palm is to be turned until it stands as another one does, which floats beside the hand.
//!
//! Action: positions of the servos, -1 to 1 over their ranges. Observation: joints of the hand \[rad\], \[rad/s\]; in the frame of the world
//! the offset of the thing from where it was put \[m\], its quaternion, velocity \[m/s\] and angular velocity \[rad/s\], the quaternion that it is to
//! have, the turn that is left as axis times angle \[rad\], and seconds for which it has been there. Dense reward: minus the angle
//! \[rad\] and ten times the offset \[m\], one more while there, 100 at the end, -100 for a drop. Sparse reward: 1 while there.
//! Solved: within 0.1 rad, and 4 cm from where it was put, for 0.5 s, which ends the episode, as a drop does. 0.1 rad is the threshold
//! of MuJoCo Playground's LeapCubeReorient (Zakka et al., "MuJoCo Playground", 2025) and of Gymnasium-Robotics' hands; OpenAI's hand
//! had 0.4 rad ("Learning dexterous in-hand manipulation", International Journal of Robotics Research 39, 2020). Episodes start with
//! the hand in the pose `cradle` of its roles, joints and the thing a little off; the goal is a turn about the vertical of `turn`
//! rad, either way. Of a thing that is round about an `axis`, such as a pen, only where that points counts.

use super::hand::{Hand, about_z, either_way};
use crate::error::EnvError;
use crate::rotation::{norm, turn_between};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::BodyId;
use physics::math::{Quat, Vec3, cross, dot, ops, quat_mul, quat_rotate, scale};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// How long the thing is to stay as it is to be \[s\].
const HOLD: f64 = 0.5;
/// Time steps of the physics in one step of the environment: 0.05 s at the scenes' 5 ms.
const FRAME_SKIP: usize = 10;

/// Settings of the task.
#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the hand.
    roles: String,
    /// Largest difference of a joint from the cradle at the start \[rad\].
    joint_noise: f64,
    /// Largest difference of the thing from its place at the start \[m\], \[rad\].
    place_noise: [f64; 2],
    /// Least and largest angle of the turn that is asked for \[rad\].
    turn: [f64; 2],
    /// Angle \[rad\] and distance from its place \[m\] that count as there.
    within: [f64; 2],
    /// Distance from its place at which a thing is dropped \[m\].
    dropped: f64,
    /// The axis of a round thing, in its frame: turns about it do not count.
    axis: Option<Vec3>,
}

/// The task.
#[derive(Clone)]
pub struct Reorient {
    object: BodyId,
    /// Where `qpos` has the thing, and `qvel` its first velocity.
    place: Range<usize>,
    velocity: usize,
    target: BodyId,
    hand: Hand,
    args: Args,
    hold: Hold,
}

impl Reorient {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or lacks a thing on a free joint, a target, or a cradle; ranges that are none.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let mut hand = Hand::new(&args.roles, args.joint_noise, "reorient", setup)?;
        let (object, place) = setup.loose_body("object")?;
        hand.put(&setup.scene.model, object, &place);
        if !(args.turn[0] > args.within[0] && args.turn[1] >= args.turn[0]) {
            return Err(
                setup.wrong("turn needs two angles, the second not below the first, both beyond within")
            );
        }
        let velocity = setup.scene.model.body_dofadr[object.index()] as usize;
        let target = hand.show("target", setup)?;
        Ok(Reorient { object, place, velocity, target, hand, args, hold: Hold::new(HOLD) })
    }

    /// What the thing lacks: the offset from its place \[m\], and the turn that is left, as axis times angle \[rad\].
    fn lacks(&self, m: &Model, data: &Data) -> [Vec3; 2] {
        let object = data.body(self.object);
        let (own, target) = (*object.xquat(), m.body_quat[self.target.index()]);
        let left = self.args.axis.map_or_else(|| turn(own, target), |axis| tilt(own, target, axis));
        let place = &self.hand.home[self.place.start..];
        [[0, 1, 2].map(|i| object.xpos()[i] - place[i]), left]
    }

    /// Whether the thing is as it is to be.
    fn is_there(&self, m: &Model, data: &Data) -> bool {
        let [offset, turn] = self.lacks(m, data);
        self.near(norm(&turn), norm(&offset))
    }

    /// Whether an angle \[rad\] and a distance \[m\] count as there.
    fn near(&self, turn: f64, offset: f64) -> bool {
        turn < self.args.within[0] && offset < self.args.within[1]
    }
}

impl Task for Reorient {
    fn defaults(&self) -> Defaults {
        let rows = [
            "joint_pos",
            "joint_vel",
            "object_offset",
            "object_quat",
            "object_vel",
            "target_quat",
            "turn_left",
            "held",
            "last_action",
        ];
        let weights =
            [("turn", -1.0), ("offset", -10.0), ("held", 1.0), ("bonus", 100.0), ("penalty", -100.0)];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["joint_pos", "joint_vel"])
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        pose.qpos.copy_from_slice(&self.hand.home);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.hold.begin();
        let rng = &mut *episode.rng;
        self.hand.shake(rng, &mut episode.start.qpos)?;
        let [away, yaw] = self.args.place_noise;
        let object = &mut episode.start.qpos[self.place.clone()];
        for coordinate in &mut object[..2] {
            *coordinate += away * rng.uniform(-1.0, 1.0)?;
        }
        let own: Quat = std::array::from_fn(|k| object[3 + k]);
        let start = quat_mul(about_z(yaw * rng.uniform(-1.0, 1.0)?), own);
        object[3..].copy_from_slice(&start);
        let target = quat_mul(about_z(either_way(self.args.turn, rng)?), start);
        episode.scene.overwrite(|m| m.body_quat[self.target.index()] = target)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let there = self.is_there(&turn.scene.model, &turn.scene.data);
        self.hold.leave(there);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (m, data) = (view.model, view.data);
        let [offset, turn] = self.lacks(m, data);
        self.hand.observe(view, rows);
        rows.set("object_offset", "m", offset);
        rows.set("object_quat", "", *data.body(self.object).xquat());
        rows.set("object_vel", "m/s, rad/s", &data.state.qvel[self.velocity..self.velocity + 6]);
        rows.set("target_quat", "", m.body_quat[self.target.index()]);
        rows.set("turn_left", "rad", turn);
        rows.set("held", "s", [self.hold.seconds(self.is_there(m, data), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (turn, offset) = (norm(&rows["turn_left"]), norm(&rows["object_offset"]));
        terms.set("turn", "rad", [turn]);
        terms.set("offset", "m", [offset]);
        self.hold.judge(rows["held"][0], self.near(turn, offset), offset > self.args.dropped, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into(), "target_quat".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.hold.keep(keeper);
    }
}

/// The shortest turn from one orientation to another, as axis times angle \[rad\].
fn turn(from: Quat, to: Quat) -> Vec3 {
    let (angle, axis) = turn_between(from, to);
    let angle = if angle > PI { angle - TAU } else { angle };
    axis.map(|component| angle * component)
}

/// The shortest turn after which an axis points as in another orientation, as axis times angle \[rad\].
fn tilt(from: Quat, to: Quat, axis: Vec3) -> Vec3 {
    let [a, b] = [from, to].map(|quat| quat_rotate(quat, axis));
    let normal = cross(a, b);
    let sine = norm(&normal);
    scale(normal, ops::atan2(sine, dot(a, b)) / sine.max(1e-12))
}
