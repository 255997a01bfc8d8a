//! Hanging a cloth over a bar: the rod with the handle is grasped, lifted higher than the bar, led over it with the cloth behind until its middle
//! is there, and let go of.

use super::rods::Rods;
use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::GeomId;

/// How high over the bar's axis the rod is led \[m\].
const OVER: f64 = 0.05;
/// How far beyond the bar it is led: with its height about half of the cloth's length \[m\].
const BEYOND: f64 = 0.085;
/// Distance of the cloth's middle from the bar with which no more is done \[m\].
const NEAR: f64 = 0.028;

pub struct ClothHang {
    rods: Rods,
    bar: GeomId,
}

impl ClothHang {
    /// The script for the cloth and the bar of the environment.
    ///
    /// # Errors
    /// It has none.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(ClothHang { rods: Rods::new(env)?, bar: env.scene().geom("bar")? })
    }
}

impl Script for ClothHang {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = ClothHang::new(env)?;
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let ([x, y, _], bar) =
            (self.rods.frames(env)[0].place, env.scene().data.kin.geom_xpos[self.bar.index()]);
        let height = bar[2] + OVER;
        let way = |step| match step {
            0 => Some([x, y, height]),
            1 => Some([bar[0] + BEYOND, y, height]),
            _ => None,
        };
        Ok(self.rods.next(env, arm, env.rows()["off"][0] > NEAR, way))
    }
}
