//! Forces of contacts, assembled from their constraint rows.

use crate::model::{Cone, Model};
use crate::stages::{Constraints, Contact};

/// Force and torque of a contact in its own frame, from the first geom on the second, less the adhesive pull; zero
/// for a contact without rows. A pyramid's normal force is the sum of its edges, friction their differences.
pub fn contact_force(m: &Model, efc: &Constraints, c: &Contact) -> [f64; 6] {
    let mut force = [0.0; 6];
    let Ok(first) = usize::try_from(c.efc_address) else { return force };
    let dim = c.dim as usize;
    if m.opt.cone == Cone::Elliptic || dim == 1 {
        force[..dim].copy_from_slice(&efc.efc_force[first..first + dim]);
    } else {
        let edges = &efc.efc_force[first..first + 2 * (dim - 1)];
        force[0] = edges.iter().fold(0.0, |sum, f| sum + f);
        for (k, pair) in edges.chunks_exact(2).enumerate() {
            force[k + 1] = (pair[0] - pair[1]) * c.friction[k];
        }
    }
    force[0] -= c.adhesion;
    force
}
