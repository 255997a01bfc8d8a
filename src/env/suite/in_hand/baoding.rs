//! Two balls in the palm, which are to go round each other until the line from the first to the second points as that of two others does,
//! which float beside the hand.
//!
//! Action: positions of the servos, -1 to 1 over their ranges. Observation: joints of the hand \[rad\], \[rad/s\], and the controls of its
//! servos; in the frame of the world the offsets of both balls from where they were put \[m\], their velocities \[m/s\], cosine and sine
//! of the bearing of the line and of the bearing that it is to have, both in the horizontal plane; `turn_left`, the shorter way from
//! the one to the other \[rad\]; `held`, the seconds for which it has been right. Dense reward: minus that angle \[rad\], minus ten times
//! the larger offset of a ball from the middle between their places \[m\], one more while it is right, 100 at the end, -100 for a drop.
//! Sparse reward: 1 while it is right. Solved: `within` of the bearing for 0.5 s, which ends the episode, as a drop does. Episodes
//! start with the hand in the pose `cradle` of its roles, joints and balls a little off; the goal is a turn of `turn` rad, either way.

use super::hand::{Hand, about_z, either_way};
use crate::error::EnvError;
use crate::rotation::{norm, shorter};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::Data;
use physics::elements::BodyId;
use physics::math::{Vec3, ops, scale, sub};
use robot::Keeper;
use serde::Deserialize;
use std::ops::Range;

/// How long the balls are to stay as they are to be \[s\].
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
    /// Largest difference of a ball from its place at the start \[m\].
    place_noise: f64,
    /// Least and largest angle of the turn that is asked for \[rad\].
    turn: [f64; 2],
    /// Angle that counts as right \[rad\].
    within: f64,
    /// Distance from the middle between their places at which a ball is dropped \[m\].
    dropped: f64,
}

/// The task.
#[derive(Clone)]
pub struct Baoding {
    balls: [BodyId; 2],
    /// Where `qpos` has the balls, and `qvel` their first velocities.
    places: [Range<usize>; 2],
    velocities: [usize; 2],
    target: BodyId,
    hand: Hand,
    args: Args,
    /// The bearing that the line is to have \[rad\].
    wanted: f64,
    hold: Hold,
}

impl Baoding {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or lacks balls on free joints, a target, or a cradle; ranges that are none.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        if !(args.turn[0] > args.within && args.turn[1] >= args.turn[0]) {
            return Err(
                setup.wrong("turn needs two angles, the second not below the first, both beyond within")
            );
        }
        let mut hand = Hand::new(&args.roles, args.joint_noise, "roll two balls", setup)?;
        let [(first, its), (second, other)] = [setup.loose_body("first")?, setup.loose_body("second")?];
        let (balls, places) = ([first, second], [its, other]);
        for (ball, place) in balls.iter().zip(&places) {
            hand.put(&setup.scene.model, *ball, place);
        }
        let velocities = balls.map(|ball| setup.scene.model.body_dofadr[ball.index()] as usize);
        let target = hand.show("target", setup)?;
        Ok(Baoding { balls, places, velocities, target, hand, args, wanted: 0.0, hold: Hold::new(HOLD) })
    }

    /// Bearing of the line from the first ball to the second \[rad\].
    fn bearing(&self, data: &Data) -> f64 {
        let [x, y, _] = self.line(data);
        ops::atan2(y, x)
    }

    /// From the first ball to the second \[m\].
    fn line(&self, data: &Data) -> Vec3 {
        let [first, second] = self.balls.map(|ball| *data.body(ball).xpos());
        sub(second, first)
    }

    /// The shorter turn from a bearing to the wanted one \[rad\].
    fn left(&self, bearing: f64) -> f64 {
        shorter(self.wanted - bearing)
    }

    /// Where the balls were put \[m\].
    fn homes(&self) -> [Vec3; 2] {
        [0, 1].map(|k| std::array::from_fn(|i| self.hand.home[self.places[k].start + i]))
    }
}

impl Task for Baoding {
    fn defaults(&self) -> Defaults {
        let rows = [
            "joint_pos",
            "joint_vel",
            "balls",
            "balls_vel",
            "line",
            "target_line",
            "turn_left",
            "held",
            "last_action",
        ];
        let weights =
            [("turn", -1.0), ("offset", -10.0), ("held", 1.0), ("bonus", 100.0), ("penalty", -100.0)];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["joint_pos", "joint_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        pose.qpos.copy_from_slice(&self.hand.home);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.hold.begin();
        let (rng, qpos) = (&mut *episode.rng, &mut episode.start.qpos);
        self.hand.shake(rng, qpos)?;
        for place in &self.places {
            for coordinate in &mut qpos[place.start..place.start + 2] {
                *coordinate += self.args.place_noise * rng.uniform(-1.0, 1.0)?;
            }
        }
        let [x, y] = [0, 1].map(|i| qpos[self.places[1].start + i] - qpos[self.places[0].start + i]);
        let turn = either_way(self.args.turn, rng)?;
        self.wanted = ops::atan2(y, x) + turn;
        episode.scene.overwrite(|m| m.body_quat[self.target.index()] = about_z(turn))
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let left = self.left(self.bearing(&turn.scene.data));
        self.hold.leave(left.abs() < self.args.within);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (data, homes) = (view.data, self.homes());
        let bearing = self.bearing(data);
        let left = self.left(bearing);
        self.hand.observe(view, rows);
        rows.set("balls", "m", [0, 1].iter().flat_map(|&k| sub(*data.body(self.balls[k]).xpos(), homes[k])));
        let speeds = self.velocities.iter().flat_map(|&first| &data.state.qvel[first..first + 3]);
        rows.set("balls_vel", "m/s", speeds.copied());
        for (row, angle) in [("line", bearing), ("target_line", self.wanted)] {
            let (sine, cosine) = ops::sincos(angle);
            rows.set(row, "", [cosine, sine]);
        }
        rows.set("turn_left", "rad", [left]);
        rows.set("held", "s", [self.hold.seconds(left.abs() < self.args.within, view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (left, moved, [first, second]) = (rows["turn_left"][0].abs(), &rows["balls"], self.homes());
        // From the middle between both places, as balls that have changed them are where they are to be.
        let half = scale(sub(second, first), 0.5);
        let away = |k: usize, side: f64| norm(&[0, 1, 2].map(|i| moved[3 * k + i] + side * half[i]));
        let offset = away(0, -1.0).max(away(1, 1.0));
        terms.set("turn", "rad", [left]);
        terms.set("offset", "m", [offset]);
        self.hold.judge(rows["held"][0], left < self.args.within, offset > self.args.dropped, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into(), "target_line".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        keeper.number(&mut self.wanted);
        self.hold.keep(keeper);
    }
}
