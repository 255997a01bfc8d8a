//! One row of the status table: how far a model follows MuJoCo, and what limits it.

use crate::compile::{CompileReport, compare_compiled};
use crate::motion::{EARLY, ForwardReport, RolloutReport, compare_forward, compare_rollout};
use crate::reference::Reference;
use crate::stages::{StageReport, compare_stages};
use std::fmt::Write;
use std::path::Path;

/// What stands for the template text in the recorded references.
pub const TEMPLATE: (&str, &str) = ("OBJECT_NAME", "airplane");

/// Steps that a model must run without a bad value.
pub const LONG_RUN: usize = 2000;

/// Outcome of one model.
pub struct Row {
    /// Path in the list.
    pub model: String,
    /// Why it could not be measured at all.
    pub failure: Option<String>,
    compile: Option<CompileReport>,
    stages: Option<StageReport>,
    forward: Option<ForwardReport>,
    rollout: Option<RolloutReport>,
    long_run: Option<Result<(), String>>,
    reference_bad: bool,
}

impl Row {
    /// Every compiled array agrees.
    pub fn compiles(&self) -> bool {
        self.compile.as_ref().is_some_and(CompileReport::agrees)
    }

    /// Every stage agrees with upstream injected.
    pub fn stages_agree(&self) -> bool {
        self.stages.as_ref().is_some_and(|s| s.outside().is_empty())
    }

    /// Forward passes agree.
    pub fn forwards(&self) -> bool {
        self.forward.as_ref().is_some_and(ForwardReport::agrees)
    }

    /// The rollout stays within the bound.
    pub fn follows(&self) -> bool {
        self.rollout.as_ref().is_some_and(RolloutReport::follows)
    }

    /// The long run has no bad value, or MuJoCo's recorded run has one too.
    pub fn runs(&self) -> bool {
        self.long_run.as_ref().is_some_and(|r| r.is_ok() || self.reference_bad)
    }

    /// Any column disagrees.
    pub fn falls_short(&self) -> bool {
        !(self.compiles() && self.stages_agree() && self.forwards() && self.follows() && self.runs())
    }

    /// What limits the model: the first thing that disagrees.
    pub fn limit(&self) -> String {
        if let Some(failure) = &self.failure {
            return failure.lines().next().unwrap_or("").to_owned();
        }
        if let Some(worst) = self.compile.as_ref().and_then(|c| c.differences.first()) {
            return format!("compile: {worst}");
        }
        if let Some((state, worst)) = self.stages.as_ref().and_then(|s| s.outside().first().copied()) {
            return format!("stage: {worst}, state {state}, error {:.0e}", worst.error);
        }
        if let Some(failure) = self.forward.as_ref().and_then(|f| f.failure.as_ref()) {
            return failure.clone();
        }
        match (&self.forward, &self.rollout) {
            (Some(ForwardReport { worst: Some((state, worst)), .. }), _) if !self.forwards() => {
                format!("forward: {worst}, state {state}, error {:.0e}", worst.error)
            }
            (_, Some(RolloutReport { failure: Some((step, text)), .. })) => format!("step {step}: {text}"),
            (_, Some(RolloutReport { first_outside: Some(step), .. })) => {
                format!("rollout leaves the bound at step {step}")
            }
            _ => match &self.long_run {
                Some(Err(text)) if !self.reference_bad => text.clone(),
                _ => String::new(),
            },
        }
    }

    /// The row as a table line.
    pub fn line(&self) -> String {
        let tick = |good: bool| if good { "yes" } else { "no" };
        let forward = self.forward.as_ref().map_or(String::new(), |f| {
            format!(
                "{} ({}/{}, touching {}/{})",
                tick(self.forwards()),
                f.agreeing,
                f.states,
                f.touching_agreeing,
                f.touching
            )
        });
        let rollout = self.rollout.as_ref().map_or(String::new(), |r| {
            let follows = tick(self.follows());
            format!("{follows} ({:.0e}, step {EARLY} {:.0e}, twin {:.0e})", r.divergence, r.early, r.twin)
        });
        format!(
            "| {} | {} | {} | {forward} | {rollout} | {} | {} |",
            self.model,
            tick(self.compiles()),
            tick(self.stages_agree()),
            tick(self.runs()),
            self.limit().replace('|', "/")
        )
    }
}

