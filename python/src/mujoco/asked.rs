//! Stages in parts, between which callbacks of Python's are asked: gains, biases and dynamics of actuators of type `user`,
//! and which geoms may touch.

use super::call::change;
use super::data::Data;
use super::error::Fault;
use super::model::Model;
use physics::actuation::user::{Given, asked};
use physics::actuation::{forces, rates};
use physics::collision::filter::Decided;
use physics::collision::{World, collide_filtered};
use physics::model::ActuatorInputs;
use physics::pipeline::forward::position_of_pairs;
use pyo3::prelude::*;
use std::collections::HashMap;

/// Numbers of actuators whose dynamics, gain and bias are to be asked for.
type Actuators = (Vec<usize>, Vec<usize>, Vec<usize>);

macro_rules! inputs {
    ($m:expr, $d:expr) => {
        ActuatorInputs { m: $m, state: &$d.state, trn: &$d.trn, vel: &$d.vel }
    };
}

/// The first half of actuation: rates of activation; tells which actuators of type `user` are to be asked for.
#[pyfunction]
pub fn actuator_rates(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>) -> PyResult<Actuators> {
    change(py, m, d, |m, d| {
        rates(&inputs!(m, d), &mut d.actuation);
        let asked = asked(m, &d.state);
        Ok((asked.dynamics, asked.gain, asked.bias))
    })
}

/// The second half of actuation: forces, with gains and biases for actuators of type `user`.
#[pyfunction]
pub fn actuator_forces(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    gain: Vec<f64>,
    bias: Vec<f64>,
) -> PyResult<()> {
    change(py, m, d, |m, d| {
        if [gain.len(), bias.len()] != [m.nactuator; 2] {
            return Err(Fault::Value("gains and biases of all actuators are needed".to_owned()));
        }
        forces(&inputs!(m, d), &Given { gain, bias }, &d.passive, &mut d.actuation);
        Ok(())
    })
}

/// Runs the stage `collision`, or all that depends on positions, with contacts of the pairs of geoms that are known to be
/// wanted; returns the pairs about which nothing is known, in the order in which they were met.
#[pyfunction]
pub fn collide_known(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    alone: bool,
    known: HashMap<(usize, usize), bool>,
) -> PyResult<Vec<(usize, usize)>> {
    change(py, m, d, |m, d| {
        let mut unknown = Vec::new();
        let mut filter = Decided(|g1, g2| {
            known.get(&(g1, g2)).copied().unwrap_or_else(|| {
                unknown.push((g1, g2));
                false
            })
        });
        if alone {
            let world = World { m, kin: &d.kin, flexes: &d.flex };
            collide_filtered(world, &d.state, &mut filter, d.budget, &mut d.scratch.collision, &mut d.con)
                .map_err(physics::StepError::from)?;
        } else {
            position_of_pairs(m, d, &mut filter, &mut ())?;
        }
        Ok(unknown)
    })
}
