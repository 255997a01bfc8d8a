//! Friction-loss rows of degrees of freedom and tendons: a bounded force that opposes motion.

use super::rows::{RowKind, is_empty, push};
use crate::model::{ConstraintType, Disable, Model};
use crate::sleep::Awake;
use crate::stages::{Constraints, Tendons};

/// Appends one row for each degree of freedom and tendon with friction loss.
pub(super) fn friction_loss(m: &Model, awake: Awake, ten: &Tendons, efc: &mut Constraints) {
    if m.opt.disableflags.contains(Disable::FRICTIONLOSS) {
        return;
    }
    for (dof, &frictionloss) in m.dof_frictionloss.iter().enumerate() {
        if frictionloss != 0.0 && !awake.sleeps(m.dof_bodyid[dof] as usize) {
            let row = RowKind { kind: ConstraintType::FrictionDof, id: dof, margin: 0.0, frictionloss };
            push(efc, row, 0.0, &[dof as i32], &[1.0]);
        }
    }
    for tendon in 0..m.ntendon {
        let frictionloss = m.tendon_frictionloss[tendon];
        if frictionloss <= 0.0 {
            continue;
        }
        let first = efc.nefc as i32;
        let (columns, values) = tendon_row(m, ten, tendon);
        if !is_empty(m, values) {
            let row = RowKind { kind: ConstraintType::FrictionTendon, id: tendon, margin: 0.0, frictionloss };
            push(efc, row, 0.0, columns, values);
        }
        if efc.tendon_efcadr[tendon] == -1 {
            efc.tendon_efcadr[tendon] = first;
        }
    }
}

/// Columns and entries of the Jacobian of a tendon.
pub(super) fn tendon_row<'a>(m: &'a Model, ten: &'a Tendons, tendon: usize) -> (&'a [i32], &'a [f64]) {
    let start = m.ten_J_rowadr[tendon] as usize;
    let range = start..start + m.ten_J_rownnz[tendon] as usize;
    (&m.ten_J_colind[range.clone()], &ten.ten_J[range])
}
