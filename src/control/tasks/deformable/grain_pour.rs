//! Pouring grains: the cup is brought beside the bowl, low over its rim, and tilted about the axis of the hand at about a radian a second.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::BodyId;
use physics::math::{Vec3, add, ops, quat_mul};

/// Where the fingertips are over the bottom of the bowl when they pour \[m\].
const POUR: Vec3 = [0.0, -0.075, 0.15];
/// Opening of the gripper around the cup.
const AROUND: f64 = 0.9;
/// How far the cup is tilted \[rad\], and the speed of that as a share of full speed.
const TILT: (f64, f64) = (2.3, 0.8);

pub struct GrainPour {
    bowl: BodyId,
    /// What is left to do.
    plan: std::vec::IntoIter<Move>,
}

impl GrainPour {
    /// The script for an arm whose hand holds the cup from the side.
    ///
    /// # Errors
    /// The environment has no bowl.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(GrainPour { bowl: env.scene().body("bowl")?, plan: Vec::new().into_iter() })
    }
}

impl Script for GrainPour {
    fn begin(&mut self, env: &Env, arm: &Arm) -> Result<(), ControlError> {
        let place = add(*env.scene().data.body(self.bowl).xpos(), POUR);
        let level = Frame { place, turn: arm.tool(env).turn };
        let (sine, cosine) = ops::sincos(TILT.0 / 2.0);
        let tilted = Frame { place, turn: quat_mul(level.turn, [cosine, 0.0, 0.0, sine]) };
        let plan = vec![Move::precise(level, AROUND, 0.4, 0.5), Move::precise(tilted, AROUND, TILT.1, 0.0)];
        self.plan = plan.into_iter();
        Ok(())
    }

    fn next(&mut self, _: &Env, _: &Arm) -> Result<Option<Move>, ControlError> {
        Ok(self.plan.next())
    }
}
