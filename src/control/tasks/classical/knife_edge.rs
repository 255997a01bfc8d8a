//! A knife edge: it turns towards the point, or away from it where that is nearer, and moves along the edge as fast as the part of the
//! offset that lies along it asks for.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use env::Env;
use physics::elements::BodyId;
use physics::math::ops;

/// Speed by offset \[1/s\], and the fastest \[m/s\].
const SPEED: f64 = 0.6;
const FASTEST: f64 = 0.5;
/// Acceleration by what speed lacks \[1/s\].
const PUSH: f64 = 4.0;
/// Angular acceleration by angle \[1/s²\] and by turning \[1/s\].
const STIFFNESS: f64 = 6.0;
const DAMPING: f64 = 5.0;
/// Distance at which turning no longer brings it nearer \[m\].
const NEAR: f64 = 0.04;

pub struct KnifeEdge {
    mass: f64,
    inertia: f64,
}

impl KnifeEdge {
    /// The controller, with the mass of the puck and its inertia about the vertical.
    ///
    /// # Errors
    /// The model has no puck.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        let puck: BodyId = env.scene().body("knife_edge")?;
        let inertia = m.body_inertia[puck.index()];
        Ok(KnifeEdge {
            mass: m.body_subtreemass[puck.index()],
            inertia: inertia.iter().copied().fold(0.0, f64::max),
        })
    }
}

impl Controller for KnifeEdge {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let (offset, motion) = (&env.rows()["target_error"], &env.rows()["motion"]);
        let distance = offset[0].hypot(offset[1]);
        // Backwards where the point is behind: the angle is the smaller one of both ends.
        let angle = if distance < NEAR { 0.0 } else { (offset[1] / offset[0]).atan() };
        let wanted = (SPEED * offset[0] * ops::cos(angle)).clamp(-FASTEST, FASTEST);
        let push = self.mass * PUSH * (wanted - motion[0]);
        let turn = self.inertia * (STIFFNESS * angle - DAMPING * motion[1]);
        command(env, &[push, turn], action)
    }
}
