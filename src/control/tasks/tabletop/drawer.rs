//! A drawer: it is drawn by its handle, and then a brick is grasped from above and let fall into it.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::grasp::{GENTLE, Grasp, Load, draw, from_above, place};
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::{BodyId, SiteId};
use physics::math::{quat_from_axis_angle, quat_mul, quat_rotate, scale};
use std::f64::consts::FRAC_PI_2;

/// Diameter of the handle \[m\].
const HANDLE: f64 = 0.01;
/// How far the drawer is opened \[m\].
const OPEN: f64 = 0.17;
/// Width of the brick between the fingers, and half its height \[m\].
const BRICK: f64 = 0.025;
const HALF: f64 = 0.01;
/// Where in the drawer the brick is let go, so that the hand is clear of the desk and of the drawer's front \[m\].
const GOAL: [f64; 3] = [-0.153, 0.0, -0.03];
/// How high over that place the brick arrives \[m\].
const OVER: f64 = 0.14;

pub struct Drawer {
    drawer: BodyId,
    handle: SiteId,
    brick: BodyId,
    pull: Grasp,
    grasp: Grasp,
}

impl Drawer {
    /// The script for the drawer of the environment.
    ///
    /// # Errors
    /// The model has no drawer or no brick.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        Ok(Drawer {
            drawer: scene.body("desk_drawer")?,
            handle: scene.site("desk_drawer")?,
            brick: scene.body("block")?,
            pull: Grasp::new(Load { width: HANDLE, above: 0.06, away: 0.1, touch: GENTLE }),
            grasp: Grasp::new(Load { width: BRICK, above: 0.05, away: 0.12, touch: GENTLE }),
        })
    }
}

impl Script for Drawer {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = Drawer::new(env)?;
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let data = &env.scene().data;
        let drawer = Frame::of_body(data, self.drawer);
        let ahead = quat_rotate(drawer.turn, [1.0, 0.0, 0.0]);
        let handle = data.kin.site_xpos[self.handle.index()];
        // Fingers above and below the handle.
        let holds =
            || [1.0, -1.0].map(|side| arm.hand.around(handle, HANDLE, ahead, [0.0, 0.0, side])).to_vec();
        let out = |step| draw(&arm.tool(env), scale(ahead, -OPEN), step);
        if let Some(step) = self.pull.next(env, arm, holds, out) {
            return Ok(Some(step));
        }
        let across = quat_from_axis_angle([0.0, 0.0, 1.0], FRAC_PI_2);
        let brick = Frame::of_body(data, self.brick);
        let middle = Frame { place: brick.point([0.0, 0.0, HALF]), turn: quat_mul(brick.turn, across) };
        let grasps = || from_above(arm, &middle, BRICK, HALF, false);
        // The brick along the drawer, so that the hand is across.
        let goals = [0.0, 2.0].map(|quarters| {
            let turn = quat_from_axis_angle([0.0, 0.0, 1.0], quarters * FRAC_PI_2);
            drawer.with(&Frame { place: GOAL, turn })
        });
        Ok(self.grasp.next(env, arm, grasps, |step| place(&arm.tool(env), &brick, &goals, OVER, step)))
    }
}
