//! Spreading a cloth: the rod with the handle is grasped, carried over to the side where the cloth lies flat, and let go of when it is taut.

use super::rods::Rods;
use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::math::{Vec3, add, cross, distance, normalize, quat_rotate, scale};

/// How high the rod is carried over the straight way, as a share of that and at least \[m\].
const ARC: (f64, f64) = (0.35, 0.02);
/// Distance of the rods at which the cloth is taut \[m\].
const TAUT: f64 = 0.182;
/// How far over the height of the other rod it is let go of \[m\].
const DROP: f64 = 0.004;
/// Share that is covered with which no more is done.
const SPREAD: f64 = 0.93;

pub struct ClothSpread {
    rods: Rods,
}

impl ClothSpread {
    /// The script for the cloth of the environment.
    ///
    /// # Errors
    /// It has none.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(ClothSpread { rods: Rods::new(env)? })
    }
}

impl Script for ClothSpread {
    fn begin(&mut self, env: &Env, _: &Arm) -> Result<(), ControlError> {
        *self = ClothSpread::new(env)?;
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        let [rod, other] = self.rods.frames(env);
        // Seen along the other rod, the cloth begins to its left.
        let along: Vec3 = quat_rotate(other.turn, [0.0, 1.0, 0.0]);
        let (flat, _) = normalize(cross([0.0, 0.0, 1.0], along));
        let goal = add(add(other.place, scale(flat, TAUT)), [0.0, 0.0, DROP]);
        let way = |step| match step {
            0 => {
                let height = (ARC.0 * distance(goal, rod.place)).max(ARC.1);
                Some(add(scale(add(rod.place, goal), 0.5), [0.0, 0.0, height]))
            }
            1 => Some(goal),
            _ => None,
        };
        Ok(self.rods.next(env, arm, env.rows()["covered"][0] < SPREAD, way))
    }
}
