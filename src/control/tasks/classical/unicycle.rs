//! A unicycle on two wheels by polar steering.

use super::ground::pose;
use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::PolarSteering;
use env::Env;
use physics::elements::BodyId;

/// The law. Speeds are then scaled to what the wheels can do.
const LAW: PolarSteering = PolarSteering { speed: 0.8, bearing: 2.5, heading: 2.0 };
/// Radius of a wheel, and half the distance between them \[m\].
const RADIUS: f64 = 0.05;
const HALF_TRACK: f64 = 0.1;
/// Fastest wheel \[rad/s\].
const FASTEST: f64 = 10.0;

pub struct Unicycle {
    body: BodyId,
}

impl Unicycle {
    /// The controller.
    ///
    /// # Errors
    /// The model has no unicycle.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        Ok(Unicycle { body: env.scene().body("unicycle")? })
    }
}

impl Controller for Unicycle {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let [speed, turning] = LAW.command(pose(env, self.body));
        let wheels = [-1.0, 1.0].map(|side| (speed + side * HALF_TRACK * turning) / RADIUS);
        // Both wheels slow down together, so that the path stays.
        let scale = (FASTEST / wheels[0].abs().max(wheels[1].abs())).min(1.0);
        command(env, &wheels.map(|wheel| scale * wheel), action)
    }
}
