//! Grasping a thing, carrying it and letting it go: approach, reach, grasp, carry in steps, release, retreat.

use super::arm::Arm;
use super::frame::Frame;
use super::moves::Move;
use env::Env;
use physics::math::{Vec3, ops, quat_rotate, scale};
use std::f64::consts::TAU;

/// Gap on each side between the fingers and what they are about to grasp, at most \[m\].
const ROOM: f64 = 0.02;
/// Least distance of fingers from what a thing stands on \[m\].
const CLEAR: f64 = 0.004;

/// What is grasped.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    /// Its width between the fingers \[m\].
    pub width: f64,
    /// How far from the grasp the fingertips begin to approach \[m\].
    pub above: f64,
    /// How far from the thing the hand goes at the end \[m\].
    pub away: f64,
    /// Speed at which it is touched, as a share of full speed, and seconds in which fingers close or open.
    pub touch: [f64; 2],
}

/// The touch of an arm that has time.
pub const GENTLE: [f64; 2] = [0.25, 0.35];

/// A step of carrying, on a straight line.
#[derive(Clone, Debug)]
pub struct Carry {
    /// Where the tool goes: the nearest of these frames.
    pub to: Vec<Frame>,
    /// Speed, as a share of full speed.
    pub speed: f64,
    /// How long the arm waits then \[s\].
    pub pause: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Approach,
    Reach,
    Grasp,
    Carry(usize),
    Retreat,
    Over,
}

/// Grasps a thing, carries it and lets it go.
#[derive(Clone, Debug)]
pub struct Grasp {
    load: Load,
    phase: Phase,
}

impl Grasp {
    /// The phases for a load.
    pub fn new(load: Load) -> Self {
        Grasp { load, phase: Phase::Approach }
    }

    /// Whether the hand has not begun to approach.
    pub fn is_new(&self) -> bool {
        self.phase == Phase::Approach
    }

    /// Whether the fingers have closed, and not opened again.
    pub fn is_carrying(&self) -> bool {
        matches!(self.phase, Phase::Carry(_))
    }

    /// The next move. `grasps` are frames of the tool that hold the thing, `carry` says the steps by their numbers, as long as there are.
    pub fn next(
        &mut self,
        env: &Env,
        arm: &Arm,
        grasps: impl Fn() -> Vec<Frame>,
        carry: impl Fn(usize) -> Option<Carry>,
    ) -> Option<Move> {
        let tool = arm.tool(env);
        let back = |frame: &Frame, way: f64| frame.moved(scale(arm.hand.pointing(frame.turn), -way));
        let open = arm.hand.opening(self.load.width + 2.0 * ROOM);
        let [careful, grip] = self.load.touch;
        let (to, opening, speed, pause, next) = match self.phase {
            Phase::Approach => {
                let away = self.load.above + arm.hand.depth;
                (
                    grasps().iter().map(|frame| back(frame, away)).collect(),
                    open,
                    1.0,
                    0.3 * grip,
                    Phase::Reach,
                )
            }
            Phase::Reach => (grasps(), open, careful, 0.4 * grip, Phase::Grasp),
            Phase::Grasp => (vec![tool], 0.0, careful, grip, Phase::Carry(0)),
            Phase::Carry(step) => match carry(step) {
                Some(Carry { to, speed, pause }) => (to, 0.0, speed, pause, Phase::Carry(step + 1)),
                None => (vec![tool], open, careful, grip, Phase::Retreat),
            },
            Phase::Retreat => (vec![back(&tool, self.load.away)], open, 0.5, 0.0, Phase::Over),
            Phase::Over => return None,
        };
        let straight = self.phase != Phase::Approach;
        let precise = self.phase == Phase::Reach;
        self.phase = next;
        Some(Move { to, straight, opening, speed, pause, precise })
    }
}

/// The steps that place a thing which the tool holds at one of `goals`: up, over the goal by `over` \[m\], and down.
pub fn place(tool: &Frame, thing: &Frame, goals: &[Frame], over: f64, step: usize) -> Option<Carry> {
    put(tool, thing, goals, [0.0, 0.0, over], step)
}

/// The same for goals that are approached from another side: up, beside the goal by `beside` \[m\], and along that way.
pub fn put(tool: &Frame, thing: &Frame, goals: &[Frame], beside: Vec3, step: usize) -> Option<Carry> {
    let held = tool.within(thing);
    let there = goals.iter().map(|goal| goal.with(&held));
    let away = |frame: Frame| frame.moved(beside);
    match step {
        0 => {
            let height = there.map(|frame| away(frame).place[2]).fold(tool.place[2], f64::max);
            let lift = tool.moved([0.0, 0.0, height - tool.place[2]]);
            Some(Carry { to: vec![lift], speed: 0.5, pause: 0.0 })
        }
        1 => Some(Carry { to: there.map(away).collect(), speed: 0.7, pause: 0.3 }),
        2 => Some(Carry { to: there.collect(), speed: GENTLE[0], pause: 0.2 }),
        _ => None,
    }
}

/// The step that draws what the tool holds along a line \[m\].
pub fn draw(tool: &Frame, way: Vec3, step: usize) -> Option<Carry> {
    (step == 0).then(|| Carry { to: vec![tool.moved(way)], speed: GENTLE[0], pause: 0.2 })
}

/// Frames of the tool that hold a thing from above at `thing`'s origin, which is `half` \[m\] over what it stands on: with fingers
/// along its x axis, or with `square` along its y axis as well.
pub fn from_above(arm: &Arm, thing: &Frame, width: f64, half: f64, square: bool) -> Vec<Frame> {
    let x = quat_rotate(thing.turn, [1.0, 0.0, 0.0]);
    let yaw = ops::atan2(x[1], x[0]);
    let height = (arm.hand.depth + CLEAR - half).max(0.0);
    let count = if square { 4 } else { 2 };
    let grasp = |k: usize| {
        let (sine, cosine) = ops::sincos(yaw + k as f64 * TAU / count as f64);
        let hold = arm.hand.around(thing.place, width, [0.0, 0.0, -1.0], [cosine, sine, 0.0]);
        hold.moved([0.0, 0.0, height])
    };
    (0..count).map(grasp).collect()
}
