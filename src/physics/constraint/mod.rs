//! Constraint rows: what must hold (equality), what resists (friction loss), what may not be crossed (limits,
//! contacts), and the parameters that make each row soft (MuJoCo documentation, Computation, "Constraint model").
//!
//! Rows come in that order; the Jacobian is kept in compressed rows. A row is a mass-spring-damper in its own
//! direction: `reference` gives the acceleration it asks for, `impedance` how firmly it asks.

mod contacts;
mod diagonal;
mod equality;
mod friction_loss;
mod half_jacobian;
mod impedance;
mod islands;
mod jacobian_rate;
mod limits;
mod reference;
mod rows;
mod scratch;

pub use contacts::NO_DOF;
pub use half_jacobian::{BLOCK, HalfJacobian, TILE, half_jacobian};
pub use islands::{IslandScratch, find_islands};
pub use reference::reference;
pub use rows::{mul_jacobian, mul_jacobian_transposed, push_applied};
pub use scratch::ConstraintScratch;

use crate::model::{Disable, Enable, Model};
use crate::sleep::Awake;
use crate::stages::{Configuration, Constraints, Contacts, Inertia};

/// Builds all rows of this configuration with their impedance; sets `efc_address`, `mu` and `exclude` of contacts.
pub fn make_constraint(
    m: &Model,
    at: &Configuration,
    inertia: &Inertia,
    con: &mut Contacts,
    efc: &mut Constraints,
    scratch: &mut ConstraintScratch,
) {
    let Configuration { state, com, flex, ten, .. } = *at;
    rows::clear(m, efc);
    if m.opt.disableflags.contains(Disable::CONSTRAINT) {
        return;
    }
    equality::equality(m, at, efc, scratch);
    friction_loss::friction_loss(m, Awake::of(m, state), ten, efc);
    limits::limits(m, state, ten, efc, scratch);
    contacts::contacts(m, com, flex, con, efc, scratch);
    diagonal::approximate(m, flex, con, efc, &mut scratch.bodies);
    impedance::impedance(m, con, efc);
    if m.opt.enableflags.contains(Enable::DIAGEXACT) {
        half_jacobian(m, inertia, efc, &mut scratch.half);
        diagonal::exact(&mut scratch.half, efc);
        impedance::impedance(m, con, efc);
    }
}
