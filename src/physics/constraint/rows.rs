//! Appending rows, and products of the row Jacobian with vectors.

use crate::math::dot_sparse;
use crate::model::{ConstraintState, ConstraintType, Jacobian, Model};
use crate::stages::Constraints;

impl Model {
    /// True when MuJoCo would store the constraint Jacobian and the Hessian in sparse form.
    pub fn is_sparse(&self) -> bool {
        self.opt.jacobian == Jacobian::Sparse || self.opt.jacobian == Jacobian::Auto && self.nv >= 60
    }
}

/// Removes all rows.
pub(super) fn clear(m: &Model, efc: &mut Constraints) {
    (efc.ne, efc.nf, efc.nl, efc.nefc) = (0, 0, 0, 0);
    efc.efc_type.clear();
    efc.efc_id.clear();
    efc.efc_J_rownnz.clear();
    efc.efc_J_rowadr.clear();
    efc.efc_J_colind.clear();
    efc.efc_J.clear();
    efc.efc_pos.clear();
    efc.efc_margin.clear();
    efc.efc_frictionloss.clear();
    efc.efc_diagA.clear();
    efc.efc_KBIP.clear();
    efc.efc_D.clear();
    efc.efc_R.clear();
    efc.efc_vel.clear();
    efc.efc_aref.clear();
    efc.efc_b.clear();
    efc.efc_state.clear();
    efc.efc_force.clear();
    efc.tendon_efcadr.clear();
    efc.tendon_efcadr.resize(m.ntendon, -1);
}

/// What all rows of one constraint share.
#[derive(Clone, Copy)]
pub(super) struct RowKind {
    pub kind: ConstraintType,
    pub id: usize,
    pub margin: f64,
    pub frictionloss: f64,
}

/// Appends one row with Jacobian `values` in `columns`.
pub(super) fn push(efc: &mut Constraints, row: RowKind, pos: f64, columns: &[i32], values: &[f64]) {
    efc.efc_type.push(row.kind.code());
    efc.efc_id.push(row.id as i32);
    efc.efc_J_rownnz.push(columns.len() as i32);
    efc.efc_J_rowadr.push(efc.efc_J.len() as i32);
    efc.efc_J_colind.extend_from_slice(columns);
    efc.efc_J.extend_from_slice(values);
    efc.efc_pos.push(pos);
    efc.efc_margin.push(row.margin);
    efc.efc_frictionloss.push(row.frictionloss);
    efc.nefc += 1;
    match row.kind {
        ConstraintType::Equality => efc.ne += 1,
        ConstraintType::FrictionDof | ConstraintType::FrictionTendon => efc.nf += 1,
        ConstraintType::LimitJoint | ConstraintType::LimitTendon => efc.nl += 1,
        ConstraintType::ContactFrictionless
        | ConstraintType::ContactPyramidal
        | ConstraintType::ContactElliptic => {}
    }
}

/// Appends a row of a contact whose force another engine has applied already: it has no Jacobian entries, and zero for
/// everything but its position and force, so that nothing applies the force again.
pub fn push_applied(efc: &mut Constraints, kind: ConstraintType, contact: usize, pos: f64, force: f64) {
    push(efc, RowKind { kind, id: contact, margin: 0.0, frictionloss: 0.0 }, pos, &[], &[]);
    efc.efc_KBIP.push([0.0; 4]);
    for values in [
        &mut efc.efc_diagA,
        &mut efc.efc_D,
        &mut efc.efc_R,
        &mut efc.efc_vel,
        &mut efc.efc_aref,
        &mut efc.efc_b,
    ] {
        values.push(0.0);
    }
    efc.efc_state.push(ConstraintState::Quadratic.code());
    efc.efc_force.push(force);
}

/// True when a constraint other than a contact acts on nothing and makes no row.
pub(super) fn is_empty(m: &Model, values: &[f64]) -> bool {
    values.is_empty() || !m.is_sparse() && values.iter().all(|&v| v == 0.0)
}

/// `out = J v`, added up in the order of compressed rows where MuJoCo stores those, else of full rows.
pub fn mul_jacobian(m: &Model, efc: &Constraints, v: &[f64], out: &mut Vec<f64>) {
    let (sparse, whole) = (m.is_sparse(), m.nv & !3);
    out.clear();
    out.extend((0..efc.nefc).map(|i| {
        let start = efc.efc_J_rowadr[i] as usize;
        let range = start..start + efc.efc_J_rownnz[i] as usize;
        let (columns, values) = (&efc.efc_J_colind[range.clone()], &efc.efc_J[range]);
        if sparse { dot_sparse(values, columns, v) } else { dot_row(columns, values, v, whole) }
    }));
}

/// Product of a compressed row with a dense vector, in the order of additions of `math::dense::dot_slice` on full
/// rows: four lanes by column below `whole`, then the remainder.
#[inline]
fn dot_row(columns: &[i32], values: &[f64], v: &[f64], whole: usize) -> f64 {
    const LANE: [[f64; 4]; 4] =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let (mut s, mut rest) = ([0.0; 4], 0.0);
    let mut i = 0;
    while i < columns.len() {
        let c = columns[i] as usize;
        if c >= whole {
            rest += values[i] * v[c];
            i += 1;
        } else if c & 3 == 0 && columns.get(i + 3) == Some(&(c as i32 + 3)) {
            let (x, y) = (&values[i..i + 4], &v[c..c + 4]);
            (0..4).for_each(|k| s[k] += x[k] * y[k]);
            i += 4;
        } else {
            let product = values[i] * v[c];
            (0..4).for_each(|k| s[k] += product * LANE[c & 3][k]);
            i += 1;
        }
    }
    (s[0] + s[2]) + (s[1] + s[3]) + rest
}

/// `out = Jᵀ f`.
pub fn mul_jacobian_transposed(efc: &Constraints, f: &[f64], out: &mut [f64]) {
    out.fill(0.0);
    for (i, &f) in f.iter().enumerate().take(efc.nefc) {
        if f == 0.0 {
            continue;
        }
        let start = efc.efc_J_rowadr[i] as usize;
        for k in start..start + efc.efc_J_rownnz[i] as usize {
            out[efc.efc_J_colind[k] as usize] += efc.efc_J[k] * f;
        }
    }
}
