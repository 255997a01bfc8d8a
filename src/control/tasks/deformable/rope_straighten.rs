//! Straightening a rope: its loose end is grasped, and pulled away from the post until the rope is taut, farther where it has come to lie otherwise in
//! the hand.

use super::strand::Strand;
use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::math::{Vec3, ops, scale, sub};
use std::f64::consts::{PI, TAU};

/// How much farther than the rope is long its end is pulled.
const TAUT: f64 = 1.003;
/// Directions from the post in which the arm reaches far enough \[rad\].
const DIRECTIONS: [f64; 2] = [-0.3, 0.1];

/// Seconds in which the fingers close.
const CLOSE: f64 = 0.4;
/// How much farther the hand goes while the rope is not straight \[m\], how often, and how fast, as a share of full speed.
const FARTHER: (f64, usize, f64) = (0.01, 4, 0.3);

pub struct RopeStraighten {
    strand: Strand,
    /// What is left to do.
    plan: std::vec::IntoIter<Move>,
    /// Where the hand pulls the rope, and how it goes farther.
    pull: Option<(Frame, Vec3)>,
    farther: usize,
}

impl RopeStraighten {
    /// The script for the rope of the environment.
    ///
    /// # Errors
    /// It has none.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(RopeStraighten { strand: Strand::new(env)?, plan: Vec::new().into_iter(), pull: None, farther: 0 })
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
        // Taken at 0 degrees, 20 of 20 posts stay in the hand; at 180, 16.
        let mut plan = self.strand.grasp(arm, &grip, direction + turn + self.strand.closing(0.0), CLOSE);
        let taut = self.strand.down(arm, goal, direction + self.strand.closing(0.0));
        plan.push(Move::precise(taut, 0.0, 0.35, 1.0));
        (self.plan, self.farther) = (plan.into_iter(), 0);
        self.pull = Some((taut, scale([cosine, sine, 0.0], FARTHER.0)));
        Ok(())
    }

    fn next(&mut self, env: &Env, _: &Arm) -> Result<Option<Move>, ControlError> {
        let planned = self.plan.next();
        let (None, Some((pull, way))) = (&planned, &mut self.pull) else { return Ok(planned) };
        if env.rows()["held"][0] > 0.0 || self.farther == FARTHER.1 {
            return Ok(None);
        }
        self.farther += 1;
        *pull = pull.moved(*way);
        Ok(Some(Move::precise(*pull, 0.0, FARTHER.2, 0.1)))
    }
}
