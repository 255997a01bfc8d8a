//! Pouring grains: the cup is brought beside the bowl, low over its rim, and tilted about the axis of the hand at about a radian a second.

use super::hand::{Hand, Move};
use crate::controller::Controller;
use crate::error::ControlError;
use env::Env;
use physics::elements::BodyId;
use physics::math::{Quat, Vec3, add, ops, quat_mul};

/// Where the fingertips are over the bottom of the bowl when they pour \[m\].
const POUR: Vec3 = [0.0, -0.075, 0.15];
/// Where the fingers are on the sides of the cup \[m\].
const CLOSED: f64 = 0.036;
/// How far the cup is tilted \[rad\], and how long that takes \[s\].
const TILT: (f64, f64) = (2.3, 3.5);

/// The controller.
pub struct GrainPour {
    hand: Hand,
    bowl: BodyId,
}

impl GrainPour {
    /// The controller for an arm whose hand holds the cup from the side.
    ///
    /// # Errors
    /// An element is missing.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(GrainPour { hand: Hand::new(env)?, bowl: env.scene().body("bowl")? })
    }
}

impl Controller for GrainPour {
    fn reset(&mut self, env: &Env, _: u64) -> Result<(), ControlError> {
        let tip = add(*env.scene().data.body(self.bowl).xpos(), POUR);
        let level = self.hand.turn(env);
        let (sine, cosine) = ops::sincos(TILT.0 / 2.0);
        let tilted: Quat = quat_mul(level, [cosine, 0.0, 0.0, sine]);
        let over = |turn, seconds, patience| Move { tip, turn, fingers: CLOSED, seconds, patience };
        self.hand.begin(env, vec![over(level, 2.5, 1.0), over(tilted, TILT.1, 0.0)]);
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        self.hand.act(env, action)
    }
}
