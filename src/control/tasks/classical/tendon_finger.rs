//! A finger that muscles move: joints accelerate towards their wanted angles as springs with dampers, by torques that static optimisation
//! shares among the muscles.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::activations;
use env::Env;
use nalgebra::{DMatrix, DVector};
use physics::inertia::full_inertia;

/// Acceleration by angle \[1/s²\] and by speed \[1/s\]: slow beside the lag of the muscles.
const STIFFNESS: f64 = 60.0;
const DAMPING: f64 = 14.0;

pub struct TendonFinger;

impl TendonFinger {
    /// The controller.
    ///
    /// # Errors
    /// An observation without wanted angles.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        match env.rows().get("target_error") {
            Some(offsets) if offsets.len() == env.scene().model.nv => Ok(TendonFinger),
            _ => Err(ControlError::unfit(env, "an offset of each joint is needed")),
        }
    }
}

impl Controller for TendonFinger {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let (m, data) = (&env.scene().model, &env.scene().data);
        let offsets = env.rows()["target_error"].iter().zip(&data.state.qvel);
        let asked =
            DVector::from_iterator(m.nv, offsets.map(|(offset, speed)| STIFFNESS * offset - DAMPING * speed));
        let passive = data.passive.qfrc_passive.iter();
        let bias = DVector::from_iterator(m.nv, data.vel.qfrc_bias.iter().zip(passive).map(|(b, p)| b - p));
        let torques = DMatrix::from_row_slice(m.nv, m.nv, &full_inertia(m, &data.inertia.M)) * asked + bias;
        // Torque of a muscle at full activation: its arm times its strength.
        let mut strength = DMatrix::zeros(m.nv, m.nu);
        for muscle in 0..m.nu {
            let (start, count) =
                (data.trn.moment_rowadr[muscle] as usize, data.trn.moment_rownnz[muscle] as usize);
            for place in start..start + count {
                let joint = data.trn.moment_colind[place] as usize;
                strength[(joint, muscle)] = data.trn.actuator_moment[place] * m.actuator_gainprm[muscle][0];
            }
        }
        command(env, activations(&strength, &torques, &vec![[0.0, 1.0]; m.nu])?.as_slice(), action)
    }
}
