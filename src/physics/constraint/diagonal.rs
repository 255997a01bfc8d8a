//! Diagonal of the inverse inertia in constraint space, `J M⁻¹ Jᵀ`: estimated from the inverse weights at the
//! reference configuration, or exact (MuJoCo documentation, Computation, "Parameters").

use crate::data::{Constraints, Contacts, Inertia};
use crate::inertia::row;
use crate::math::dense::dot_slice;
use crate::model::{ConstraintType, EqType, Model, ObjType};

/// Estimates `efc_diagA` of all rows.
pub(super) fn approximate(m: &Model, con: &Contacts, efc: &mut Constraints) {
    efc.efc_diagA.clear();
    efc.efc_diagA.resize(efc.nefc, 0.0);
    let mut i = 0;
    while i < efc.nefc {
        let (id, length) = (efc.efc_id[i] as usize, block_length(m, con, efc, i));
        let out = &mut efc.efc_diagA[i..i + length];
        match ConstraintType::from_code(efc.efc_type[i]) {
            Some(ConstraintType::Equality) => equality(m, id, out),
            Some(ConstraintType::FrictionDof) => out[0] = m.dof_invweight0[id],
            Some(ConstraintType::LimitJoint) => out[0] = m.dof_invweight0[m.jnt_dofadr[id] as usize],
            Some(ConstraintType::FrictionTendon | ConstraintType::LimitTendon) => {
                out[0] = m.tendon_invweight0[id];
            }
            Some(kind) => contact(m, con, id, kind, out),
            None => {}
        }
        i += length;
    }
}

/// Number of rows of the constraint whose first row is `i`.
pub(super) fn block_length(m: &Model, con: &Contacts, efc: &Constraints, i: usize) -> usize {
    let id = efc.efc_id[i] as usize;
    match ConstraintType::from_code(efc.efc_type[i]) {
        Some(ConstraintType::ContactElliptic) => con.contact[id].dim as usize,
        Some(ConstraintType::ContactPyramidal) => 2 * (con.contact[id].dim as usize - 1),
        Some(ConstraintType::Equality) => match EqType::from_code(m.eq_type[id]) {
            Some(EqType::Weld) => 6,
            Some(EqType::Connect) => 3,
            _ => 1,
        },
        _ => 1,
    }
}

fn equality(m: &Model, eq: usize, out: &mut [f64]) {
    let ids = [m.eq_obj1id[eq], m.eq_obj2id[eq]];
    let bodies = || {
        let site = m.eq_objtype[eq] == ObjType::Site.code();
        ids.map(|i| if site { m.site_bodyid[i as usize] as usize } else { i as usize })
    };
    match EqType::from_code(m.eq_type[eq]) {
        Some(EqType::Connect | EqType::Weld) => {
            let [a, b] = bodies();
            for (k, out) in out.iter_mut().enumerate() {
                *out = m.body_invweight0[a][k / 3] + m.body_invweight0[b][k / 3];
            }
        }
        Some(EqType::Joint) => {
            let weight = |j: i32| m.dof_invweight0[m.jnt_dofadr[j as usize] as usize];
            out[0] = ids.into_iter().filter(|&j| j >= 0).map(weight).sum();
        }
        Some(EqType::Tendon) => {
            let weight = |t: i32| m.tendon_invweight0[t as usize];
            out[0] = ids.into_iter().filter(|&t| t >= 0).map(weight).sum();
        }
        Some(EqType::Flex | EqType::Flexvert | EqType::Flexstrain | EqType::Distance) | None => {}
    }
}

fn contact(m: &Model, con: &Contacts, id: usize, kind: ConstraintType, out: &mut [f64]) {
    let contact = &con.contact[id];
    let [a, b] = contact.geom.map(|g| m.body_invweight0[m.geom_bodyid[g as usize] as usize]);
    let (translation, rotation) = (a[0] + b[0], a[1] + b[1]);
    match kind {
        ConstraintType::ContactPyramidal => {
            for (k, out) in out.iter_mut().enumerate() {
                let mu = contact.friction[k / 2];
                *out = translation + mu * mu * if k < 4 { translation } else { rotation };
            }
        }
        _ => {
            for (k, out) in out.iter_mut().enumerate() {
                *out = if k < 3 { translation } else { rotation };
            }
        }
    }
}

