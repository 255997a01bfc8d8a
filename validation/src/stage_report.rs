//! How far the outputs of stages are from MuJoCo's.

use crate::compare::{Worst, compare, compare_scaled, exact, relative};
use crate::reference::{Reference, ReferenceError};
use crate::stages::{Output, each_output};
use crate::tolerance::STAGE_BAR;
use physics::Model;

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
