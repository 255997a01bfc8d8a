//! Trajectories of many initial states on several threads, the interpreter's lock released.

use super::call::caught;
use super::data::Data;
use super::dynamics::advance;
use super::error::Fault;
use super::model::Model;
use super::saved::{gather, scatter};
use super::warned::is_reset;
use numpy::{PyArray1, PyReadonlyArray2, PyReadonlyArray3};
use physics::data::Warnings;
use physics::{Data as Simulation, Model as Compiled, step};
use pyo3::prelude::*;
use std::sync::Arc;

/// What is rolled out, all arrays with one row for each trajectory.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Plan<'py> {
    /// Steps of a trajectory.
    nstep: usize,
    /// Bits of initial and resulting states.
    state_spec: i64,
    /// Bits of the controls.
    control_spec: i64,
    initial_state: PyReadonlyArray2<'py, f64>,
    initial_warmstart: Option<PyReadonlyArray2<'py, f64>>,
    control: Option<PyReadonlyArray3<'py, f64>>,
}

/// The same as plain numbers, for threads.
struct Inputs {
    nstep: usize,
    specs: [i64; 2],
    states: Vec<Vec<f64>>,
    warmstarts: Option<Vec<Vec<f64>>>,
    /// By trajectory and step.
    controls: Option<Vec<Vec<Vec<f64>>>>,
}

impl Inputs {
    fn of(plan: &Plan<'_>) -> Self {
        let rows =
            |a: &PyReadonlyArray2<'_, f64>| a.as_array().rows().into_iter().map(|r| r.to_vec()).collect();
        let controls = plan.control.as_ref().map(|all| {
            let all = all.as_array();
            all.outer_iter().map(|one| one.rows().into_iter().map(|r| r.to_vec()).collect()).collect()
        });
        Inputs {
            nstep: plan.nstep,
            specs: [plan.state_spec, plan.control_spec],
            states: rows(&plan.initial_state),
            warmstarts: plan.initial_warmstart.as_ref().map(rows),
            controls,
        }
    }

    /// The state and the inputs at the start of trajectory `k`: inputs that the controls do not set are at rest.
    fn start(&self, k: usize, m: &Compiled, d: &mut Simulation) -> Result<(), Fault> {
        d.reset(m);
        d.warnings = Warnings::default();
        scatter(&mut d.state, self.specs[0], &self.states[k])?;
        if let Some(warmstarts) = &self.warmstarts {
            d.state.qacc_warmstart.copy_from_slice(&warmstarts[k]);
        }
        Ok(())
    }
}

/// A numpy array of numbers.
type Vector<'py> = Bound<'py, PyArray1<f64>>;

/// States and sensor readings of one trajectory.
type Trace = (Vec<f64>, Vec<f64>);

fn trajectory(inputs: &Inputs, k: usize, m: &Compiled, d: &mut Simulation) -> Result<Trace, Fault> {
    inputs.start(k, m, d)?;
    let (mut states, mut sensors) = (Vec::new(), Vec::new());
    for t in 0..inputs.nstep {
        if let Some(controls) = &inputs.controls {
            scatter(&mut d.state, inputs.specs[1], &controls[k][t])?;
        }
        let mut notices = Vec::new();
        advance(m, d, 1, step, &mut notices)?;
        // A reset ends the trajectory: what follows it repeats the state.
        let repeats = if notices.iter().any(|&notice| is_reset(notice)) { inputs.nstep - t } else { 1 };
        let state = gather(&d.state, inputs.specs[0])?;
        for _ in 0..repeats {
            states.extend_from_slice(&state);
            sensors.extend_from_slice(&d.sensor.sensordata);
        }
        if repeats > 1 {
            break;
        }
    }
    Ok((states, sensors))
}

/// Trajectories `first`, `first + stride` and so on.
fn share(
    inputs: &Inputs,
    (first, stride): (usize, usize),
    models: &[Arc<Compiled>],
    simulation: &mut Simulation,
) -> Result<Vec<(usize, Trace)>, Fault> {
    let mine = (first..models.len()).step_by(stride);
    mine.map(|k| caught(|| trajectory(inputs, k, &models[k], simulation)).map(|trace| (k, trace))).collect()
}

/// Rolls out every trajectory of `plan`, one thread for each of `datas`; states and sensor readings, trajectory after
/// trajectory and step after step.
#[pyfunction]
pub fn roll_out<'py>(
    py: Python<'py>,
    models: Vec<Bound<'py, Model>>,
    datas: Vec<Bound<'py, Data>>,
    plan: Plan<'py>,
) -> PyResult<(Vector<'py>, Vector<'py>)> {
    let inputs = Inputs::of(&plan);
    let compiled = models.iter().map(|m| m.get().current(py)).collect::<PyResult<Vec<_>>>()?;
    let mut held = datas.iter().map(|d| d.get().lock()).collect::<PyResult<Vec<_>>>()?;
    for one in &mut held {
        models.iter().try_for_each(|m| one.check_fits(m.get()))?;
        one.pull(py)?;
    }
    let mut inside: Vec<&mut Simulation> = held.iter_mut().map(|guard| &mut guard.simulation).collect();
    let results = py.detach(|| {
        let (inputs, models, stride) = (&inputs, &compiled[..], inside.len());
        std::thread::scope(|threads| {
            let started: Vec<_> = inside
                .iter_mut()
                .enumerate()
                .map(|(first, d)| threads.spawn(move || share(inputs, (first, stride), models, d)))
                .collect();
            started
                .into_iter()
                .map(|thread| thread.join().unwrap_or_else(|panic| Err(Fault::of_panic(&*panic))))
                .collect::<Vec<_>>()
        })
    });
    held.iter_mut().try_for_each(|one| one.push(py))?;
    let mut traces = Vec::new();
    for result in results {
        traces.extend(result?);
    }
    traces.sort_by_key(|(k, _)| *k);
    let (states, sensors): (Vec<_>, Vec<_>) = traces.into_iter().map(|(_, trace)| trace).unzip();
    Ok((PyArray1::from_vec(py, states.concat()), PyArray1::from_vec(py, sensors.concat())))
}
