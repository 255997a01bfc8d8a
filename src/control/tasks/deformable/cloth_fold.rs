//! Folding a cloth: the rod along its first side is grasped, carried over in an arc and let go of beside the other one.

use super::rods::Rods;
use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::math::{add, distance, normalize, scale, sub};

/// How high the rod is carried over the straight way, as a share of that and at least \[m\].
const ARC: (f64, f64) = (0.35, 0.03);
/// How far before the other rod, and how high over it, so that fingers pass, it is let go of \[m\].
const BEFORE: f64 = 0.008;
const DROP: f64 = 0.013;
/// Distance of the rods that will do \[m\].
const NEAR: f64 = 0.018;

pub struct ClothFold {
    rods: Rods,
}

impl ClothFold {
    /// The script for the cloth of the environment.
    ///
    /// # Errors
    /// It has none.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(ClothFold { rods: Rods::new(env)? })
    }
}

impl Script for ClothFold {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = ClothFold::new(env)?;
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let [rod, other] = self.rods.frames(env).map(|frame| frame.place);
        let (back, length) = normalize(sub(rod, other));
        let goal = add(add(other, scale(back, BEFORE)), [0.0, 0.0, DROP]);
        let way = |step| match step {
            0 => {
                let height = (ARC.0 * distance(goal, rod)).max(ARC.1);
                Some(add(scale(add(rod, goal), 0.5), [0.0, 0.0, height]))
            }
            1 => Some(goal),
            _ => None,
        };
        Ok(self.rods.next(env, arm, length > NEAR, way))
    }
}
