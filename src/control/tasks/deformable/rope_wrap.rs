//! Wrapping a rope round a peg: its loose end is grasped and led round the peg in short straight motions, nearer as less of it is free; over
//! the part that comes from the post it is lifted, and beyond it let go of. Where it is lost on the way it is grasped again.

use super::strand::Strand;
use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::elements::BodyId;
use physics::math::{Vec3, add, norm, ops, sub};
use std::f64::consts::{PI, TAU};
use std::ops::Range;

/// Distance of the rope's middle from that of the peg, round which it is wrapped \[m\].
const RADIUS: f64 = 0.02;
/// Share of the free length at which its end is led.
const SLACK: f64 = 0.88;
/// How far beyond a full turn it is led \[rad\].
const BEYOND: f64 = 0.7;
/// Seconds in which the fingers close: a hand that turns sideways at once loses a post.
const CLOSE: f64 = 0.8;
/// Angle from one move to the next \[rad\], and its speed as a share of full speed.
const STEP: (f64, f64) = (0.4, 0.6);
/// How far it is lifted, and within which angle from the part that it is lifted over \[m, rad\].
const LIFT: (f64, f64) = (0.035, 0.6);
/// How far over the table it is led otherwise, and let go of at half of that \[m\].
const LOW: f64 = 0.01;
/// How far the hand rises when it has let go \[m\].
const AWAY: f64 = 0.12;

pub struct RopeWrap {
    strand: Strand,
    peg: BodyId,
    /// What is left to do.
    plan: std::vec::IntoIter<Move>,
    /// Of how many moves left the rope is in the hand before the next.
    carrying: Range<usize>,
}

impl RopeWrap {
    /// The script for the rope and the body `peg` of the environment.
    ///
    /// # Errors
    /// It has none.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let plan = Vec::new().into_iter();
        Ok(RopeWrap { strand: Strand::new(env)?, peg: env.scene().body("peg")?, plan, carrying: 0..0 })
    }
}

impl Script for RopeWrap {
    fn begin(&mut self, env: &Env, arm: &Arm) -> Result<(), ControlError> {
        let grip = self.strand.grip(env);
        let peg = *env.scene().data.body(self.peg).xpos();
        let to_post = sub(grip.first, peg);
        let to_hand = sub(grip.place, peg);
        let from = ops::atan2(to_hand[1], to_hand[0]);
        let post = ops::atan2(to_post[1], to_post[0]);
        // Counterclockwise from where the hand is to a full turn after the post, and beyond.
        let round = (post - from).rem_euclid(TAU) + BEYOND;
        let swept = (from - post).rem_euclid(TAU);
        let post_distance = norm([to_post[0], to_post[1], 0.0]);
        let at = |angle: f64| -> Vec3 {
            let wound = RADIUS * (swept + angle - PI).max(0.0);
            let free = SLACK * (grip.length - post_distance - wound);
            let over = (from + angle - post + PI).rem_euclid(TAU) - PI;
            let height = if over.abs() < LIFT.1 { LIFT.0 } else { LOW };
            let (sine, cosine) = ops::sincos(from + angle);
            [peg[0] + free * cosine, peg[1] + free * sine, grip.place[2] + height]
        };
        // The rope points away from the peg, and the wrist turns with it from one end of its range. A post that
        // is held across the fingers instead is dropped on the way.
        let closing = |angle: f64| grip.along - self.strand.closing(PI) + angle;
        let (mut plan, open) = (self.strand.grasp(arm, &grip, closing(0.0), CLOSE), self.strand.opening(arm));
        let (count, grasped) = ((round / STEP.0).ceil(), plan.len());
        for k in 1..=count as usize {
            let angle = round * k as f64 / count;
            plan.push(Move::precise(self.strand.down(arm, at(angle), closing(angle)), 0.0, STEP.1, 0.0));
        }
        let last = self.strand.down(arm, add(at(round), [0.0, 0.0, -LOW / 2.0]), closing(round));
        plan.push(Move::precise(last, 0.0, 0.5, 0.2));
        plan.push(Move::precise(last, open, 0.5, 0.4));
        plan.push(Move::precise(last.moved([0.0, 0.0, AWAY]), open, 0.5, 0.0));
        self.carrying = 2..plan.len() - grasped;
        self.plan = plan.into_iter();
        Ok(())
    }

    fn next(&mut self, env: &Env, arm: &Arm) -> Result<Option<Move>, ControlError> {
        if self.carrying.contains(&self.plan.len()) && self.strand.is_lost(env, arm) {
            self.begin(env, arm)?;
        }
        Ok(self.plan.next())
    }
}
