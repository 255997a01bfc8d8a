//! Our compiled model beside MuJoCo's, array by array.

use crate::compare::{Worst, compare, compiled, exact};
use crate::reference::{Reference, ReferenceError};
use physics::Model;

/// Sizes on which the shape of a state depends: models that differ in one cannot be moved side by side.
const STATE_SIZES: [&str; 9] = ["nq", "nv", "na", "nu", "nbody", "nmocap", "neq", "nhistory", "nkey"];

/// A size that differs: its name, ours, MuJoCo's.
pub type SizeDifference = (&'static str, usize, usize);

/// Finds the sizes of the state in which `m` differs from the recorded model.
///
/// # Errors
/// The reference lacks a size.
pub fn compare_state_sizes(m: &Model, reference: &Reference) -> Result<Vec<SizeDifference>, ReferenceError> {
    let mut ours = Vec::new();
    m.visit_sizes(&mut |name, size| ours.push((name, size)));
    let mut differences = Vec::new();
    for (name, size) in ours.into_iter().filter(|(name, _)| STATE_SIZES.contains(name)) {
        let theirs = reference.size(name)?;
        if size != theirs {
            differences.push((name, size, theirs));
        }
    }
    Ok(differences)
}

/// Outcome of comparing a compiled model.
pub struct CompileReport {
    /// Every field outside the tolerance, worst first.
    pub differences: Vec<Worst>,
    /// Number of fields compared.
    pub fields: usize,
    /// Largest error of all fields, in units of the bar.
    pub largest: f64,
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
    m.visit_flags(&mut |name, flag| {
        ours.push((format!("size.{name}"), vec![f64::from(u8::from(flag))], false))
    });
    m.vis.visit(&mut |group, name, values| {
        // MuJoCo's Python bindings show these two colours as empty.
        if !["bv", "bvactive"].contains(&name) || group != "rgba" {
            ours.push((format!("vis.{group}.{name}"), values.to_f64(), values.is_float()));
        }
    });
    let mut report = CompileReport { differences: Vec::new(), fields: ours.len(), largest: 0.0 };
    for (name, values, float) in ours {
        let theirs = archive.require(&name)?.values.to_f64();
        let worst = compare(&name, &values, &theirs, if float { compiled } else { exact });
        report.largest = report.largest.max(worst.error);
        if worst.error > 1.0 {
            report.differences.push(worst);
        }
    }
    report.differences.sort_by(|a, b| b.error.total_cmp(&a.error));
    Ok(report)
}
