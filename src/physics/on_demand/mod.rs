//! Quantities that the step computes only when a sensor or a flag asks for them.

pub mod energy;
pub mod momentum;

use crate::acceleration::rne_post::rne_post_constraint;
use crate::data::{Data, configuration_of};
use crate::model::Model;
use crate::on_demand::energy::{kinetic, potential};
use crate::on_demand::momentum::subtree_momentum;

/// Energies, momenta of subtrees, and accelerations and forces of bodies, from the last forward pass.
pub fn derive_on_demand(m: &Model, d: &mut Data) {
    let momentum = &mut d.scratch.sensor.momentum;
    d.energy = [potential(m, &d.state, &d.kin, &d.ten), kinetic(m, &d.state, &d.inertia, momentum)];
    subtree_momentum(m, &d.kin, &d.com, &d.vel, &mut d.sensor);
    rne_post_constraint(m, &configuration_of!(d), &d.vel, &d.con, &d.efc, &d.acc, &mut d.sensor);
}
