//! Grasping a thing and placing it: approach, grasp, lift, carry, lower, release, retreat.

use super::arm::Arm;
use super::frame::Frame;
use super::moves::Move;
use env::Env;
use physics::math::scale;
use std::f64::consts::FRAC_PI_2;

/// Speed at which things are touched and set down, as a share of full speed.
const CAREFUL: f64 = 0.25;
/// Seconds in which fingers close, or open.
const GRIP: f64 = 0.35;
/// Gap on each side between the fingers and what they are about to grasp, at most \[m\].
const ROOM: f64 = 0.02;

/// What is grasped, and how high it is carried.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    /// Its width between the fingers \[m\].
    pub width: f64,
    /// How far from the grasp the hand begins to approach \[m\].
    pub above: f64,
    /// How high over its goal the thing arrives \[m\].
    pub over: f64,
    /// How far from the thing the arm goes at the end \[m\].
    pub away: f64,
}

/// The phases of grasping and placing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    Approach,
    Reach,
    Grasp,
    Lift,
    Carry,
    Lower,
    Release,
    Retreat,
    Over,
}

/// Grasps a thing and places it.
#[derive(Clone, Debug)]
pub struct GraspPlace {
    load: Load,
    phase: Phase,
}

impl GraspPlace {
    /// The phases for a load.
    pub fn new(load: Load) -> Self {
        GraspPlace { load, phase: Phase::Approach }
    }

    /// The next move. `grasps` are frames of the tool that hold the thing, `thing` is where it is, and `goals` are where it may be placed.
    pub fn next(
        &mut self,
        env: &Env,
        arm: &Arm,
        thing: &Frame,
        grasps: impl Fn() -> Vec<Frame>,
        goals: impl Fn() -> Vec<Frame>,
    ) -> Option<Move> {
        use Phase::{Approach, Carry, Grasp, Lift, Lower, Over, Reach, Release, Retreat};
        let tool = arm.tool(env);
        let over = |frame: &Frame| frame.moved([0.0, 0.0, self.load.over]);
        let back = |frame: &Frame, way: f64| frame.moved(scale(arm.hand.pointing(frame.turn), -way));
        let held = tool.within(thing);
        // The tool may have come to stand on either side of the thing: of all grasps and goals the nearest is taken.
        let placed = || goals().iter().map(|goal| goal.with(&held)).collect::<Vec<_>>();
        let open = arm.hand.opening(self.load.width + 2.0 * ROOM);
        let (to, straight, opening, speed, pause, next) = match self.phase {
            Approach => {
                let to = grasps().iter().map(|frame| back(frame, self.load.above)).collect();
                (to, false, open, 1.0, 0.1, Reach)
            }
            Reach => {
                let nearest = grasps();
                (nearest, true, open, CAREFUL, 0.15, Grasp)
            }
            Grasp => (vec![tool], true, 0.0, CAREFUL, GRIP, Lift),
            Lift => {
                let height = placed().iter().map(|frame| over(frame).place[2]).fold(tool.place[2], f64::max);
                (vec![tool.moved([0.0, 0.0, height - tool.place[2]])], true, 0.0, 0.5, 0.0, Carry)
            }
            Carry => (placed().iter().map(over).collect(), true, 0.0, 0.7, 0.3, Lower),
            Lower => (placed(), true, 0.0, CAREFUL, 0.2, Release),
            Release => (vec![tool], true, open, CAREFUL, GRIP, Retreat),
            Retreat => (vec![back(&tool, self.load.away)], true, open, 0.5, 0.0, Over),
            Over => return None,
        };
        self.phase = next;
        Some(Move { to, straight, opening, speed, pause })
    }
}

/// Frames of the tool that hold a thing from above at `thing`'s origin, which is `half` \[m\] over what it stands on: with fingers
/// along its x axis, or with `square` along its y axis as well.
pub fn from_above(arm: &Arm, thing: &Frame, width: f64, half: f64, square: bool) -> Vec<Frame> {
    /// Least distance of fingers from what the thing stands on \[m\].
    const CLEAR: f64 = 0.004;
    let x = physics::math::quat_rotate(thing.turn, [1.0, 0.0, 0.0]);
    let yaw = physics::math::ops::atan2(x[1], x[0]);
    let height = (arm.hand.depth + CLEAR - half).max(0.0);
    let count = if square { 4 } else { 2 };
    let grasp = |k: usize| {
        let (sine, cosine) = physics::math::ops::sincos(yaw + k as f64 * FRAC_PI_2 * 4.0 / count as f64);
        let hold = arm.hand.around(thing.place, width, [0.0, 0.0, -1.0], [cosine, sine, 0.0]);
        hold.moved([0.0, 0.0, height])
    };
    (0..count).map(grasp).collect()
}
