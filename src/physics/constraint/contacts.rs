//! Contact rows: one for the normal without friction, pairs of pyramid edges, or the axes of an elliptic cone
//! (MuJoCo documentation, Computation, "Contact").

use super::rows::{RowKind, push};
use super::scratch::ConstraintScratch;
use crate::flex::metric;
use crate::math::{dot, row};
use crate::model::{Cone, ConstraintType, Disable, Model};
use crate::stages::{Com, Constraints, Contact, Contacts, Flexes};

/// `exclude` of a contact that moves nothing.
pub const NO_DOF: i32 = 3;

/// Appends the rows of every contact that is not excluded and records the first row in `efc_address`.
pub(super) fn contacts(
    m: &Model,
    com: &Com,
    flexes: &Flexes,
    con: &mut Contacts,
    efc: &mut Constraints,
    scratch: &mut ConstraintScratch,
) {
    if m.opt.disableflags.contains(Disable::CONTACT) || m.nv == 0 {
        return;
    }
    if m.nflex > 0 && metric::is_asked_for(m) {
        metric::mark(m, con);
    }
    for (id, contact) in con.contact.iter_mut().enumerate().filter(|(_, c)| c.exclude == 0) {
        scratch.chain.of_contact(m, com, flexes, contact, &mut scratch.bodies);
        if scratch.chain.dof.is_empty() {
            contact.efc_address = -1;
            contact.exclude = NO_DOF;
            continue;
        }
        contact.efc_address = efc.nefc as i32;
        contact_frame_jacobian(contact, scratch);
        contact_rows(m, id, contact, efc, scratch);
    }
}

/// Rotates the Jacobian difference to the contact frame: `dim` rows of `scratch.values`.
fn contact_frame_jacobian(contact: &Contact, scratch: &mut ConstraintScratch) {
    let ConstraintScratch { chain, columns, values, .. } = scratch;
    columns.clear();
    columns.extend_from_slice(&chain.dof);
    values.clear();
    for axis in 0..contact.dim as usize {
        let direction = row(&contact.frame, axis % 3);
        let part = if axis < 3 { &chain.translation } else { &chain.rotation };
        values.extend(part.iter().map(|v| dot(direction, *v)));
    }
}

fn contact_rows(m: &Model, id: usize, contact: &Contact, efc: &mut Constraints, scratch: &ConstraintScratch) {
    let (columns, jacobian) = (&scratch.columns, &scratch.values);
    let of = |kind, margin| RowKind { kind, id, margin, frictionloss: 0.0 };
    if contact.dim == 1 {
        let row = of(ConstraintType::ContactFrictionless, contact.includemargin);
        push(efc, row, contact.dist, columns, jacobian);
    } else if m.opt.cone == Cone::Pyramidal {
        let row = of(ConstraintType::ContactPyramidal, contact.includemargin);
        pyramid_rows(row, contact, efc, columns, jacobian);
    } else {
        for (axis, values) in jacobian.chunks_exact(columns.len()).enumerate() {
            let (dist, margin) = if axis == 0 { (contact.dist, contact.includemargin) } else { (0.0, 0.0) };
            push(efc, of(ConstraintType::ContactElliptic, margin), dist, columns, values);
        }
    }
}

/// Opposite edges of the pyramid, a pair for each friction direction: normal ± μ tangent.
fn pyramid_rows(row: RowKind, contact: &Contact, efc: &mut Constraints, columns: &[i32], jacobian: &[f64]) {
    let (normal, tangents) = jacobian.split_at(columns.len());
    for (tangent, mu) in tangents.chunks_exact(columns.len()).zip(contact.friction) {
        for mu in [mu, -mu] {
            push(efc, row, contact.dist, columns, &[]);
            efc.efc_J.extend(normal.iter().zip(tangent).map(|(n, t)| n + t * mu));
        }
    }
}