/// Loads, compares and runs one model.
pub fn measure(name: &str, model: &Path, reference: &Path) -> Row {
    let mut row = Row {
        model: name.to_owned(),
        failure: None,
        compile: None,
        stages: None,
        forward: None,
        rollout: None,
        long_run: None,
        reference_bad: false,
    };
    if let Err(failure) = fill(&mut row, model, reference) {
        row.failure = Some(failure);
    }
    row
}

/// Loads a model of the list and its reference.
///
/// # Errors
/// The model does not load, or the reference is missing or no archive.
pub fn open(model: &Path, reference: &Path) -> Result<(physics::Model, Reference), String> {
    let loaded =
        mjcf::Loader::default().substitute(TEMPLATE.0, TEMPLATE.1).load(model).map_err(|e| e.to_string())?;
    Ok((loaded.model, Reference::open(reference).map_err(|e| e.to_string())?))
}

fn fill(row: &mut Row, model: &Path, reference: &Path) -> Result<(), String> {
    let (m, reference) = open(model, reference)?;
    row.compile = Some(compare_compiled(&m, &reference).map_err(|e| e.to_string())?);
    row.stages = Some(compare_stages(&reference).map_err(|e| e.to_string())?);
    row.forward = Some(compare_forward(&m, &reference).map_err(|e| e.to_string())?);
    row.rollout = Some(compare_rollout(&m, &reference).map_err(|e| e.to_string())?);
    row.reference_bad =
        reference.archive().require("rollout.bad").map_err(|e| e.to_string())?.values.to_f64()[0] > 0.0;
    row.long_run = Some(long_run(&m, &reference).map_err(|e| e.to_string())?);
    Ok(())
}

/// Runs under the recorded controls, repeated, and reports a bad value.
fn long_run(
    m: &physics::Model,
    reference: &Reference,
) -> Result<Result<(), String>, crate::reference::ReferenceError> {
    let ctrl = reference.archive().require("rollout.ctrl")?;
    let (rows, values) = (ctrl.rows(), ctrl.values.to_f64());
    let mut d = physics::Data::new(m);
    if m.nkey > 0 {
        d.reset_to_key(m, 0).map_err(|_| crate::reference::ReferenceError::Shape("key_qpos".into()))?;
    }
    for step in 0..LONG_RUN {
        let row = step % rows;
        d.state.ctrl.copy_from_slice(&values[row * m.nu..(row + 1) * m.nu]);
        if let Err(error) = physics::step(m, &mut d) {
            return Ok(Err(format!("step {step}: {error}")));
        }
    }
    Ok(Ok(()))
}

/// The totals of all rows and a table of those that are `shown`.
pub fn render(rows: &[Row], shown: impl Fn(&Row) -> bool) -> String {
    let count = |what: fn(&Row) -> bool| rows.iter().filter(|r| what(r)).count();
    let mut text = String::new();
    let _ = writeln!(
        text,
        "Of {} models: loaded {}, compiled alike {}, all stages alike {}, forward alike {}, rollout follows {}, {} steps without a bad value {}.\n",
        rows.len(),
        count(|r| r.failure.is_none()),
        count(Row::compiles),
        count(Row::stages_agree),
        count(Row::forwards),
        count(Row::follows),
        LONG_RUN,
        count(Row::runs)
    );
    text.push_str("| model | compile | stages | forward (states) | rollout (divergence) | runs | what limits it |\n|---|---|---|---|---|---|---|\n");
    for row in rows.iter().filter(|row| shown(row)) {
        let _ = writeln!(text, "{}", row.line());
    }
    text
}
