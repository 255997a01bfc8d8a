//! Straightening a rope: its loose end is grasped, and pulled away from the post until the rope is taut.

use super::hand::{Hand, Move, down};
use super::strand::Strand;
use crate::controller::Controller;
use crate::error::ControlError;
use env::Env;
use physics::math::{ops, sub};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// How much farther than the rope is long its end is pulled.
const TAUT: f64 = 1.003;
/// Directions from the post in which the arm reaches far enough \[rad\].
const DIRECTIONS: [f64; 2] = [-0.3, 0.1];

/// The controller.
pub struct RopeStraighten {
    hand: Hand,
    strand: Strand,
}

impl RopeStraighten {
    /// The controller for an arm and a rope.
    ///
    /// # Errors
    /// An element is missing.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(RopeStraighten { hand: Hand::new(env)?, strand: Strand::new(env)? })
    }
}

impl Controller for RopeStraighten {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        let grip = self.strand.grip(env);
        let way = sub(grip.end, grip.first);
        let direction = ops::atan2(way[1], way[0]).clamp(DIRECTIONS[0], DIRECTIONS[1]);
        let (sine, cosine) = ops::sincos(direction);
        let length = TAUT * grip.length;
        let goal = [grip.first[0] + length * cosine, grip.first[1] + length * sine, grip.place[2]];
        // The hand turns as the link does, the shorter way.
        let turn = (grip.along - direction + PI).rem_euclid(TAU) - PI;
        let (across, aside) = (down(direction + turn + FRAC_PI_2), down(direction + FRAC_PI_2));
        let mut plan = self.strand.grasp(&grip, across);
        plan.push(Move { tip: goal, turn: aside, fingers: 0.0, seconds: 3.0, patience: 1.0 });
        self.hand.begin(env, plan);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        self.hand.act(env, action)
    }
}
