//! Agents of an environment, as Python holds them.

use crate::actions;
use crate::exceptions::exception;
use env::Env;
use env::team::Team;
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

/// The agents in order: name, bounds of the action, rows of the observation (name, unit, length). `None` where there is but one.
pub fn describe<'py>(py: Python<'py>, env: &Env) -> PyResult<Option<Bound<'py, PyList>>> {
    let Some(team) = env.team() else { return Ok(None) };
    let each = team.agents().iter().map(|agent| {
        let dict = PyDict::new(py);
        let edge = |side: usize| {
            let bounds = agent.commands().iter().map(|&k| env.action_bounds(k)[side]);
            PyArray1::from_vec(py, bounds.collect())
        };
        let rows = agent.observes().filter_map(|(name, named)| {
            let row = env.rows().rows().iter().find(|row| row.name() == named)?;
            Some((name, row.unit(), row.len()))
        });
        dict.set_item("name", agent.name())?;
        dict.set_item("rows", rows.collect::<Vec<_>>())?;
        dict.set_item("action_low", edge(0))?;
        dict.set_item("action_high", edge(1))?;
        Ok(dict)
    });
    PyList::new(py, each.collect::<PyResult<Vec<_>>>()?).map(Some)
}

/// What each agent observes and earns in the present state.
pub fn seen<'py>(py: Python<'py>, env: &Env) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyDict>)> {
    let (observations, rewards) = (PyDict::new(py), PyDict::new(py));
    for agent in team(env)?.agents() {
        observations.set_item(agent.name(), PyArray1::from_vec(py, agent.observation(env.rows())))?;
        rewards.set_item(agent.name(), agent.reward(env.terms()))?;
    }
    Ok((observations, rewards))
}

/// The joint action.
pub fn join<'py>(
    py: Python<'py>,
    env: &Env,
    actions: &Bound<'_, PyDict>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let team = team(env)?;
    let mut given: Vec<(String, Vec<f64>)> = Vec::new();
    for (name, action) in actions.iter() {
        let name: String = name.extract()?;
        let agent = team.agent(&name).map_err(|error| exception(py, &error))?;
        let mut values = vec![0.0; agent.commands().len()];
        actions::read(&action, &mut values)
            .map_err(|error| PyValueError::new_err(format!("the agent {name}: {}", error.value(py))))?;
        given.push((name, values));
    }
    let given: Vec<(&str, &[f64])> = given.iter().map(|(name, values)| (&**name, &**values)).collect();
    let mut joint = vec![0.0; env.action_len()];
    team.join(&given, &mut joint).map_err(|error| exception(py, &error))?;
    Ok(PyArray1::from_vec(py, joint))
}

fn team(env: &Env) -> PyResult<&Team> {
    let one = || PyValueError::new_err(format!("{} is an environment for one agent", env.spec().id));
    env.team().ok_or_else(one)
}
