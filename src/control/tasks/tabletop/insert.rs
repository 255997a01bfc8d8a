//! Insertion: a peg, or a plug, is grasped from above, brought before the hole with its faces along those of the hole, and put in.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::extent::around;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::grasp::{GENTLE, Grasp, Load, from_above, put};
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::{BodyId, SiteId};
use physics::math::{quat_from_axis_angle, quat_mul, quat_rotate, scale};
use std::f64::consts::PI;

/// How far before the bottom of the hole the tip arrives: the depth of the hole and a bit \[m\].
const BEFORE: f64 = 0.05;
/// Distance of the tip from the bottom of the hole at which a thing is let go \[m\].
const CLEAR: f64 = 0.002;

pub struct Insert {
    thing: BodyId,
    bottom: SiteId,
    /// Distance of the tip from the thing's origin along its z axis, and of the part that is grasped \[m\].
    tip: f64,
    grip: f64,
    /// Distance of the tip from the bottom at the end \[m\].
    clear: f64,
    /// In how many ways the thing goes in: four if its shaft is square.
    ways: usize,
    width: f64,
    grasp: Grasp,
}

impl Insert {
    /// The script for the thing and the seat of the environment.
    ///
    /// # Errors
    /// The task has no settings that name them, or the model has no such things.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (scene, args) = (env.scene(), &env.spec().args);
        let missing = |setting: &str| ControlError::unfit(env, format!("the setting {setting} is needed"));
        let [thing, seat]: [String; 2] = args.get("bodies").ok_or_else(|| missing("bodies"))?;
        let shafts: Vec<usize> = args.get("shafts").ok_or_else(|| missing("shafts"))?;
        let released: bool = args.get("released").ok_or_else(|| missing("released"))?;
        let (m, body) = (&scene.model, scene.body(&thing)?);
        let first = m.body_geomadr[body.index()].max(0) as usize;
        let [x, y, _] = m.geom_size[first + shafts.first().ok_or_else(|| missing("shafts"))?];
        let width = 2.0 * m.geom_size[first][0];
        Ok(Insert {
            thing: body,
            bottom: scene.site(&format!("{seat}_bottom"))?,
            tip: m.site_pos[scene.site(&format!("{thing}_tip"))?.index()][2],
            grip: args.get("grip").ok_or_else(|| missing("grip"))?,
            clear: if released { CLEAR } else { 0.0 },
            ways: if x == y { 4 } else { 2 },
            width,
            grasp: Grasp::new(Load { width, above: 0.06, away: 0.05, touch: GENTLE }),
        })
    }
}

impl Script for Insert {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = Insert::new(env)?;
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let (m, data) = (&env.scene().model, &env.scene().data);
        let thing = Frame::of_body(data, self.thing);
        let part = Frame { place: thing.point([0.0, 0.0, self.grip]), turn: thing.turn };
        let grasps = || {
            let (whole, _, half) = around(m, data, self.thing, 0.0);
            from_above(arm, &part, self.width, half + part.place[2] - whole.place[2], self.ways == 4)
        };
        // The z axis of the thing points into the hole, that of the bottom out of it.
        let bottom = Frame::of_site(data, self.bottom);
        let inwards = quat_from_axis_angle([1.0, 0.0, 0.0], PI);
        let goal = |k: usize| {
            let turn = quat_from_axis_angle([0.0, 0.0, 1.0], k as f64 * 2.0 * PI / self.ways as f64);
            bottom.with(&Frame { place: [0.0, 0.0, self.tip + self.clear], turn: quat_mul(turn, inwards) })
        };
        let goals: Vec<Frame> = (0..self.ways).map(goal).collect();
        let before = scale(quat_rotate(bottom.turn, [0.0, 0.0, 1.0]), BEFORE);
        Ok(self.grasp.next(env, arm, grasps, |step| put(&arm.tool(env), &thing, &goals, before, step)))
    }
}
