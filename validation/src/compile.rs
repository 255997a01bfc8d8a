//! Our compiled model beside MuJoCo's, array by array.

use crate::compare::{Worst, compare, compiled, exact};
use crate::reference::{Reference, ReferenceError};
use physics::Model;

/// Outcome of comparing a compiled model.
pub struct CompileReport {
    /// Every field outside the tolerance, worst first.
    pub differences: Vec<Worst>,
    /// Number of fields compared.
    pub fields: usize,
}

impl CompileReport {
    /// True when every field agrees.
    pub fn agrees(&self) -> bool {
        self.differences.is_empty()
    }
}

/// Compares every array, size, option and statistic of `m` with the recorded model.
///
/// # Errors
/// The reference lacks an array.
pub fn compare_compiled(m: &Model, reference: &Reference) -> Result<CompileReport, ReferenceError> {
    let archive = reference.archive();
    let mut ours: Vec<(String, Vec<f64>, bool)> = Vec::new();
    m.visit(&mut |name, _, values| ours.push((format!("model.{name}"), values.to_f64(), values.is_float())));
    m.opt.visit(&mut |name, values| ours.push((format!("opt.{name}"), values.to_f64(), values.is_float())));
    m.stat.visit(&mut |name, values| ours.push((format!("stat.{name}"), values.to_f64(), true)));
    let mut report = CompileReport { differences: Vec::new(), fields: ours.len() };
    for (name, values, float) in ours {
        let theirs = archive.require(&name)?.values.to_f64();
        let worst = compare(&name, &values, &theirs, if float { compiled } else { exact });
        if worst.error > 1.0 {
            report.differences.push(worst);
        }
    }
    report.differences.sort_by(|a, b| b.error.total_cmp(&a.error));
    Ok(report)
}
