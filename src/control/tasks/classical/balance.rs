//! Balancing by the linear-quadratic regulator of the model's slopes in the pose that is to be kept.

use crate::controller::{Controller, command};
use crate::error::ControlError;
use crate::maths::{Regulator, discrete, linearise};
use env::Env;
use nalgebra::{DMatrix, DVector};
use physics::model::JointType;
use std::f64::consts::{PI, TAU};

/// A pose to be kept, and what it costs to be elsewhere. Models have hinges and slides alone.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Positions of the joints.
    pub goal: &'static [f64],
    /// Weights of positions, then velocities.
    pub weights: &'static [f64],
    /// Weight of every control.
    pub effort: f64,
}

/// Weights of a double pole: the cart's place matters less than the poles.
pub const DOUBLE_POLE: Settings =
    Settings { goal: &[0.0; 3], weights: &[1.0, 10.0, 10.0, 0.1, 1.0, 1.0], effort: 0.01 };

/// A regulator around a pose.
pub struct Balance {
    settings: Settings,
    /// Whether a joint turns without end, so that its error is the shorter way round.
    turns: Vec<bool>,
    pub regulator: Regulator,
    controls: Vec<f64>,
}

impl Balance {
    /// The regulator for an environment, over one step of it.
    ///
    /// # Errors
    /// A model of another size; a pose that no feedback keeps.
    pub fn new(env: &Env, settings: Settings) -> Result<Self, ControlError> {
        let m = &env.scene().model;
        if m.nq != settings.goal.len() || m.nv != m.nq || m.na > 0 {
            let message = format!(
                "the model has {} joints, hinges and slides, and no activations",
                settings.goal.len()
            );
            return Err(ControlError::unfit(env, message));
        }
        let mut data = env.scene().data.clone();
        data.state.qpos.copy_from_slice(settings.goal);
        data.state.qvel.fill(0.0);
        data.state.ctrl.fill(0.0);
        physics::forward(m, &mut data)?;
        let [a, b] = linearise(m, &mut data, env.frame_skip())?;
        let weights = DMatrix::from_diagonal(&DVector::from_column_slice(settings.weights));
        let effort = DMatrix::identity(m.nu, m.nu) * settings.effort;
        Ok(Balance {
            settings,
            turns: (0..m.njnt)
                .map(|k| m.jnt_type[k] == JointType::Hinge as i32 && !m.jnt_limited[k])
                .collect(),
            regulator: discrete(&a, &b, &weights, &effort)?,
            controls: vec![0.0; m.nu],
        })
    }

    /// How far the state is from the pose: positions, then velocities.
    pub fn error(&self, env: &Env) -> Vec<f64> {
        let state = &env.scene().data.state;
        let places = state.qpos.iter().zip(self.settings.goal).zip(&self.turns);
        let away = places.map(|((place, goal), turns)| {
            let away = place - goal;
            if *turns { (away + PI).rem_euclid(TAU) - PI } else { away }
        });
        away.chain(state.qvel.iter().copied()).collect()
    }

    /// The controls for a state that is `error` away, within no bounds.
    pub fn controls(&mut self, error: &[f64]) -> &[f64] {
        self.controls.fill(0.0);
        self.regulator.feed_back(error, &mut self.controls);
        &self.controls
    }
}

impl Controller for Balance {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let error = self.error(env);
        command(env, self.controls(&error), action)
    }
}
