//! How many values are MuJoCo's to the last bit: the compiled model, each stage with upstream injected, the whole
//! forward pass, and the steps of the rollout.

use crate::motion::compare_rollout;
use crate::reference::{Reference, ReferenceError};
use crate::stages::{each_output, output, written};
use physics::{Data, Model, derive_on_demand};
use std::collections::BTreeMap;
use std::fmt::Write;

/// What the solver and the sum of smooth forces write, after the stages.
const AFTER_STAGES: &[&str] =
    &["qfrc_smooth", "qacc_smooth", "efc_b", "efc_state", "efc_force", "qfrc_constraint", "qacc"];

/// Equal values of one field over all states.
struct Count {
    field: String,
    equal: usize,
    all: usize,
    /// The first other value: state, index, ours, MuJoCo's.
    first: Option<(usize, usize, f64, f64)>,
}

/// Counts of several fields in the order in which they are computed.
#[derive(Default)]
struct Counts(Vec<Count>);

impl Counts {
    fn add(&mut self, field: &str, row: usize, ours: &[f64], theirs: &[f64]) {
        let at = self.0.iter().position(|c| c.field == field).unwrap_or_else(|| {
            self.0.push(Count { field: field.to_owned(), equal: 0, all: 0, first: None });
            self.0.len() - 1
        });
        let count = &mut self.0[at];
        count.all += ours.len().max(theirs.len());
        for (index, (&a, &b)) in ours.iter().zip(theirs).enumerate() {
            if a == b || a.is_nan() && b.is_nan() {
                count.equal += 1;
            } else {
                count.first.get_or_insert((row, index, a, b));
            }
        }
    }

    fn total(&self) -> [usize; 2] {
        self.0.iter().fold([0; 2], |[equal, all], c| [equal + c.equal, all + c.all])
    }

    fn differing(&self) -> impl Iterator<Item = &Count> {
        self.0.iter().filter(|c| c.equal < c.all)
    }
}

/// Equal values of one model.
pub struct BitRow {
    model: String,
    parts: [Counts; 3],
    /// Steps of the rollout with equal positions, counted from its start, and all of them.
    rollout: [usize; 2],
}

/// Counts the values of `m` and its motion that are MuJoCo's to the last bit.
///
/// # Errors
/// The reference lacks an array.
pub fn count_bits(name: &str, m: &Model, reference: &Reference) -> Result<BitRow, ReferenceError> {
    let mut stages = Counts::default();
    each_output(reference, |_, _, row, output| {
        stages.add(output.field, row, &output.ours, &output.theirs);
        Ok(())
    })?;
    let report = compare_rollout(m, reference)?;
    let equal = report.by_step.iter().take_while(|difference| **difference == 0.0).count();
    Ok(BitRow {
        model: name.to_owned(),
        parts: [compiled(m, reference)?, stages, whole_pass(m, reference)?],
        rollout: [equal, report.steps],
    })
}

fn compiled(m: &Model, reference: &Reference) -> Result<Counts, ReferenceError> {
    let mut ours = Vec::new();
    m.visit(&mut |name, _, values| ours.push((format!("model.{name}"), values.to_f64())));
    m.opt.visit(&mut |name, values| ours.push((format!("opt.{name}"), values.to_f64())));
    m.stat.visit(&mut |name, values| ours.push((format!("stat.{name}"), values.to_f64())));
    let mut counts = Counts::default();
    for (name, values) in ours {
        counts.add(&name, 0, &values, &reference.archive().require(&name)?.values.to_f64());
    }
    Ok(counts)
}

fn whole_pass(m: &Model, reference: &Reference) -> Result<Counts, ReferenceError> {
    let mut counts = Counts::default();
    let mut d = Data::new(m);
    for row in 0..reference.states()? {
        reference.set_state(&mut d, m, row)?;
        let failed = physics::forward(m, &mut d).is_err();
        derive_on_demand(m, &mut d);
        for field in written(m).chain(AFTER_STAGES.iter().copied()) {
            let output = output(m, &d, reference, field, row)?;
            counts.add(field, row, if failed { &[] } else { &output.ours }, &output.theirs);
        }
    }
    Ok(counts)
}

