//! Every stage alone: MuJoCo's upstream arrays go in, our stage runs, its outputs are compared.

use crate::compare::{Worst, compare, compare_scaled, exact, relative};
use crate::reference::{Reference, ReferenceError};
use crate::stage_list::STAGES;
use crate::tolerance::STAGE_BAR;
use physics::model::Enable;
use physics::{Data, Model, forward};

/// The fields of a model that each stage writes, in the order of the stages.
pub fn written(m: &Model) -> impl Iterator<Item = &'static str> {
    STAGES.iter().flat_map(|stage| present(m, stage.writes))
}

/// Data of recorded state `row` as the solver finds it: rows and islands made from recorded inputs, and the recorded
/// unconstrained acceleration.
///
/// # Errors
/// The reference lacks an array.
pub fn before_solver(reference: &Reference, m: &Model, row: usize) -> Result<Data, ReferenceError> {
    let mut d = Data::new(m);
    reference.set_state(&mut d, m, row)?;
    for stage in STAGES.iter().filter(|stage| stage.name == "rows") {
        reference.inject(&mut d, &present(m, stage.reads), row)?;
        (stage.run)(m, &mut d);
    }
    reference.inject(&mut d, &["qfrc_smooth", "qacc_smooth"], row)?;
    Ok(d)
}

/// The worst component of each stage output over all recorded states.
pub struct StageReport {
    /// Stage, state and worst component of every output.
    pub outputs: Vec<(&'static str, usize, Worst)>,
}

impl StageReport {
    /// Outputs outside the tolerance, as state and component, worst first.
    pub fn outside(&self) -> Vec<(usize, &Worst)> {
        let mut list: Vec<_> = self
            .outputs
            .iter()
            .filter(|(_, _, w)| w.error > STAGE_BAR)
            .map(|(_, state, w)| (*state, w))
            .collect();
        list.sort_by(|a, b| b.1.error.total_cmp(&a.1.error));
        list
    }
}

/// Runs every stage on every recorded state, with the recorded model.
///
/// # Errors
/// The reference lacks an array.
pub fn compare_stages(reference: &Reference) -> Result<StageReport, ReferenceError> {
    let mut report = StageReport { outputs: Vec::new() };
    each_output(reference, |m, stage, row, output| {
        keep_worst(&mut report, stage, row, judge(m, reference, row, &output)?);
        Ok(())
    })?;
    Ok(report)
}

/// One field after our computation and after MuJoCo's.
pub struct Output {
    /// Name of the field.
    pub field: &'static str,
    /// Our values.
    pub ours: Vec<f64>,
    /// MuJoCo's values.
    pub theirs: Vec<f64>,
    /// True for floating-point fields.
    pub float: bool,
}

/// Runs every stage on every recorded state and hands model, stage, state and each output to `f`.
///
/// # Errors
/// The reference lacks an array.
pub fn each_output(
    reference: &Reference,
    mut f: impl FnMut(&Model, &'static str, usize, Output) -> Result<(), ReferenceError>,
) -> Result<(), ReferenceError> {
    let m = reference.model()?;
    let mut d = Data::new(&m);
    for row in 0..reference.states()? {
        for stage in STAGES {
            let [reads, writes] = [stage.reads, stage.writes].map(|names| present(&m, names));
            reference.set_state(&mut d, &m, row)?;
            if m.opt.enableflags.contains(Enable::SLEEP) {
                // Stages leave what they computed of sleeping trees, which a forward pass has computed before they slept.
                forward(&m, &mut d).map_err(|e| ReferenceError::Shape(e.to_string()))?;
            } else {
                poison(&m, &mut d, &writes);
            }
            reference.inject(&mut d, &reads, row)?;
            (stage.run)(&m, &mut d);
            for field in writes {
                f(&m, stage.name, row, output(&m, &d, reference, field, row)?)?;
            }
        }
    }
    Ok(())
}

/// The fields that a model has. Fields of flexes count only if it has flexes; older recordings do not know them.
fn present(m: &Model, names: &'static [&'static str]) -> Vec<&'static str> {
    const FLEXES: &[&str] = &["bvh_aabb_dyn", "contact.flex", "contact.elem", "contact.vert"];
    let of_flexes = |name: &&str| name.starts_with("flex") || FLEXES.contains(name);
    names.iter().copied().filter(|name| m.nflex > 0 || !of_flexes(name)).collect()
}

