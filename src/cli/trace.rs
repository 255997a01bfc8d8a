//! `trace`: recorded inputs in, named fields out.

use crate::Failure;
use crate::arguments::Trace;
use crate::fields::{Recorder, is_ragged};
use crate::interrupt::Interrupt;
use crate::loading::load;
use dataset::{Array, NpzReader};
use physics::{Data, Model};

const INPUTS: [&str; 11] = [
    "time",
    "qpos",
    "qvel",
    "act",
    "ctrl",
    "mocap_pos",
    "mocap_quat",
    "qfrc_applied",
    "xfrc_applied",
    "eq_active",
    "qacc_warmstart",
];

/// What `sim --out` writes beside inputs.
const OUTPUTS: [&str; 2] = ["sensordata", "energy"];

/// Runs the command. Rows before a failure or a signal are kept.
pub fn run(a: &Trace) -> Result<(), Failure> {
    let m = load(&a.model.path, &a.model.reading)?;
    let inputs = read_inputs(a)?;
    let mut d = Data::new(&m);
    let mut names = a.fields.clone();
    for (prefix, count) in [("contact.", "ncon"), ("efc_", "nefc")] {
        if names.iter().any(|n| is_ragged(n) && n.starts_with(prefix)) && !names.iter().any(|n| n == count) {
            names.push(count.into());
        }
    }
    let rows = rows_of(&inputs, a.forward)?;
    let mut recorder = Recorder::create(&a.out, &m, &d, &names)?;
    let interrupt = Interrupt::listen().map_err(Failure::new)?;
    let mut outcome = Ok(());
    for row in 0..rows {
        outcome = match interrupt.code() {
            Some(code) => Err(Failure { code, ..Failure::new(format!("interrupted before row {row}")) }),
            None if a.forward => forward(&m, &mut d, &inputs, row),
            None => advance(&m, &mut d, &inputs, row),
        };
        if outcome.is_err() {
            break;
        }
        recorder.record(&m, &d)?;
    }
    recorder.finish()?;
    outcome
}

/// The inputs that the archive holds, each with its rows; an unknown array is an error.
fn read_inputs(a: &Trace) -> Result<Vec<(String, Array)>, Failure> {
    let archive = NpzReader::open(&a.input).map_err(Failure::usage)?;
    let mut inputs = Vec::new();
    for name in archive.names().filter(|name| !OUTPUTS.contains(name)) {
        if !INPUTS.contains(&name) {
            return Err(Failure::usage(format!(
                "{}: array {name:?} is no input; inputs are {}",
                a.input.display(),
                INPUTS.join(", ")
            )));
        }
        inputs.push((name.to_owned(), archive.require(name).map_err(Failure::usage)?));
    }
    Ok(inputs)
}

/// Row `row` of an input, flat.
fn row_of(name: &str, array: &Array, row: usize) -> Result<Vec<f64>, Failure> {
    let width = array.values.len() / array.rows().max(1);
    let values = array.values.to_f64();
    values.get(row * width..(row + 1) * width).map(<[f64]>::to_vec).ok_or_else(|| {
        Failure::usage(format!("input {name:?} has {} rows, row {row} is needed", array.rows()))
    })
}

fn assign(d: &mut Data, name: &str, values: &[f64]) -> Result<(), Failure> {
    match d.assign(name, values) {
        Some(true) => Ok(()),
        _ => Err(Failure::usage(format!(
            "a row of input {name:?} has {} values, which does not fit the model",
            values.len()
        ))),
    }
}

/// Number of rows to compute.
fn rows_of(inputs: &[(String, Array)], forward: bool) -> Result<usize, Failure> {
    if forward {
        return Ok(inputs.iter().map(|(_, array)| array.rows()).max().unwrap_or(0));
    }
    match inputs.iter().find(|(name, _)| name == "ctrl").map_or(0, |(_, array)| array.rows()) {
        0 => Err(Failure::usage(
            "a rollout needs an array \"ctrl\" with one row a step; --forward treats rows as states",
        )),
        steps => Ok(steps),
    }
}

/// Takes row `row` as a state and computes what follows from it.
fn forward(m: &Model, d: &mut Data, inputs: &[(String, Array)], row: usize) -> Result<(), Failure> {
    d.reset(m);
    for (name, array) in inputs {
        assign(d, name, &row_of(name, array, row)?)?;
    }
    physics::forward(m, d).map_err(|e| Failure::new(format!("row {row}: {e}")))?;
    physics::derive_on_demand(m, d);
    Ok(())
}

/// Takes the controls of row `row`, of row 0 all inputs, and makes a step.
fn advance(m: &Model, d: &mut Data, inputs: &[(String, Array)], row: usize) -> Result<(), Failure> {
    for (name, array) in inputs.iter().filter(|(name, _)| row == 0 || name == "ctrl") {
        assign(d, name, &row_of(name, array, row)?)?;
    }
    physics::step(m, d).map_err(|e| Failure::new(format!("step {row}: {e}")))
}
