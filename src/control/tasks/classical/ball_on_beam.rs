//! A ball on a beam by the regulator of a point that slides down the slope of the beam, five sevenths as fast as without rolling
//! (Hauser, Sastry and Kokotović 1992, whose ball rolls on its largest circle); the beam follows its servo within a fraction of the
//! time in which the ball moves. The regulator feeds back the sum of the offsets too: contacts hold a ball that is nearly at rest.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::{Regulator, discrete};
use env::Env;
use nalgebra::DMatrix;

/// Acceleration of a rolling ball along a slope, over that of a point that slides.
const ROLLING: f64 = 5.0 / 7.0;

/// Offset from the mark within which the sum grows \[m\].
const NEAR: f64 = 0.1;

pub struct BallOnBeam {
    regulator: Regulator,
    /// Integral of the offset from the mark \[m s\].
    sum: f64,
}

impl BallOnBeam {
    /// The controller.
    ///
    /// # Errors
    /// An observation without the ball.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        for row in ["target_error", "ball_velocity"] {
            if env.rows().get(row).is_none() {
                return Err(ControlError::unfit(env, format!("the observation {row} is needed")));
            }
        }
        let (dt, fall) = (env.dt(), -ROLLING * env.scene().model.opt.gravity[2]);
        // Offset from the mark, speed, sum of the offsets; the angle that lifts the far end brakes the ball.
        let a = DMatrix::from_row_slice(3, 3, &[1.0, dt, 0.0, 0.0, 1.0, 0.0, dt, 0.0, 1.0]);
        let b = DMatrix::from_row_slice(3, 1, &[-0.5 * fall * dt * dt, -fall * dt, 0.0]);
        let q = DMatrix::from_row_slice(3, 3, &[10.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 5.0]);
        Ok(BallOnBeam { regulator: discrete(&a, &b, &q, &DMatrix::from_element(1, 1, 10.0))?, sum: 0.0 })
    }
}

impl Controller for BallOnBeam {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        self.sum = 0.0;
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let (offset, speed) = (-env.rows()["target_error"][0], env.rows()["ball_velocity"][0]);
        // On the way the servo is at its limit, and the sum would only grow.
        self.sum = if offset.abs() < NEAR { self.sum + offset * env.dt() } else { 0.0 };
        let mut angle = [0.0];
        self.regulator.feed_back(&[offset, speed, self.sum], &mut angle);
        command(env, &angle, action)
    }
}
