//! What the derivative reads, and how terms are added to its rows.

use crate::model::{JointType, Model};
use crate::stages::{Actuation, Com, Flexes, Inertia, Kinematics, State, Tendons, Transmission, Velocity};
use std::ops::Range;

/// Stage outputs that the derivative reads.
#[derive(Clone, Copy)]
#[allow(missing_docs)]
pub struct DerivativeInputs<'a> {
    pub state: &'a State,
    pub kin: &'a Kinematics,
    pub com: &'a Com,
    pub flex: &'a Flexes,
    pub ten: &'a Tendons,
    pub trn: &'a Transmission,
    pub inertia: &'a Inertia,
    pub vel: &'a Velocity,
    pub actuation: &'a Actuation,
}

/// The inputs in `d`. The caller may borrow other parts of `d` at the same time.
macro_rules! inputs_of {
    ($d:expr) => {
        $crate::derivative::DerivativeInputs {
            state: &$d.state,
            kin: &$d.kin,
            com: &$d.com,
            flex: &$d.flex,
            ten: &$d.ten,
            trn: &$d.trn,
            inertia: &$d.inertia,
            vel: &$d.vel,
            actuation: &$d.actuation,
        }
    };
}
pub(crate) use inputs_of;

/// True for a body that is a tree of its own, with a free joint and all the mass.
pub fn is_free_body(m: &Model, body: usize) -> bool {
    let joint = m.body_jntadr[body] as usize;
    m.body_jntnum[body] == 1
        && m.jnt_type[joint] == JointType::Free.code()
        && m.tree_dofnum[m.dof_treeid[m.jnt_dofadr[joint] as usize] as usize] == 6
        && m.body_subtreemass[body] == m.body_mass[body]
}

/// Entries of row `dof` of the derivative.
pub fn row(m: &Model, dof: usize) -> Range<usize> {
    let start = m.D_rowadr[dof] as usize;
    start..start + m.D_rownnz[dof] as usize
}

/// Calls `f` with entry `(dof, columns[p])`, where the pattern has one, and `p`. Both lists of columns increase.
pub(super) fn for_row(
    m: &Model,
    dof: usize,
    columns: &[i32],
    out: &mut [f64],
    mut f: impl FnMut(&mut f64, usize),
) {
    let at = row(m, dof);
    let mut p = 0;
    for (entry, &column) in out[at.clone()].iter_mut().zip(&m.D_colind[at]) {
        while p < columns.len() && columns[p] < column {
            p += 1;
        }
        if p == columns.len() {
            break;
        }
        if columns[p] == column {
            f(entry, p);
        }
    }
}

/// `out += slope J'J` for one sparse row `J`.
pub(super) fn add_square(m: &Model, columns: &[i32], values: &[f64], slope: f64, out: &mut [f64]) {
    for (&dof, &value) in columns.iter().zip(values) {
        let factor = value * slope;
        for_row(m, dof as usize, columns, out, |entry, p| *entry += factor * values[p]);
    }
}
