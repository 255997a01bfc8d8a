//! Pouring grains: the cup is brought beside the bowl, low over its rim, and tilted about the axis of the hand at about a radian a second.

use super::held::{Held, Work};
use crate::error::ControlError;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::moves::Move;
use env::Env;
use physics::elements::BodyId;
use physics::math::{add, cross, quat_from_axis_angle, quat_mul, quat_rotate, scale};

/// Where the middle of the cup is when it pours: before the middle of the bowl and over its bottom \[m\].
const POUR: (f64, f64) = (0.075, 0.15);
/// Opening of the gripper around the cup.
const AROUND: f64 = 0.9;
/// How far the cup is tilted \[rad\], and the speed of that as a share of full speed.
const TILT: (f64, f64) = (2.3, 0.8);
/// How long the cup is kept tilted before it is said whether enough is in the bowl \[s\].
const PAUSE: f64 = 1.0;

pub struct GrainPour {
    cup: BodyId,
    bowl: BodyId,
}

impl GrainPour {
    /// The script for an arm whose tool has the axis about which the cup is tilted, level, as its z axis.
    ///
    /// # Errors
    /// The environment has no cup or no bowl.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(GrainPour { cup: env.scene().body("cup")?, bowl: env.scene().body("bowl")? })
    }
}

impl Work for GrainPour {
    fn body(&self) -> BodyId {
        self.cup
    }

    fn plan(&self, held: &Held, env: &Env) -> Vec<Move> {
        let axis = quat_rotate(held.tool(held.frame).turn, [0.0, 0.0, 1.0]);
        // The rim tilts to this side.
        let ahead = cross(axis, [0.0, 0.0, 1.0]);
        let (before, over) = POUR;
        let bowl = *env.scene().data.body(self.bowl).xpos();
        let place = add(add(bowl, scale(ahead, -before)), [0.0, 0.0, over]);
        let turned = |angle| {
            let turn = quat_mul(quat_from_axis_angle(axis, angle), held.frame.turn);
            held.tool(Frame { place, turn })
        };
        vec![
            Move::precise(turned(0.0), AROUND, 0.4, 0.5),
            Move::precise(turned(TILT.0), AROUND, TILT.1, PAUSE),
        ]
    }
}
