//! Which flexes put stiffness in the inertia, and how much of it.

use crate::model::flex::{Flex, held};
use crate::model::{Cone, Enable, Integrator, Model, Solver};
use std::ops::Range;

/// What stiffness is multiplied by: a constant, and a multiple of a flex's damping.
#[derive(Clone, Copy)]
pub(super) struct Rates {
    pub constant: f64,
    pub damping: f64,
}

impl Rates {
    pub fn of(self, flex: Flex) -> f64 {
        self.constant + self.damping * flex.m.flex_damping[flex.id]
    }
}

/// Stiffness of flexes is added to the inertia in a model with these options.
pub(crate) fn allowed(m: &Model) -> bool {
    m.opt.solver == Solver::Cg
        && matches!(m.opt.integrator, Integrator::Implicit | Integrator::Implicitfast)
        && m.opt.cone != Cone::Elliptic
        && !m.opt.enableflags.contains(Enable::SLEEP)
}

/// Some flex has stiffness that the model's options put in the inertia.
pub(crate) fn is_asked_for(m: &Model) -> bool {
    allowed(m) && Flex::all(m).any(|flex| is_elastic(flex) || has_soft_contacts(flex))
}

/// Contacts of the flex are springs.
pub(crate) fn has_soft_contacts(flex: Flex) -> bool {
    !flex.m.flex_rigid[flex.id] && flex.m.flex_passive[flex.id] != 0
}

/// Elements of the flex resist being stretched or bent.
pub(super) fn is_elastic(flex: Flex) -> bool {
    if flex.m.flex_rigid[flex.id] || flex.is_interpolated() {
        return is_elastic_lattice(flex);
    }
    flex.dim() == 2 && flex.bending().is_some() || flex.dim() >= 2 && flex.stiffness().is_some()
}

/// Cells of a lattice that forces, not constraints, keep in shape.
pub(super) fn is_elastic_lattice(flex: Flex) -> bool {
    !flex.m.flex_rigid[flex.id]
        && flex.is_interpolated()
        && flex.stiffness().is_some()
        && flex.m.flex_edgeequality[flex.id] != held::STRAINS
}

/// Where the stiffness of cell `cell` is, whose nodes have `size` coordinates.
pub(super) fn cell_stiffness(first: usize, cell: usize, size: usize) -> Range<usize> {
    first + cell * size * size..first + (cell + 1) * size * size
}
