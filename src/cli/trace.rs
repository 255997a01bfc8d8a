//! `trace`: recorded inputs in, named fields out.

use crate::arguments::Trace;
use crate::fields::{Recorder, is_ragged};
use crate::{Failure, load, unwritable};
use dataset::{Array, NpzReader, NpzWriter};
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

/// Runs the command.
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
    let mut recorder = Recorder::new(&m, &d, &names)?;
    if a.forward {
        forward_rows(&m, &mut d, &inputs, &mut recorder)?;
    } else {
        rollout(&m, &mut d, &inputs, &mut recorder)?;
    }
    let mut writer = NpzWriter::create(&a.out).map_err(unwritable(&a.out))?;
    for (name, array) in recorder.finish() {
        writer.add(&name, &array).map_err(unwritable(&a.out))?;
    }
    writer.finish().map_err(unwritable(&a.out))
}

/// The inputs that the archive holds, each with its rows; an unknown array is an error.
fn read_inputs(a: &Trace) -> Result<Vec<(String, Array)>, Failure> {
    let archive = NpzReader::open(&a.input).map_err(Failure::usage)?;
    let mut inputs = Vec::new();
    for name in archive.names() {
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

fn forward_rows(
    m: &Model,
    d: &mut Data,
    inputs: &[(String, Array)],
    recorder: &mut Recorder,
) -> Result<(), Failure> {
    let rows = inputs.iter().map(|(_, array)| array.rows()).max().unwrap_or(0);
    for row in 0..rows {
        d.reset(m);
        for (name, array) in inputs {
            assign(d, name, &row_of(name, array, row)?)?;
        }
        physics::forward(m, d).map_err(|e| Failure::new(format!("row {row}: {e}")))?;
        physics::derive_on_demand(m, d);
        recorder.record(m, d);
    }
    Ok(())
}

fn rollout(
    m: &Model,
    d: &mut Data,
    inputs: &[(String, Array)],
    recorder: &mut Recorder,
) -> Result<(), Failure> {
    let steps = inputs.iter().find(|(name, _)| name == "ctrl").map_or(0, |(_, array)| array.rows());
    if steps == 0 {
        return Err(Failure::usage(
            "a rollout needs an array \"ctrl\" with one row a step; --forward treats rows as states",
        ));
    }
    for (name, array) in inputs {
        assign(d, name, &row_of(name, array, 0)?)?;
    }
    for step in 0..steps {
        for (name, array) in inputs.iter().filter(|(name, _)| name == "ctrl") {
            assign(d, name, &row_of(name, array, step)?)?;
        }
        physics::step(m, d).map_err(|e| Failure::new(format!("step {step}: {e}")))?;
        recorder.record(m, d);
    }
    Ok(())
}
