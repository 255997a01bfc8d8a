//! Stacking: one cube is grasped from above and set on the other.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::grasp::{GENTLE, Grasp, Load, from_above, place};
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::BodyId;

/// Clearance of the cube over the other one when it is let go \[m\].
const CLEAR: f64 = 0.001;
/// How high over its place the cube arrives \[m\].
const OVER: f64 = 0.015;

pub struct Stack {
    cube: BodyId,
    base: BodyId,
    half: f64,
    grasp: Grasp,
}

impl Stack {
    /// The script for the cubes of the environment.
    ///
    /// # Errors
    /// The model has no cubes.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let (cube, base) = (scene.body("cube_a")?, scene.body("cube_b")?);
        let half = scene.model.geom_size[scene.geom("cube_a")?.index()][0];
        let load = Load { width: 2.0 * half, above: 0.05, away: 0.04, touch: GENTLE };
        Ok(Stack { cube, base, half, grasp: Grasp::new(load) })
    }
}

impl Script for Stack {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = Stack::new(env)?;
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let (data, half) = (&env.scene().data, self.half);
        let (cube, base) = (Frame::of_body(data, self.cube), Frame::of_body(data, self.base));
        let grasps = || from_above(arm, &cube, 2.0 * half, half, true);
        let goal = Frame { place: base.place, turn: cube.turn }.moved([0.0, 0.0, 2.0 * half + CLEAR]);
        let carry = |step| place(&arm.tool(env), &cube, &[goal], OVER, step);
        Ok(self.grasp.next(env, arm, grasps, carry))
    }
}
