//! Working memory of flexes.

use super::difference::Difference;
use super::lattice::Patch;
use crate::math::Vec3;

/// Working memory of flexes, reused from step to step.
#[derive(Clone, Debug, Default)]
pub struct FlexScratch {
    /// Positions of the nodes of one flex.
    pub(super) nodes: Vec<Vec3>,
    /// Velocities of the nodes of one flex.
    pub(super) speeds: Vec<Vec3>,
    /// Forces on the vertices or nodes of one flex.
    pub(super) force: Vec<Vec3>,
    /// How much each edge of one flex is stretched.
    pub(super) elongation: Vec<f64>,
    /// Damping forces on the nodes of one flex.
    pub(super) drag: Vec<Vec3>,
    /// Faces of one shell.
    pub(super) faces: Vec<Patch>,
    /// Two full rows of a Jacobian.
    pub(super) rows: [Vec<f64>; 2],
    /// Bodies of a contact with their weights, and how they move it.
    bodies: Vec<(usize, f64)>,
    sum: Difference,
}

impl FlexScratch {
    /// Memory for the motion of a contact.
    pub(crate) fn of_contact(&mut self) -> (&mut Vec<(usize, f64)>, &mut Difference) {
        (&mut self.bodies, &mut self.sum)
    }
}
