//! Quantities that the step computes only when a sensor or a flag asks for them.
//!
//! ```
//! use robohive_physics::{Data, derive_on_demand, forward};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut data = Data::new(&model);
//! data.state.qvel[2] = 3.0;
//! forward(&model, &mut data)?;
//! derive_on_demand(&model, &mut data);
//! let [potential, kinetic] = data.energy;
//! assert!((potential - 2.0 * 9.81).abs() < 1e-12 && (kinetic - 4.5).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::acceleration::rne_post::rne_post_constraint;
use crate::data::{Data, configuration_of};
use crate::model::Model;
use crate::on_demand::energy::{kinetic, potential};
use crate::on_demand::momentum::subtree_momentum;

/// Energies, momenta of subtrees, and accelerations and forces of bodies, from the last forward pass.
pub fn derive_on_demand(m: &Model, d: &mut Data) {
    let momentum = &mut d.scratch.sensor.momentum;
    d.energy = [potential(m, &configuration_of!(d)), kinetic(m, &d.state, &d.inertia, momentum)];
    subtree_momentum(m, &d.state, &d.kin, &d.com, &d.vel, &mut d.sensor);
    derive_body_forces(m, d);
}

/// Accelerations of bodies and forces on them (`cacc`, `cfrc_int`, `cfrc_ext`), from the last forward pass or step, as
/// `mj_rnePostConstraint` computes them.
pub fn derive_body_forces(m: &Model, d: &mut Data) {
    rne_post_constraint(m, &configuration_of!(d), &d.vel, &d.con, &d.efc, &d.acc, &mut d.sensor);
}
