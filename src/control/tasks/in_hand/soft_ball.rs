//! Squeezing a soft ball: the joints go from the cradle towards the closed hand, as far as the measured width asks for.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::tasks::joints::Servo;
use crate::tasks::roles::roles_of;
use env::Env;

/// How fast the hand closes for an error of the width of one \[1/s\], and at most \[1/s\].
const GAIN: f64 = 8.0;
const FASTEST: f64 = 0.8;
/// How far beyond the closed hand it goes, as a share of the way from the cradle.
const FARTHEST: f64 = 3.0;

pub struct SoftBall {
    /// Controls that hold the cradle, and what they lack for the closed hand.
    cradle: Vec<f64>,
    way: Vec<f64>,
    closed: f64,
    controls: Vec<f64>,
}

impl SoftBall {
    /// The controller.
    ///
    /// # Errors
    /// The roles of the hand lack a pose.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let (roles, m) = (roles_of(env)?, &env.scene().model);
        let cast = roles.cast(m, "", "squeeze");
        let pose = |name: &str| -> Result<Vec<f64>, ControlError> {
            let mut qpos = m.qpos0.to_vec();
            cast.pose(name, &mut qpos).map_err(|error| ControlError::unfit(env, error.to_string()))?;
            Ok((0..m.nu).map(|actuator| qpos[Servo::new(m, actuator).place]).collect())
        };
        let (cradle, closed) = (pose("cradle")?, pose("closed")?);
        let way = closed.iter().zip(&cradle).map(|(closed, cradle)| closed - cradle).collect();
        Ok(SoftBall { controls: cradle.clone(), cradle, way, closed: 0.0 })
    }
}

impl Controller for SoftBall {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        self.closed = 0.0;
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let speed = (GAIN * env.rows()["width_error"][0]).clamp(-FASTEST, FASTEST);
        self.closed = (self.closed + speed * env.dt()).clamp(0.0, FARTHEST);
        for ((control, cradle), way) in self.controls.iter_mut().zip(&self.cradle).zip(&self.way) {
            *control = cradle + self.closed * way;
        }
        command(env, &self.controls, action)
    }
}
