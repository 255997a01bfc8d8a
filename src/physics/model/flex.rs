//! Flexes as the arrays of a model say them: where the parts of one are, and the body that stands for one in a contact.

use super::with_plugins::Model;
use crate::stages::Contact;
use std::ops::Range;

/// One flex: where its parts are in the arrays of the model.
#[derive(Clone, Copy)]
pub(crate) struct Flex<'a> {
    pub m: &'a Model,
    pub id: usize,
}

/// `count` elements from `first`.
pub(crate) fn range(first: i32, count: i32) -> Range<usize> {
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

/// One body that stands for a side of a contact: of an element its first vertex, of an interpolated flex its first node.
#[inline]
pub(crate) fn representative(m: &Model, contact: &Contact, side: usize) -> usize {
    usize::try_from(contact.geom[side])
        .map_or_else(|_| representative_of_flex(m, contact, side), |geom| m.geom_bodyid[geom] as usize)
}

#[cold]
fn representative_of_flex(m: &Model, contact: &Contact, side: usize) -> usize {
    let flex = Flex { m, id: contact.flex[side] as usize };
    let body = if flex.is_interpolated() {
        flex.node_bodies()[0]
    } else if let Ok(vertex) = usize::try_from(contact.vert[side]) {
        flex.vertex_bodies()[vertex]
    } else {
        flex.vertex_bodies()[flex.element(contact.elem[side] as usize)[0] as usize]
    };
    body as usize
}
