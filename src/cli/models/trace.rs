//! `trace`: recorded inputs in, named fields out.

use crate::failure::Failure;
use crate::input::source::ModelSource;
use clap::{Args, ValueHint};
use std::path::PathBuf;

use crate::input::loading::load;
use crate::interrupt::Interrupt;
use crate::models::fields::{Recorder, is_ragged};
use crate::output::{archive_file, check_place, keep_input};
use crate::terminal::note;
use dataset::{Array, NpzReader};
use physics::data::Warnings;
use physics::{Data, Model};
use std::collections::HashMap;

/// Step or forward recorded inputs and write the named fields
#[derive(Args)]
#[command(
    after_help = "IN holds any of qpos, qvel, act, ctrl, mocap_pos, mocap_quat, qfrc_applied, xfrc_applied, \
eq_active, qacc_warmstart, time, one row a step or state, or an array of the shape of the field itself as the only row; what it leaves out takes the value of a plain reset. \
What `sim --out` writes is such a file; its sensordata and energy are not read.

By default the rollout starts from row 0 and takes one row of ctrl a step; the fields are written after every step. \
With --forward every row is an independent state and the fields of its forward pass are written; fields whose \
length varies are concatenated in row order, and ncon and nefc tell the split. Contacts are contact.dist, \
contact.pos, ...

Examples:
  robohive sim assets/pile/pile.xml --out motion.npz
  robohive trace assets/pile/pile.xml --in motion.npz --out again.npz --fields qpos,sensordata
  robohive trace assets/pile/pile.xml --in motion.npz --out forces.npz --forward \\
    --fields qacc,efc_J,contact.dist"
)]
pub struct Trace {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Numpy archive with inputs
    #[arg(long = "in", value_name = "IN.npz", value_hint = ValueHint::FilePath)]
    pub input: PathBuf,
    /// Numpy archive to write
    #[arg(long, value_name = "OUT.npz", value_hint = ValueHint::FilePath, value_parser = archive_file)]
    pub out: PathBuf,
    /// Fields to write, separated by commas
    #[arg(long, value_delimiter = ',', default_value = "time,qpos,qvel,act")]
    pub fields: Vec<String>,
    /// Treat every row as an independent state
    #[arg(long)]
    pub forward: bool,
    /// Reset a state that is not finite or too large, as MuJoCo does, instead of ending there
    #[arg(long, conflicts_with = "forward")]
    pub autoreset: bool,
}

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
    check_place(&a.out)?;
    keep_input(&a.input, &a.out)?;
    let m = load(&a.model.path, &a.model.reading)?;
    let mut d = Data::new(&m);
    let inputs = read_inputs(a, &m, &d)?;
    d.autoreset = a.autoreset;
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
    if d.warnings != Warnings::default() {
        let (resets, controls) = (d.warnings.resets(), d.warnings.bad_ctrl.count);
        note(&format!(
            "bad values: the state was reset {resets} times, controls were set to zero {controls} times"
        ));
    }
    outcome
}

/// Rows of one input, each flat.
struct Input {
    name: String,
    rows: usize,
    values: Vec<f64>,
}

impl Input {
    /// An array of the shape of the field itself is one row; else its first axis counts rows.
    fn new(name: &str, array: &Array, field: &[usize]) -> Self {
        let rows = if array.shape == field { 1 } else { array.rows() };
        Input { name: name.to_owned(), rows, values: array.values.to_f64() }
    }

    fn row(&self, row: usize) -> Result<&[f64], Failure> {
        let width = self.values.len() / self.rows.max(1);
        self.values.get(row * width..(row + 1) * width).filter(|_| row < self.rows).ok_or_else(|| {
            Failure::usage(format!("input {:?} has {} rows, row {row} is needed", self.name, self.rows))
        })
    }

    /// Writes row `row` into `d`.
    fn assign(&self, d: &mut Data, row: usize) -> Result<(), Failure> {
        let values = self.row(row)?;
        match d.assign(&self.name, values) {
            Some(true) => Ok(()),
            _ => Err(Failure::usage(format!(
                "a row of input {:?} has {} values, which does not fit the model",
                self.name,
                values.len()
            ))),
        }
    }
}

/// The inputs that the archive holds; an unknown array is an error.
fn read_inputs(a: &Trace, m: &Model, d: &Data) -> Result<Vec<Input>, Failure> {
    let mut shapes = HashMap::new();
    d.visit(m, &mut |name, shape, _| _ = shapes.insert(name, shape));
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
        let array = archive.require(name).map_err(Failure::usage)?;
        inputs.push(Input::new(name, &array, shapes.get(name).map_or(&[], Vec::as_slice)));
    }
    Ok(inputs)
}

/// Number of rows to compute.
fn rows_of(inputs: &[Input], forward: bool) -> Result<usize, Failure> {
    if forward {
        return Ok(inputs.iter().map(|input| input.rows).max().unwrap_or(0));
    }
    match inputs.iter().find(|input| input.name == "ctrl").map_or(0, |input| input.rows) {
        0 => Err(Failure::usage(
            "a rollout needs an array \"ctrl\" with one row a step; --forward treats rows as states",
        )),
        steps => Ok(steps),
    }
}

/// Takes row `row` as a state and computes what follows from it.
fn forward(m: &Model, d: &mut Data, inputs: &[Input], row: usize) -> Result<(), Failure> {
    d.reset(m);
    inputs.iter().try_for_each(|input| input.assign(d, row))?;
    physics::forward(m, d).map_err(|e| Failure::new(format!("row {row}: {e}")))?;
    physics::derive_on_demand(m, d);
    Ok(())
}

/// Takes the controls of row `row`, of row 0 all inputs, and makes a step.
fn advance(m: &Model, d: &mut Data, inputs: &[Input], row: usize) -> Result<(), Failure> {
    for input in inputs.iter().filter(|input| row == 0 || input.name == "ctrl") {
        input.assign(d, row)?;
    }
    physics::step(m, d).map_err(|e| Failure::new(format!("step {row}: {e}")))
}
