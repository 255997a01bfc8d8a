//! Squeezing: a soft ball in the palm is to be pressed until it is as thin as asked for, and held so.
//!
//! Action: positions of the servos, -1 to 1 over their ranges. Observation: joints of the hand \[rad\], \[rad/s\], and the controls of its
//! servos; in the frame of the world the nodes that carry the elasticity of the ball \[m\], and the offset of its middle from where
//! it was put \[m\]; `width`, how wide it is where it is thinnest, as a share of its diameter; `width_error`, how much of that is to
//! go; `held`, the seconds for which it has been as asked for. Dense reward: minus the size of that error, minus ten times the offset
//! \[m\], one more while it is right, 100 at the end, -100 for a drop. Sparse reward: 1 while it is right. Solved: within `within` of the
//! width for 0.5 s, which ends the episode, as a drop does. Widths are measured along thirteen directions. Episodes start with the
//! hand in the pose `cradle` of its roles, joints and the ball a little off.

use super::hand::Hand;
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::Data;
use physics::math::{Vec3, dot, sub};
use robot::Keeper;
use serde::Deserialize;

/// How long the ball is to stay as narrow as asked for \[s\].
const HOLD: f64 = 0.5;
/// Time steps of the physics in one step of the environment: 0.05 s at the scene's 2 ms.
const FRAME_SKIP: usize = 25;

/// Directions along which the ball is measured: the axes of the world, and the diagonals between two and three of them.
const DIRECTIONS: [Vec3; 13] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 0.0, 1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, -1.0],
    [1.0, -1.0, 1.0],
    [1.0, -1.0, -1.0],
];

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the hand.
    roles: String,
    /// Largest difference of a joint from the cradle at the start \[rad\].
    joint_noise: f64,
    /// Places of the ball at the start, from the cradle \[m\].
    places: Ranges<2>,
    /// Widths that are asked for, as shares of the diameter.
    widths: [f64; 2],
    /// How far from the width counts as right.
    within: f64,
    /// Distance from its place at which it is dropped \[m\].
    dropped: f64,
}

/// The task.
#[derive(Clone)]
pub struct SoftBall {
    hand: Hand,
    /// Bodies of the nodes, and where `qpos` has their slides.
    nodes: Vec<[usize; 2]>,
    /// Where the middle of the ball is put \[m\], and its diameter \[m\].
    place: Vec3,
    diameter: f64,
    places: Ranges<2>,
    widths: [f64; 2],
    within: f64,
    dropped: f64,
    wanted: f64,
    hold: Hold,
}

impl SoftBall {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles or the ball are missing; a width that is no squeezing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        if !(args.widths[1] >= args.widths[0] && args.widths[1] < 1.0 - args.within) {
            return Err(setup.wrong(
                "widths are two shares, the second not below the first, or a ball at rest is squeezed",
            ));
        }
        let mut hand = Hand::new(&args.roles, args.joint_noise, "squeeze", setup)?;
        let m = &setup.scene.model;
        if m.nflex != 1 || m.nflexnode == 0 {
            return Err(setup.wrong("the scene needs one flex that is moved by nodes"));
        }
        let node = |body: &i32| {
            let body = *body as usize;
            [body, m.jnt_qposadr[m.body_jntadr[body] as usize] as usize]
        };
        let nodes: Vec<[usize; 2]> = m.flex_nodebodyid.iter().map(node).collect();
        let vertices = &setup.scene.data.flex.flexvert_xpos;
        let diameter = extent(vertices, [0.0, 0.0, 1.0]);
        let middle = mean(vertices.iter().copied());
        for &[_, place] in &nodes {
            (0..3).for_each(|i| hand.home[place + i] += hand.cradle[i]);
        }
        let place = std::array::from_fn(|i| middle[i] + hand.cradle[i]);
        let Args { places, widths, within, dropped, .. } = args;
        let (wanted, hold) = (widths[1], Hold::new(HOLD));
        Ok(SoftBall { hand, nodes, place, diameter, places, widths, within, dropped, wanted, hold })
    }

    /// How far the middle of the ball is from its place \[m\].
    fn offset(&self, data: &Data) -> Vec3 {
        sub(mean(self.nodes.iter().map(|node| data.kin.xpos[node[0]])), self.place)
    }

    /// How wide the ball is where it is thinnest, as a share of its diameter.
    fn width(&self, data: &Data) -> f64 {
        let widths = DIRECTIONS.map(|way| extent(&data.flex.flexvert_xpos, way) / norm(&way));
        widths.into_iter().fold(f64::INFINITY, f64::min) / self.diameter
    }

    /// Whether an error of the width is right.
    fn is_right(&self, error: f64) -> bool {
        error.abs() < self.within
    }
}

/// How far places reach along a direction, times its length \[m\].
fn extent(places: &[Vec3], direction: Vec3) -> f64 {
    let reach = places.iter().map(|place| dot(*place, direction));
    let [low, high] =
        reach.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    high - low
}

fn mean(places: impl ExactSizeIterator<Item = Vec3>) -> Vec3 {
    let count = places.len().max(1) as f64;
    let sum = places.fold([0.0; 3], |sum, place| std::array::from_fn(|i| sum[i] + place[i]));
    sum.map(|x| x / count)
}

impl Task for SoftBall {
    fn defaults(&self) -> Defaults {
        let weights =
            [("width", -1.0), ("offset", -10.0), ("held", 1.0), ("bonus", 100.0), ("penalty", -100.0)];
        let rows =
            ["joint_pos", "joint_vel", "ball", "ball_offset", "width", "width_error", "held", "last_action"];
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
        let [x, y] = self.places.draw(rng)?;
        for &[_, place] in &self.nodes {
            qpos[place] += x;
            qpos[place + 1] += y;
        }
        self.wanted = rng.uniform(self.widths[0], self.widths[1])?;
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let data = &turn.scene.data;
        let right = self.is_right(self.width(data) - self.wanted);
        self.hold.leave(right);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (width, offset) = (self.width(view.data), self.offset(view.data));
        let error = width - self.wanted;
        self.hand.observe(view, rows);
        rows.set("ball", "m", self.nodes.iter().flat_map(|node| view.data.kin.xpos[node[0]]));
        rows.set("ball_offset", "m", offset);
        rows.set("width", "", [width]);
        rows.set("width_error", "", [error]);
        rows.set("held", "s", [self.hold.seconds(self.is_right(error), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (error, away) = (rows["width_error"][0], norm(&rows["ball_offset"]));
        terms.set("width", "", [error.abs()]);
        terms.set("offset", "m", [away]);
        self.hold.judge(rows["held"][0], self.is_right(error), away > self.dropped, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["held".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        keeper.number(&mut self.wanted);
        self.hold.keep(keeper);
    }
}