/// `Y = J M^(-1/2)` in compressed rows, from the L'DL factor: `Y Yᵀ` is the inverse inertia in constraint space.
#[derive(Clone, Debug, Default)]
pub struct HalfJacobian {
    /// Non-zeros of each row.
    pub rownnz: Vec<usize>,
    /// Start of each row.
    pub rowadr: Vec<usize>,
    /// Columns, increasing within a row.
    pub colind: Vec<usize>,
    /// Entries.
    pub values: Vec<f64>,
    dense: Vec<f64>,
    mark: Vec<usize>,
    /// Reciprocal square root of the factor's diagonal.
    root: Vec<f64>,
}

impl HalfJacobian {
    /// Columns and entries of row `i`.
    pub fn row(&self, i: usize) -> (&[usize], &[f64]) {
        let range = self.rowadr[i]..self.rowadr[i] + self.rownnz[i];
        (&self.colind[range.clone()], &self.values[range])
    }
}

/// Computes `Y`: a row of `J`, completed with the ancestors of its degrees of freedom, is substituted back
/// through the unit factor and scaled by the square root of the diagonal.
pub fn half_jacobian(m: &Model, inertia: &Inertia, efc: &Constraints, y: &mut HalfJacobian) {
    y.rownnz.clear();
    y.rowadr.clear();
    y.colind.clear();
    y.values.clear();
    y.dense.clear();
    y.dense.resize(m.nv, 0.0);
    y.mark.clear();
    y.mark.resize(m.nv, usize::MAX);
    y.root.clear();
    y.root.extend((0..m.nv).map(|dof| 1.0 / inertia.qLD[row(m, dof).end - 1].sqrt()));
    for i in 0..efc.nefc {
        let first = y.colind.len();
        add_pattern(m, efc, i, y);
        let start = efc.efc_J_rowadr[i] as usize;
        for k in start..start + efc.efc_J_rownnz[i] as usize {
            y.dense[efc.efc_J_colind[k] as usize] = efc.efc_J[k];
        }
        for at in (first..y.colind.len()).rev() {
            substitute(m, inertia, y.colind[at], &mut y.dense);
        }
        for &column in &y.colind[first..] {
            y.values.push(y.dense[column] * y.root[column]);
            y.dense[column] = 0.0;
        }
        y.rowadr.push(first);
        y.rownnz.push(y.colind.len() - first);
    }
}

/// Appends the columns of row `i`: those of `J` and their ancestors. Rows of one contact share them.
fn add_pattern(m: &Model, efc: &Constraints, i: usize, y: &mut HalfJacobian) {
    let columns = |i: usize| {
        let start = efc.efc_J_rowadr[i] as usize;
        &efc.efc_J_colind[start..start + efc.efc_J_rownnz[i] as usize]
    };
    if i > 0 && columns(i) == columns(i - 1) {
        let before = y.rowadr[i - 1];
        y.colind.extend_from_within(before..before + y.rownnz[i - 1]);
        return;
    }
    let first = y.colind.len();
    for &column in columns(i) {
        add_ancestors(m, column as usize, i, y);
    }
    y.colind[first..].sort_unstable();
}

/// Marks the pattern of row `column` of the inertia as non-zero in row `i`.
fn add_ancestors(m: &Model, column: usize, i: usize, y: &mut HalfJacobian) {
    if y.mark[column] == i {
        return;
    }
    for &c in &m.M_colind[row(m, column)] {
        let c = c as usize;
        if y.mark[c] != i {
            y.mark[c] = i;
            y.colind.push(c);
        }
    }
}

fn substitute(m: &Model, inertia: &Inertia, column: usize, dense: &mut [f64]) {
    let value = dense[column];
    if value == 0.0 {
        return;
    }
    let range = row(m, column);
    for k in range.start..range.end - 1 {
        dense[m.M_colind[k] as usize] -= inertia.qLD[k] * value;
    }
}

/// Sets `efc_diagA` to the squared lengths of the rows of `Y`.
pub(super) fn exact(y: &HalfJacobian, efc: &mut Constraints) {
    for i in 0..efc.nefc {
        let values = y.row(i).1;
        efc.efc_diagA[i] = dot_slice(values, values);
    }
}
