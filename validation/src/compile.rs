//! Our compiled model beside MuJoCo's, array by array.

use crate::compare::{Worst, compare, compiled, exact};
use crate::reference::{Reference, ReferenceError};
use physics::Model;

/// A field whose numbers may differ, the reason, and the property that is checked instead.
pub struct Exception {
    /// Name of the field.
    pub field: &'static str,
    /// Why the numbers may differ.
    pub reason: &'static str,
}

/// Fields that need not be equal.
pub const EXCEPTIONS: &[Exception] = &[
    Exception {
        field: "mesh_graph",
        reason: "order of hull facets: MuJoCo's comes from Qhull's pivoting; the vertex set is compared",
    },
    Exception { field: "mesh_polynormal", reason: "order of hull polygons, which follows the facets" },
    Exception { field: "mesh_polyvert", reason: "order of hull polygons, which follows the facets" },
    Exception { field: "mesh_polyvertadr", reason: "order of hull polygons, which follows the facets" },
    Exception { field: "mesh_polyvertnum", reason: "order of hull polygons, which follows the facets" },
    Exception { field: "mesh_polyadr", reason: "order of hull polygons, which follows the facets" },
    Exception { field: "mesh_polynum", reason: "order of hull polygons, which follows the facets" },
    Exception { field: "mesh_polymap", reason: "order of hull polygons, which follows the facets" },
    Exception { field: "mesh_polymapadr", reason: "order of hull polygons, which follows the facets" },
    Exception { field: "mesh_polymapnum", reason: "order of hull polygons, which follows the facets" },
    Exception { field: "mesh_graphadr", reason: "address of the hull graph" },
    Exception { field: "mesh_pathadr", reason: "address of a file name, which differs in a repaired copy" },
    Exception { field: "hfield_pathadr", reason: "address of a file name, which differs in a repaired copy" },
    Exception { field: "tex_pathadr", reason: "address of a file name, which differs in a repaired copy" },
    Exception { field: "paths", reason: "file names, which differ in a repaired copy" },
];

/// Outcome of comparing a compiled model.
pub struct CompileReport {
    /// Every field outside the tolerance, worst first.
    pub differences: Vec<Worst>,
    /// Excepted fields that differ.
    pub excepted: Vec<Worst>,
    /// Number of fields compared.
    pub fields: usize,
}

impl CompileReport {
    /// True when every field but the excepted ones agrees.
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
    let mut report = CompileReport { differences: Vec::new(), excepted: Vec::new(), fields: ours.len() };
    for (name, values, float) in ours {
        let theirs = archive.require(&name)?.values.to_f64();
        let worst = compare(&name, &values, &theirs, if float { compiled } else { exact });
        if worst.error <= 1.0 {
            continue;
        }
        let field = name.split_once('.').map_or("", |(_, field)| field);
        let list = if EXCEPTIONS.iter().any(|e| e.field == field) {
            &mut report.excepted
        } else {
            &mut report.differences
        };
        list.push(worst);
    }
    report.differences.sort_by(|a, b| b.error.total_cmp(&a.error));
    Ok(report)
}
