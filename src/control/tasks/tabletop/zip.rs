//! A zip: the pull is grasped at its sides and drawn along the teeth.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::grasp::{GENTLE, Grasp, Load, draw, from_above};
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::{BodyId, SiteId};
use physics::math::{quat_from_axis_angle, quat_mul, quat_rotate, scale};
use std::f64::consts::FRAC_PI_2;

/// Width of the pull \[m\].
const WIDTH: f64 = 0.01;
/// Height of the pull over the tapes \[m\].
const HEIGHT: f64 = 0.009;
/// How far beyond its end the slider is drawn \[m\].
const BEYOND: f64 = 0.006;

pub struct Zip {
    zip: BodyId,
    pull: SiteId,
    /// Where `qpos` has the slider, and how far it goes \[m\].
    slider: (usize, f64),
    grasp: Grasp,
}

impl Zip {
    /// The script for the zip of the environment.
    ///
    /// # Errors
    /// The model has no zip.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (scene, m) = (env.scene(), &env.scene().model);
        let slider = scene.joint("zip")?.index();
        Ok(Zip {
            zip: scene.body("zip")?,
            pull: scene.site("zip_pull")?,
            slider: (m.jnt_qposadr[slider] as usize, m.jnt_range[slider][1]),
            grasp: Grasp::new(Load { width: WIDTH, above: 0.04, away: 0.04, touch: GENTLE }),
        })
    }
}

impl Script for Zip {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = Zip::new(env)?;
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let data = &env.scene().data;
        let zip = Frame::of_body(data, self.zip);
        let across = quat_mul(zip.turn, quat_from_axis_angle([0.0, 0.0, 1.0], FRAC_PI_2));
        let pull = Frame { place: data.kin.site_xpos[self.pull.index()], turn: across };
        let left = self.slider.1 - data.state.qpos[self.slider.0] + BEYOND;
        let way = scale(quat_rotate(zip.turn, [1.0, 0.0, 0.0]), left);
        let grasps = || from_above(arm, &pull, WIDTH, HEIGHT, false);
        Ok(self.grasp.next(env, arm, grasps, |step| draw(&arm.tool(env), way, step)))
    }
}
