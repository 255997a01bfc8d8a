//! Wrapping a rope round a peg: its loose end is grasped and led round the peg in short straight motions, nearer as less of it is free; over
//! the part that comes from the post it is lifted, and beyond it let go of.

use super::hand::{Hand, Move, down};
use super::strand::Strand;
use crate::controller::Controller;
use crate::error::ControlError;
use env::Env;
use physics::elements::BodyId;
use physics::math::{Vec3, add, norm, ops, sub};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Distance of the rope's middle from that of the peg, round which it is wrapped \[m\].
const RADIUS: f64 = 0.02;
/// Share of the free length at which its end is led.
const SLACK: f64 = 0.88;
/// How far beyond a full turn it is led \[rad\].
const BEYOND: f64 = 0.7;
/// Angle from one motion to the next \[rad\], and how long one takes \[s\].
const STEP: (f64, f64) = (0.4, 0.7);
/// How far it is lifted, and within which angle from the part that it is lifted over \[m, rad\].
const LIFT: (f64, f64) = (0.035, 0.6);
/// How far over the table it is led otherwise \[m\].
const LOW: f64 = 0.005;
/// How far the hand rises when it has let go \[m\].
const AWAY: f64 = 0.12;

/// The controller.
pub struct RopeWrap {
    hand: Hand,
    strand: Strand,
    peg: BodyId,
}

impl RopeWrap {
    /// The controller for an arm, a rope and a body `peg`.
    ///
    /// # Errors
    /// An element is missing.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(RopeWrap { hand: Hand::new(env)?, strand: Strand::new(env)?, peg: env.scene().body("peg")? })
    }
}

impl Controller for RopeWrap {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
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
        // The fingers open across the rope, which points away from the peg, and the wrist turns with it from one end of its range.
        let turn = |angle: f64| down(grip.along - FRAC_PI_2 + angle);
        let towards = |tip, turn, fingers, seconds| Move { tip, turn, fingers, seconds, patience: 0.5 };
        let mut plan = self.strand.grasp(&grip, turn(0.0));
        let count = (round / STEP.0).ceil();
        for k in 1..=count as usize {
            let angle = round * k as f64 / count;
            plan.push(towards(at(angle), turn(angle), 0.0, STEP.1));
        }
        let last = add(at(round), [0.0, 0.0, -LOW]);
        plan.push(towards(last, turn(round), 0.0, 0.5));
        plan.push(towards(last, turn(round), Strand::OPEN, 0.5));
        plan.push(towards(add(last, [0.0, 0.0, AWAY]), turn(round), Strand::OPEN, 1.0));
        self.hand.begin(env, plan);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        self.hand.act(env, action)
    }
}
