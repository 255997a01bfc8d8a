//! Pressing a sponge: the closed fingers come down on the middle of its upper face, and go on until the depth is right.

use crate::error::ControlError;
use crate::tasks::arms::arm::Arm;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::moves::{Move, Script};
use env::Env;
use physics::math::{Vec3, add};

/// How far over the sponge the hand comes \[m\].
const ABOVE: f64 = 0.05;
/// How far the fingers reach below the place between the fingertips \[m\].
const BELOW: f64 = 0.008;
/// Share of the error of the depth that is made up for in a move.
const GAIN: f64 = 0.25;
/// How far a move goes at most \[m\].
const FASTEST: f64 = 0.005;

#[derive(Default)]
pub struct SpongePress {
    /// Where the tool was told to be last, from over the sponge.
    told: Option<Frame>,
    moves: usize,
}

impl Script for SpongePress {
    fn begin(&mut self, env: &Env, arm: &Arm) -> Result<(), ControlError> {
        let top: Vec3 = std::array::from_fn(|i| env.rows()["top"][i]);
        let place = add(top, [0.0, 0.0, BELOW + ABOVE]);
        let above = arm.hand.around(place, 0.0, [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]);
        *self = SpongePress { told: Some(above), moves: 0 };
        Ok(())
    }

    fn next(&mut self, env: &Env, _: &Arm) -> Result<Option<Move>, ControlError> {
        let Some(told) = self.told else { return Ok(None) };
        let further = match self.moves {
            0 => 0.0,
            1 => ABOVE,
            _ => (GAIN * env.rows()["depth_error"][0]).clamp(-FASTEST, FASTEST),
        };
        let to = told.moved([0.0, 0.0, -further]);
        let pressing = self.moves > 1;
        (self.told, self.moves) = (Some(to), self.moves + 1);
        Ok(Some(Move { precise: !pressing, ..Move::precise(to, 0.0, 0.5, if pressing { 0.0 } else { 0.2 }) }))
    }
}
