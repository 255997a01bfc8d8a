//! Straightening a rope: its loose end is grasped, and pulled away from the post until the rope is taut.

use super::strand::{Strand, down};
use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::math::{ops, sub};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// How much farther than the rope is long its end is pulled.
const TAUT: f64 = 1.003;
/// Directions from the post in which the arm reaches far enough \[rad\].
const DIRECTIONS: [f64; 2] = [-0.3, 0.1];

pub struct RopeStraighten {
    strand: Strand,
    /// What is left to do.
    plan: std::vec::IntoIter<Move>,
}

impl RopeStraighten {
    /// The script for the rope of the environment.
    ///
    /// # Errors
    /// It has none.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(RopeStraighten { strand: Strand::new(env)?, plan: Vec::new().into_iter() })
    }
}

impl Script for RopeStraighten {
    fn begin(&mut self, env: &Env, arm: &Arm) -> Result<(), ControlError> {
        let grip = self.strand.grip(env);
        let way = sub(grip.end, grip.first);
        let direction = ops::atan2(way[1], way[0]).clamp(DIRECTIONS[0], DIRECTIONS[1]);
        let (sine, cosine) = ops::sincos(direction);
        let length = TAUT * grip.length;
        let goal = [grip.first[0] + length * cosine, grip.first[1] + length * sine, grip.place[2]];
        // The hand turns as the link does, the shorter way.
        let turn = (grip.along - direction + PI).rem_euclid(TAU) - PI;
        let mut plan = self.strand.grasp(arm, &grip, direction + turn + FRAC_PI_2);
        plan.push(Move::precise(down(arm, goal, direction + FRAC_PI_2), 0.0, 0.35, 1.0));
        self.plan = plan.into_iter();
        Ok(())
    }

    fn next(&mut self, _: &Env, _: &Arm) -> Result<Option<Move>, ControlError> {
        Ok(self.plan.next())
    }
}
