//! Insertion: the peg is grasped at its upper half, brought over the hole with its faces along those of the hole, and lowered.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::grasp::{GENTLE, Grasp, Load, from_above, place};
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::{BodyId, SiteId};
use physics::math::{quat_from_axis_angle, quat_mul};
use std::f64::consts::FRAC_PI_2;

/// Distance from the middle of the peg at which it is grasped \[m\].
const GRASP: f64 = 0.025;
/// How high over its place the peg arrives: the depth of the hole and a bit \[m\].
const OVER: f64 = 0.05;
/// Height over the bottom of the hole at which it is let go \[m\].
const CLEAR: f64 = 0.002;
/// Half the length of the peg \[m\].
const HALF: f64 = 0.05;

pub struct Insert {
    peg: BodyId,
    board: BodyId,
    bottom: SiteId,
    width: f64,
    grasp: Grasp,
}

impl Insert {
    /// The script for the peg of the environment.
    ///
    /// # Errors
    /// The model has no peg or no board.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let (peg, board) = (scene.body("peg")?, scene.body("board")?);
        let geom = scene.model.body_geomadr[peg.index()].max(0) as usize;
        let width = 2.0 * scene.model.geom_size[geom][0];
        let grasp = Grasp::new(Load { width, above: 0.06, away: 0.05, touch: GENTLE });
        Ok(Insert { peg, board, bottom: scene.site("board_bottom")?, width, grasp })
    }
}

impl Script for Insert {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = Insert::new(env)?;
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let data = &env.scene().data;
        let peg = Frame::of_body(data, self.peg);
        let upper = Frame { place: peg.point([0.0, 0.0, -GRASP]), turn: peg.turn };
        let grasps = || from_above(arm, &upper, self.width, HALF + GRASP, true);
        let board = Frame::of_body(data, self.board).turn;
        let bottom = Frame { place: data.kin.site_xpos[self.bottom.index()], turn: board };
        // The peg's z axis, towards its tip, points down, and the hole is square.
        let down = quat_from_axis_angle([1.0, 0.0, 0.0], 2.0 * FRAC_PI_2);
        let goal = |k: u8| {
            let turn = quat_mul(quat_from_axis_angle([0.0, 0.0, 1.0], f64::from(k) * FRAC_PI_2), down);
            bottom.with(&Frame { place: [0.0, 0.0, HALF + CLEAR], turn })
        };
        let goals: Vec<Frame> = (0..4).map(goal).collect();
        Ok(self.grasp.next(env, arm, grasps, |step| place(&arm.tool(env), &peg, &goals, OVER, step)))
    }
}
