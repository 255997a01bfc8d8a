//! Diagonal of the inverse inertia in constraint space, `J M⁻¹ Jᵀ`: estimated from the inverse weights at the
//! reference configuration, or exact (MuJoCo documentation, Computation, "Parameters").

use super::half_jacobian::HalfJacobian;
use crate::flex::modes::StrainedCell;
use crate::flex::{springs, weights};
use crate::math::dense::dot_slice;
use crate::model::flex::Flex;
use crate::model::{ConstraintType, EqType, Model, ObjType};
use crate::stages::{Constraints, Contact, Contacts, Flexes};

/// Estimates `efc_diagA` of all rows.
pub(super) fn approximate(
    m: &Model,
    flexes: &Flexes,
    con: &Contacts,
    efc: &mut Constraints,
    bodies: &mut Vec<(usize, f64)>,
) {
    efc.efc_diagA.clear();
    efc.efc_diagA.resize(efc.nefc, 0.0);
    let mut i = 0;
    while i < efc.nefc {
        let (id, mut length) = (efc.efc_id[i] as usize, block_length(m, con, efc, i));
        if is_flex_equality(m, efc, i) {
            length = (i..efc.ne).take_while(|&row| efc.efc_id[row] as usize == id).count();
        }
        let out = &mut efc.efc_diagA[i..i + length];
        match ConstraintType::from_code(efc.efc_type[i]) {
            Some(ConstraintType::Equality) => equality(m, id, out),
            Some(ConstraintType::FrictionDof) => out[0] = m.dof_invweight0[id],
            Some(ConstraintType::LimitJoint) => out[0] = m.dof_invweight0[m.jnt_dofadr[id] as usize],
            Some(ConstraintType::FrictionTendon | ConstraintType::LimitTendon) => {
                out[0] = m.tendon_invweight0[id];
            }
            Some(kind) => contact(m, flexes, &con.contact[id], kind, bodies, out),
            None => {}
        }
        i += length;
    }
}

/// True for rows of edges and strains of flexes: a constraint makes any number, each of its own.
pub(super) fn is_flex_equality(m: &Model, efc: &Constraints, i: usize) -> bool {
    efc.efc_type[i] == ConstraintType::Equality.code()
        && matches!(
            EqType::from_code(m.eq_type[efc.efc_id[i] as usize]),
            Some(EqType::Flex | EqType::Flexvert | EqType::Flexstrain)
        )
}

/// Number of rows of the constraint whose first row is `i`; rows of flexes count one by one.
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

/// Not inlined, so that the addresses of its arrays are loaded only where equalities exist.
#[inline(never)]
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
        Some(EqType::Flex) => {
            let flex = Flex { m, id: ids[0] as usize };
            for (out, e) in out.iter_mut().zip(springs::moving_edges(flex)) {
                *out = m.flexedge_invweight0[e];
            }
        }
        Some(EqType::Flexvert) => {
            let flex = Flex { m, id: ids[0] as usize };
            for (out, &body) in out.chunks_mut(2).zip(flex.vertex_bodies()) {
                out.fill(m.body_invweight0[body as usize][0]);
            }
        }
        Some(EqType::Flexstrain) => {
            out.fill(StrainedCell::new(m, eq).map_or(0.0, |cell| cell.inverse_weight()));
        }
        Some(EqType::Distance) | None => {}
    }
}

fn contact(
    m: &Model,
    flexes: &Flexes,
    contact: &Contact,
    kind: ConstraintType,
    bodies: &mut Vec<(usize, f64)>,
    out: &mut [f64],
) {
    let [translation, rotation] = match weights::single_bodies(m, contact) {
        Some(pair) => {
            let [a, b] = pair.map(|body| m.body_invweight0[body]);
            [a[0] + b[0], a[1] + b[1]]
        }
        None => {
            bodies.clear();
            (0..2).for_each(|side| weights::bodies_of(m, flexes, contact, side, 1.0, bodies));
            let mean = |k: usize| bodies.iter().fold(0.0, |s, &(b, w)| s + m.body_invweight0[b][k] * w);
            [mean(0), mean(1)]
        }
    };
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

/// Sets `efc_diagA` to the squared lengths of the rows of `Y`.
pub(super) fn exact(y: &mut HalfJacobian, efc: &mut Constraints) {
    for i in 0..efc.nefc {
        let values = y.row(efc, i);
        efc.efc_diagA[i] = dot_slice(values, values);
    }
}
