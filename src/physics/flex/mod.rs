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
pub(crate) mod difference;
pub(crate) mod edges;
mod isometry;
pub(crate) mod lattice;
pub(crate) mod metric;
pub(crate) mod modes;
mod rotation;
mod scratch;
pub(crate) mod shell;
pub(crate) mod springs;
pub(crate) mod stretch;
mod support;
pub(crate) mod vertices;
pub(crate) mod weights;

use crate::model::Model;
use crate::stages::{Com, Flexes, Kinematics};

pub use crate::stages::Poses;
pub use edges::edge_velocities;
pub use metric::{Effective, Metric};
pub use scratch::FlexScratch;
pub(crate) use support::{check, check_options};

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