/// Fills the outputs of a stage, so that one which it leaves as it was is noticed: not a number, or -7 in integers.
/// Contacts and rows are lists that the stage makes; in `d` they are empty.
fn poison(m: &Model, d: &mut Data, fields: &[&'static str]) {
    let mut arrays = Vec::new();
    d.visit(m, &mut |name, _, values| {
        if fields.contains(&name) {
            let filling = if values.is_float() { f64::NAN } else { -7.0 };
            arrays.push((name, vec![filling; values.to_f64().len()]));
        }
    });
    arrays.iter().for_each(|(name, values)| _ = d.assign(name, values));
}

/// Field `field` of `d` beside the recorded one of state `row`.
///
/// # Errors
/// The reference lacks the array.
pub fn output(
    m: &Model,
    d: &Data,
    reference: &Reference,
    field: &'static str,
    row: usize,
) -> Result<Output, ReferenceError> {
    let theirs = reference.forward(field, row)?;
    if field == "efc_J" {
        return Ok(Output { field, ours: d.efc.dense_jacobian(m.nv), theirs, float: true });
    }
    let mut output = Output { field, ours: Vec::new(), theirs, float: true };
    d.visit(m, &mut |name, _, values| {
        if name == field {
            output.ours = values.to_f64();
            output.float = values.is_float();
        }
    });
    Ok(output)
}

/// The worst component of a stage output.
fn judge(m: &Model, reference: &Reference, row: usize, output: &Output) -> Result<Worst, ReferenceError> {
    let Output { field, ours, theirs, .. } = output;
    Ok(match (*field, output.float) {
        ("qLD", _) => {
            let scales = factor_scales(m, &reference.forward("M", row)?);
            compare_scaled(field, ours, theirs, relative, |k| scales[k])
        }
        (_, true) => compare(field, ours, theirs, relative),
        (_, false) => compare(field, ours, theirs, exact),
    })
}

/// Scale of each entry of the inertia's factor. In `M = LᵀDL` with a unit diagonal of `L`, an entry `L[i, j]` is a sum of
/// terms of size `√(M[i, i] M[j, j])` divided by a pivot of at most `M[i, i]`: what is far below `√(M[j, j] / M[i, i])` is
/// what cancellation left of them. The field's largest entry, often a mass, says nothing about that.
fn factor_scales(m: &Model, inertia: &[f64]) -> Vec<f64> {
    let diagonal: Vec<f64> =
        (0..m.nv).map(|i| inertia[(m.M_rowadr[i] + m.M_rownnz[i]) as usize - 1]).collect();
    let entry = |i: usize, k: i32| {
        let j = m.M_colind[k as usize] as usize;
        if i == j { diagonal[i] } else { (diagonal[j] / diagonal[i]).sqrt() }
    };
    let mut scales = vec![0.0; m.nC];
    for i in 0..m.nv {
        (m.M_rowadr[i]..m.M_rowadr[i] + m.M_rownnz[i]).for_each(|k| scales[k as usize] = entry(i, k));
    }
    scales
}

fn keep_worst(report: &mut StageReport, stage: &'static str, row: usize, worst: Worst) {
    match report.outputs.iter_mut().find(|(s, _, w)| *s == stage && w.field == worst.field) {
        Some(entry) if worst.error > entry.2.error => *entry = (stage, row, worst),
        Some(_) => {}
        None => report.outputs.push((stage, row, worst)),
    }
}
