//! Flexes: deformable bodies made of lines, triangles or tetrahedra whose vertices are fixed to bodies, or interpolated
//! between nodes that are (MuJoCo documentation, Computation, "Deformable objects").
//!
//! `vertices.rs` places vertices and `boxes.rs` encloses elements; `edges.rs` and `isometry.rs` measure what equality
//! constraints hold; `stretch.rs`, `bending.rs` and `springs.rs` make passive forces. A lattice of nodes
//! (`lattice.rs`) has `cells.rs`, `shell.rs` and `modes.rs` in place of those. `weights.rs` says which bodies a point of a
//! flex belongs to; `metric/` puts stiffness in the inertia. What collides with flexes is in `collision/flex/`.

pub(crate) mod bending;
mod boxes;
pub(crate) mod cells;
pub(crate) mod edges;
mod isometry;
pub(crate) mod lattice;
pub(crate) mod metric;
pub(crate) mod modes;
mod rotation;
pub(crate) mod shell;
pub(crate) mod springs;
pub(crate) mod stretch;
mod support;
pub(crate) mod vertices;
pub(crate) mod weights;

use crate::constraint::Difference;
use crate::data::{Com, Flexes, Kinematics};
use crate::math::Vec3;
use crate::model::Model;
use std::ops::Range;

pub use edges::edge_velocities;
pub use metric::{Effective, Metric, Poses};
pub(crate) use support::{check, check_options};

/// Working memory of flexes, reused from step to step.
#[derive(Clone, Debug, Default)]
pub struct FlexScratch {
    /// Positions of the nodes of one flex.
    nodes: Vec<Vec3>,
    /// Velocities of the nodes of one flex.
    speeds: Vec<Vec3>,
    /// Forces on the vertices or nodes of one flex.
    force: Vec<Vec3>,
    /// How much each edge of one flex is stretched.
    elongation: Vec<f64>,
    /// Damping forces on the nodes of one flex.
    drag: Vec<Vec3>,
    /// Faces of one shell.
    faces: Vec<lattice::Patch>,
    /// Two full rows of a Jacobian.
    rows: [Vec<f64>; 2],
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

/// Computes where the vertices of all flexes are, and the boxes, lengths, strains and Jacobians that follow.
pub fn flexes(m: &Model, kin: &Kinematics, com: &Com, out: &mut Flexes, scratch: &mut FlexScratch) {
    if m.nflex == 0 {
        return;
    }
    vertices::vertices(m, kin, out, scratch);
    boxes::elements(m, out);
    boxes::trees(m, out);
    edges::edges(m, com, out);
    isometry::isometry(m, com, out, &mut scratch.rows);
}

/// One flex: where its parts are in the arrays of the model.
#[derive(Clone, Copy)]
pub(crate) struct Flex<'a> {
    pub m: &'a Model,
    pub id: usize,
}

/// `count` elements from `first`.
fn range(first: i32, count: i32) -> Range<usize> {
    let first = first.max(0) as usize;
    first..first + count.max(0) as usize
}

impl<'a> Flex<'a> {
    pub fn all(m: &'a Model) -> impl Iterator<Item = Flex<'a>> {
        (0..m.nflex).map(move |id| Flex { m, id })
    }

    /// 1 for lines, 2 for triangles, 3 for tetrahedra.
    pub fn dim(self) -> usize {
        self.m.flex_dim[self.id] as usize
    }

    pub fn radius(self) -> f64 {
        self.m.flex_radius[self.id]
    }

    pub fn vertices(self) -> Range<usize> {
        range(self.m.flex_vertadr[self.id], self.m.flex_vertnum[self.id])
    }

    pub fn nodes(self) -> Range<usize> {
        range(self.m.flex_nodeadr[self.id], self.m.flex_nodenum[self.id])
    }

    pub fn edges(self) -> Range<usize> {
        range(self.m.flex_edgeadr[self.id], self.m.flex_edgenum[self.id])
    }

    pub fn elements(self) -> Range<usize> {
        range(self.m.flex_elemadr[self.id], self.m.flex_elemnum[self.id])
    }

    /// Vertices of all elements, counted within the flex.
    pub fn corners(self) -> &'a [i32] {
        let count = self.m.flex_elemnum[self.id] * (self.m.flex_dim[self.id] + 1);
        &self.m.flex_elem[range(self.m.flex_elemdataadr[self.id], count)]
    }

    /// Vertices of element `e`, both counted within the flex.
    pub fn element(self, e: usize) -> &'a [i32] {
        let corners = self.dim() + 1;
        &self.corners()[e * corners..(e + 1) * corners]
    }

    /// Bodies of the vertices; -1 for interpolated ones.
    pub fn vertex_bodies(self) -> &'a [i32] {
        &self.m.flex_vertbodyid[self.vertices()]
    }

    /// Bodies of the nodes.
    pub fn node_bodies(self) -> &'a [i32] {
        &self.m.flex_nodebodyid[self.nodes()]
    }

    /// Bodies that its shape depends on.
    pub fn bodies(self) -> &'a [i32] {
        if self.is_interpolated() { self.node_bodies() } else { self.vertex_bodies() }
    }

    /// The vertices are interpolated between nodes.
    pub fn is_interpolated(self) -> bool {
        self.m.flex_interp[self.id] != 0
    }

    /// Vertices that move on their own, against each other.
    pub fn has_edges(self) -> bool {
        !self.m.flex_rigid[self.id] && !self.is_interpolated()
    }

    /// First number of the stiffness of a flex that resists deformation.
    pub fn stiffness(self) -> Option<usize> {
        let first = usize::try_from(self.m.flex_stiffnessadr[self.id]).ok()?;
        (self.m.flex_stiffness.get(first).copied().unwrap_or(0.0) != 0.0).then_some(first)
    }

    /// First number of the stiffness of bending.
    pub fn bending(self) -> Option<usize> {
        usize::try_from(self.m.flex_bendingadr[self.id]).ok()
    }

    /// What a constraint, a spring or a damper needs of edges is computed.
    pub fn needs_edge_jacobian(self) -> bool {
        let (m, id) = (self.m, self.id);
        m.flex_edgeequality[id] == held::EDGES
            || m.flex_edgedamping[id] != 0.0
            || m.flex_edgestiffness[id] != 0.0
            || m.flex_damping[id] != 0.0
    }
}

/// What equality constraints hold of a flex (`flex_edgeequality`).
pub(crate) mod held {
    pub const EDGES: i32 = 1;
    pub const VERTICES: i32 = 2;
    pub const STRAINS: i32 = 3;
}
