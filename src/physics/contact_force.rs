//! Force and torque of one contact, recovered from its constraint rows.

use crate::data::{Constraints, Contact};
use crate::math::Spatial;
use crate::model::{Cone, Model};

/// Force, then torque, that the second geom feels, in the contact frame (normal first); zero for a contact without
/// rows. The adhesive pull is subtracted.
pub fn contact_force(m: &Model, efc: &Constraints, contact: &Contact) -> Spatial {
    let mut out = [0.0; 6];
    let Ok(first) = usize::try_from(contact.efc_address) else { return out };
    let dim = contact.dim as usize;
    if m.opt.cone == Cone::Pyramidal.code() && dim > 1 {
        let edges = &efc.efc_force[first..first + 2 * (dim - 1)];
        out[0] = edges.iter().sum();
        for (i, pair) in edges.chunks_exact(2).enumerate() {
            out[i + 1] = (pair[0] - pair[1]) * contact.friction[i];
        }
    } else {
        out[..dim].copy_from_slice(&efc.efc_force[first..first + dim]);
    }
    out[0] -= contact.adhesion;
    out
}
