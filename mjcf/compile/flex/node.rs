//! A flex while it is compiled: elements, shell and elasticity settled, before it becomes rows.

use super::topology::{Edges, Shell};
use crate::spec::Flex;
use physics::geometry::hierarchy::Bvh;
use physics::math::Vec3;

/// A compiled flex.
pub(crate) struct FlexNode<'s> {
    pub(super) spec: &'s Flex,
    /// All vertices are fixed to one body.
    pub(super) rigid: bool,
    /// All vertices, or nodes, are at the origins of their bodies.
    pub(super) centered: bool,
    /// Body of each vertex, or one for all; -1 where nodes move it.
    pub(super) vertbody: Vec<i32>,
    pub(super) nodebody: Vec<i32>,
    pub(super) vertices: usize,
    /// Vertices of the elements, tetrahedra turned alike.
    pub(super) elem: Vec<i32>,
    pub(super) edges: Edges,
    /// Corners around each edge, triangles only.
    pub(super) flaps: Vec<[i32; 4]>,
    pub(super) shell: Shell,
    pub(super) stiffness: Vec<f64>,
    pub(super) bending: Vec<f64>,
    pub(super) bvh: Bvh,
    /// Half sizes of the box around the vertices, or the nodes.
    pub(super) size: Vec3,
    /// Vertices in that box, from 0 to 1.
    pub(super) vert0: Vec<Vec3>,
    /// Nodes along the axes of the lattice.
    pub(super) node0: Vec<Vec3>,
}
