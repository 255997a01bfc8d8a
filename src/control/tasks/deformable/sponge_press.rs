//! Pressing a sponge: the closed fingers come down on the middle of its upper face, and go on until the depth is right.

use super::hand::{Hand, Move, down};
use crate::controller::Controller;
use crate::error::ControlError;
use env::Env;
use physics::math::{Vec3, add};

/// How far over the sponge the hand comes \[m\].
const ABOVE: f64 = 0.05;
/// How far the fingers reach below the place between the fingertips \[m\].
const BELOW: f64 = 0.008;
/// Share of the error of the depth that is made up for in a step.
const GAIN: f64 = 0.15;
/// How far a step goes at most \[m\].
const FASTEST: f64 = 0.003;

/// The controller.
pub struct SpongePress {
    hand: Hand,
}

impl SpongePress {
    /// The controller for an arm.
    ///
    /// # Errors
    /// An element is missing.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(SpongePress { hand: Hand::new(env)? })
    }
}

impl Controller for SpongePress {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        let top: Vec3 = std::array::from_fn(|i| env.rows()["top"][i]);
        let over = |height: f64| Move {
            tip: add(top, [0.0, 0.0, BELOW + height]),
            turn: down(0.0),
            fingers: 0.0,
            seconds: 1.5,
            patience: 1.0,
        };
        self.hand.begin(env, vec![over(ABOVE), over(0.0)]);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        if let Some(last) = self.hand.at_rest(env) {
            let further = (GAIN * env.rows()["depth_error"][0]).clamp(-FASTEST, FASTEST);
            let next =
                Move { tip: add(last.tip, [0.0, 0.0, -further]), seconds: env.dt(), patience: 0.0, ..last };
            self.hand.go_on(env, vec![next]);
        }
        self.hand.act(env, action)
    }
}