impl BitRow {
    /// A line for each field with another value, and the first of them.
    pub fn differences(&self) -> String {
        let mut text = String::new();
        for (part, counts) in ["compiled", "stage", "whole pass"].iter().zip(&self.parts) {
            for c in counts.differing() {
                let _ = write!(text, "  {part} {} {}/{}", c.field, c.equal, c.all);
                if let Some((row, index, ours, theirs)) = c.first {
                    let _ = write!(text, ": state {row} [{index}] {ours:?} (MuJoCo {theirs:?})");
                }
                text.push('\n');
            }
        }
        text
    }

    /// The row as a table line.
    pub fn line(&self) -> String {
        let [compiled, stages, pass] = self.parts.each_ref().map(|p| share(p.total()));
        let rollout = share(self.rollout);
        let first = self.parts.iter().flat_map(Counts::differing).next().map_or("", |c| c.field.as_str());
        format!("| {} | {compiled} | {stages} | {pass} | {rollout} | {first} |", self.model)
    }
}

/// "all" or a fraction.
fn share([equal, all]: [usize; 2]) -> String {
    if equal == all { "all".to_owned() } else { format!("{equal}/{all}") }
}

/// Totals and a table of all rows.
pub fn render(rows: &[BitRow]) -> String {
    format!("{}\n{}", summary(rows.iter()), table(rows.iter()))
}

/// Totals, those of each source, and a table of the models that are not equal throughout. The first folder of a model's path
/// is its source; `unread` are the models that could not be compared, with the reason.
pub fn render_sources(rows: &[BitRow], unread: &[(String, String)]) -> String {
    let mut text = summary(rows.iter());
    text.push_str(
        "\n| source | models | compiled | stages | whole passes | rollout |\n|---|---|---|---|---|---|\n",
    );
    let mut sources = BTreeMap::<&str, Vec<&BitRow>>::new();
    for row in rows {
        sources.entry(row.model.split('/').next().unwrap_or_default()).or_default().push(row);
    }
    for (source, rows) in sources {
        let [compiled, stages, passes, rollouts] = equal(rows.iter().copied());
        let name = source.replace('+', "/");
        let _ = writeln!(text, "| {name} | {} | {compiled} | {stages} | {passes} | {rollouts} |", rows.len());
    }
    text.push_str("\nModels with another value:\n\n");
    text.push_str(&table(rows.iter().filter(|row| equal(std::iter::once(*row)) != [1; 4])));
    for (model, why) in unread {
        let _ = writeln!(text, "| {model} | {} | | | | |", why.lines().next().unwrap_or_default());
    }
    text
}

/// How many models are equal throughout: compiled values, stages, whole passes, steps of the rollout.
fn equal<'a>(rows: impl Iterator<Item = &'a BitRow>) -> [usize; 4] {
    rows.fold([0; 4], |mut sums, row| {
        for (sum, part) in sums.iter_mut().zip(&row.parts) {
            *sum += usize::from(part.differing().next().is_none());
        }
        sums[3] += usize::from(row.rollout[0] == row.rollout[1]);
        sums
    })
}

fn summary<'a>(rows: impl Iterator<Item = &'a BitRow> + Clone) -> String {
    let [compiled, stages, passes, rollouts] = equal(rows.clone());
    format!(
        "Equal to the last bit, of {} models: compiled {compiled}, all stages {stages}, all whole passes {passes}, whole rollout {rollouts}.\n",
        rows.count()
    )
}

fn table<'a>(rows: impl Iterator<Item = &'a BitRow>) -> String {
    let mut text = String::from(
        "| model | compiled values | stages | whole passes | steps of the rollout | first other field |\n|---|---|---|---|---|---|\n",
    );
    rows.for_each(|row| text.push_str(&(row.line() + "\n")));
    text
}
