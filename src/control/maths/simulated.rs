//! Models as what methods of control know: discrete dynamics, and their slopes around a state.

use super::{Dynamics, NoSolution};
use nalgebra::DMatrix;
use physics::integration::integrate::{differentiate_pos, integrate_pos};
use physics::pipeline::transition::transition;
use physics::{Data, Model, StepError, step};

/// Size of the differences that slopes are made of.
const NUDGE: f64 = 1e-6;

fn refused(error: &StepError) -> NoSolution {
    NoSolution::new("simulation", error.to_string())
}

/// The slopes of `steps` time steps from the state and controls of `data`: states (positions as velocities move them, then
/// velocities, then activations) from states, and from controls that are held. The state of `data` is kept.
///
/// # Errors
/// An integrator without finite differences, or a state that physics refuses.
pub fn linearise(m: &Model, data: &mut Data, steps: usize) -> Result<[DMatrix<f64>; 2], NoSolution> {
    let slopes = transition(m, data, NUDGE, true).map_err(|error| refused(&error))?;
    let n = 2 * m.nv + m.na;
    let (a, b) = (DMatrix::from_row_slice(n, n, &slopes.a), DMatrix::from_row_slice(n, m.nu, &slopes.b));
    let (mut state, mut control) = (DMatrix::identity(n, n), DMatrix::zeros(n, m.nu));
    for _ in 0..steps {
        control = &a * control + &b;
        state = &a * state;
    }
    Ok([state, control])
}

/// A model whose states are vectors: positions, as coordinates around a reference, then velocities.
pub struct Simulated<'a> {
    model: &'a Model,
    data: Data,
    /// Positions around which states count.
    reference: Vec<f64>,
    steps: usize,
}

impl<'a> Simulated<'a> {
    /// The dynamics of `steps` time steps with held controls, from the state of `data` but for positions and velocities, which are
    /// the state vector: positions relative to `reference`.
    ///
    /// # Errors
    /// A model with activations, which are not part of the states here.
    pub fn new(model: &'a Model, data: &Data, reference: &[f64], steps: usize) -> Result<Self, NoSolution> {
        if model.na > 0 {
            return Err(NoSolution::new(
                "simulation",
                "the state of a model with activations is not a state here",
            ));
        }
        Ok(Simulated { model, data: data.clone(), reference: reference.to_vec(), steps })
    }

    /// The state vector of positions and velocities.
    pub fn state(&self, qpos: &[f64], qvel: &[f64]) -> Vec<f64> {
        let mut state = vec![0.0; self.states()];
        let (places, speeds) = state.split_at_mut(self.model.nv);
        differentiate_pos(self.model, &self.reference, qpos, 1.0, places);
        speeds.copy_from_slice(qvel);
        state
    }
}

impl Dynamics for Simulated<'_> {
    fn states(&self) -> usize {
        2 * self.model.nv
    }

    fn controls(&self) -> usize {
        self.model.nu
    }

    fn step(&mut self, x: &[f64], u: &[f64], next: &mut [f64]) -> Result<(), NoSolution> {
        let (m, nv) = (self.model, self.model.nv);
        let state = &mut self.data.state;
        state.qpos.copy_from_slice(&self.reference);
        integrate_pos(m, &mut state.qpos, &x[..nv], 1.0);
        state.qvel.copy_from_slice(&x[nv..]);
        state.ctrl.copy_from_slice(u);
        // The same start of the solver for the same state, whatever was computed before.
        state.qacc_warmstart.fill(0.0);
        for _ in 0..self.steps {
            step(m, &mut self.data).map_err(|error| refused(&error))?;
        }
        let (places, speeds) = next.split_at_mut(nv);
        differentiate_pos(m, &self.reference, &self.data.state.qpos, 1.0, places);
        speeds.copy_from_slice(&self.data.state.qvel);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maths::discrete;

    const PENDULUM: &str = "<mujoco><option timestep='0.002'/><worldbody><body>
        <joint name='hinge' axis='0 1 0' damping='0.1'/><geom type='sphere' size='.05' pos='0 0 1' mass='1'/></body></worldbody>
        <actuator><motor joint='hinge' ctrlrange='-20 20'/></actuator></mujoco>";

    /// A pendulum that stands: the slope of the acceleration with the angle is m g l / I.
    #[test]
    fn slopes_are_those_of_the_model_and_steady_it() {
        let model = mjcf::load_str(PENDULUM).unwrap().model;
        let mut data = Data::new(&model);
        let [a, b] = linearise(&model, &mut data, 1).unwrap();
        let inertia = 1.0 + 0.4 * 0.05 * 0.05;
        // The Euler step treats damping implicitly.
        let share = 1.0 / (1.0 + 0.002 * 0.1 / inertia);
        assert!((a[(1, 0)] - share * 0.002 * 9.81 / inertia).abs() < 1e-7, "{a}");
        assert!((b[(1, 0)] - share * 0.002 / inertia).abs() < 1e-9, "{b}");
        let [a, b] = linearise(&model, &mut data, 5).unwrap();
        let regulator = discrete(&a, &b, &DMatrix::identity(2, 2), &DMatrix::identity(1, 1)).unwrap();
        data.state.qpos[0] = 0.3;
        for _ in 0..400 {
            let error = [data.state.qpos[0], data.state.qvel[0]];
            data.state.ctrl[0] = 0.0;
            regulator.feed_back(&error, &mut data.state.ctrl);
            (0..5).for_each(|_| step(&model, &mut data).unwrap());
        }
        assert!(data.state.qpos[0].abs() < 1e-3, "{}", data.state.qpos[0]);
    }

    #[test]
    fn the_integrator_without_differences_is_refused() {
        let text = PENDULUM.replace("<option", "<option integrator='RK4'");
        let model = mjcf::load_str(&text).unwrap().model;
        let error = linearise(&model, &mut Data::new(&model), 1).unwrap_err().to_string();
        assert!(error.contains("RK4"), "{error}");
    }
}
