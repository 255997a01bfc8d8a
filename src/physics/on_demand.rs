//! Quantities that the step computes only when a sensor or a flag asks for them.

use crate::data::Data;
use crate::energy::{kinetic, potential};
use crate::model::Model;
use crate::momentum::subtree_momentum;
use crate::rne_post::rne_post_constraint;

/// Energies, momenta of subtrees, and accelerations and forces of bodies, from the last forward pass.
pub fn derive_on_demand(m: &Model, d: &mut Data) {
    let momentum = &mut d.scratch.sensor.momentum;
    d.energy = [potential(m, &d.state, &d.kin, &d.ten), kinetic(m, &d.state, &d.inertia, momentum)];
    subtree_momentum(m, &d.kin, &d.com, &d.vel, &mut d.sensor);
    rne_post_constraint(m, &d.state, &d.kin, &d.com, &d.vel, &d.con, &d.efc, &d.acc, &mut d.sensor);
}
