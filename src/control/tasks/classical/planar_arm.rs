//! A redundant arm: its tip is pulled to the target as by a spring with a damper, in operational space, while the joints bend as little
//! as that leaves them free to.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::operational_torques;
use env::Env;
use nalgebra::{DMatrix, DVector};
use physics::elements::SiteId;
use physics::inertia::full_inertia;
use physics::position::jacobian::Jacobian;

/// Acceleration of the tip by distance \[1/s²\] and by speed \[1/s\].
const STIFFNESS: f64 = 60.0;
const DAMPING: f64 = 15.0;
/// Distance beyond which the spring does not pull harder \[m\].
const FAR: f64 = 0.15;
/// Acceleration of joints by angle \[1/s²\] and by speed \[1/s\].
const STRAIGHTENING: f64 = 4.0;
const JOINT_DAMPING: f64 = 6.0;

pub struct PlanarArm {
    tip: SiteId,
    target: SiteId,
    jacobian: Jacobian,
}

impl PlanarArm {
    /// The controller.
    ///
    /// # Errors
    /// The model has no tip or target.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let (tip, target) = (scene.site("arm_tip")?, scene.site("arm_target")?);
        Ok(PlanarArm { tip, target, jacobian: Jacobian::default() })
    }
}

impl Controller for PlanarArm {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let (m, data) = (&env.scene().model, &env.scene().data);
        let (qpos, qvel) = (&data.state.qpos, &data.state.qvel);
        self.jacobian.set_to(m, data, self.tip);
        let jacobian = DMatrix::from_row_slice(2, m.nv, &self.jacobian.pos[..2 * m.nv]);
        let speed = &jacobian * DVector::from_column_slice(qvel);
        let (tip, target) = (data.site(self.tip).xpos(), data.site(self.target).xpos());
        let offset = DVector::from_vec(vec![target[0] - tip[0], target[1] - tip[1]]);
        let offset = &offset * (FAR / offset.norm().max(FAR));
        let asked = offset * STIFFNESS - speed * DAMPING;
        let wish = DVector::from_iterator(
            m.nv,
            qpos.iter().zip(qvel).map(|(angle, speed)| -STRAIGHTENING * angle - JOINT_DAMPING * speed),
        );
        let inertia = DMatrix::from_row_slice(m.nv, m.nv, &full_inertia(m, &data.inertia.M));
        let passive = data.passive.qfrc_passive.iter();
        let bias = DVector::from_iterator(m.nv, data.vel.qfrc_bias.iter().zip(passive).map(|(b, p)| b - p));
        let torques = operational_torques(&inertia, &jacobian, &asked, &wish, &bias)?;
        command(env, torques.as_slice(), action)
    }
}
