//! Which degrees of freedom the edges and vertices of flexes depend on, and the edges around each vertex.

use crate::model::{Arrays, Model};
use crate::position::chain::last_dof;
use std::collections::BTreeSet;
use std::ops::Range;

/// Vertices of flex `f`.
fn vertices(m: &Arrays, f: usize) -> Range<usize> {
    let first = m.flex_vertadr[f] as usize;
    first..first + m.flex_vertnum[f] as usize
}

/// Edges of flex `f`.
pub(super) fn edges(m: &Arrays, f: usize) -> Range<usize> {
    let first = m.flex_edgeadr[f] as usize;
    first..first + m.flex_edgenum[f] as usize
}

/// Vertices move on their own, against each other.
pub(super) fn has_edges(m: &Arrays, f: usize) -> bool {
    !m.flex_rigid[f] && m.flex_interp[f] == 0
}

/// Constraints hold the vertices of a surface.
pub(super) fn holds_vertices(m: &Arrays, f: usize) -> bool {
    has_edges(m, f) && m.flex_dim[f] == 2 && m.flex_edgeequality[f] == 2
}

/// Ends of edge `e` of flex `f`, among all vertices.
pub(super) fn ends(m: &Arrays, f: usize, e: usize) -> [usize; 2] {
    m.flex_edge[e].map(|v| m.flex_vertadr[f] as usize + v as usize)
}

/// Adds the degrees of freedom that move the body of vertex `v`.
fn add_chain(m: &Arrays, v: usize, dofs: &mut BTreeSet<i32>) {
    let mut dof = last_dof(m, m.flex_vertbodyid[v] as usize);
    while dof >= 0 {
        dofs.insert(dof);
        dof = m.dof_parentid[dof as usize];
    }
}

fn edge_columns(m: &Arrays, f: usize, e: usize) -> BTreeSet<i32> {
    let mut dofs = BTreeSet::new();
    ends(m, f, e).into_iter().for_each(|v| add_chain(m, v, &mut dofs));
    dofs
}

/// Edges around each vertex of a flex, in increasing order, counted within it.
fn around(m: &Arrays, f: usize) -> Vec<Vec<i32>> {
    let mut around = vec![Vec::new(); m.flex_vertnum[f] as usize];
    for (e, ends) in m.flex_edge[edges(m, f)].iter().enumerate() {
        ends.iter().for_each(|&v| around[v as usize].push(e as i32));
    }
    around
}

fn star_columns(m: &Arrays, f: usize, star: &[i32]) -> BTreeSet<i32> {
    let first = m.flex_edgeadr[f] as usize;
    let mut dofs = BTreeSet::new();
    for &e in star {
        ends(m, f, first + e as usize).into_iter().for_each(|v| add_chain(m, v, &mut dofs));
    }
    dofs
}

/// Sets `nJfe` and `nJfv`: room for the rows of all edges and vertices that move on their own.
pub fn set_sizes(m: &mut Arrays) {
    let (mut edge_entries, mut vertex_entries) = (0, 0);
    for f in (0..m.nflex).filter(|&f| has_edges(m, f)) {
        edge_entries += edges(m, f).map(|e| edge_columns(m, f, e).len()).sum::<usize>();
        for (v, star) in vertices(m, f).zip(around(m, f)) {
            let mut dofs = star_columns(m, f, &star);
            add_chain(m, v, &mut dofs);
            vertex_entries += dofs.len();
        }
    }
    (m.nJfe, m.nJfv) = (edge_entries, vertex_entries);
}

/// The patterns of both Jacobians, and the edges around the vertices that constraints hold.
#[derive(Default, PartialEq)]
pub(crate) struct Patterns {
    pub edge_count: Vec<i32>,
    pub edge_address: Vec<i32>,
    pub edge_column: Vec<i32>,
    pub vertex_count: Vec<[i32; 2]>,
    pub vertex_address: Vec<[i32; 2]>,
    pub vertex_column: Vec<[i32; 2]>,
    pub star_count: Vec<i32>,
    pub star_address: Vec<i32>,
    pub star: Vec<[i32; 2]>,
}

impl Patterns {
    /// What follows from trees, edges and what is held. Rows of a flex follow the rows of the flex before it; if that flex
    /// has no rows, they begin at zero, as in MuJoCo.
    pub fn of(m: &Arrays) -> Self {
        let mut p = Patterns {
            edge_count: vec![0; m.nflexedge],
            edge_address: vec![0; m.nflexedge],
            edge_column: vec![0; m.nJfe],
            vertex_count: vec![[0; 2]; m.nflexvert],
            vertex_address: vec![[0; 2]; m.nflexvert],
            vertex_column: vec![[0; 2]; m.nJfv],
            star_count: vec![0; m.nflexvert],
            star_address: vec![0; m.nflexvert],
            star: vec![[0; 2]; m.nflexedge],
        };
        let mut listed = 0;
        for f in (0..m.nflex).filter(|&f| has_edges(m, f)) {
            if m.flex_edgeequality[f] != 0 || has_springs(m, f) {
                edges(m, f).for_each(|e| p.edge_row(m, f, e));
            }
            if holds_vertices(m, f) {
                let stars = around(m, f);
                for (v, star) in vertices(m, f).zip(&stars) {
                    (p.star_address[v], p.star_count[v]) = (listed as i32, star.len() as i32);
                    p.star.as_flattened_mut()[listed..listed + star.len()].copy_from_slice(star);
                    listed += star.len();
                }
                p.vertex_rows(m, f, &stars);
            }
        }
        p
    }

    fn edge_row(&mut self, m: &Arrays, f: usize, e: usize) {
        if e > 0 {
            self.edge_address[e] = self.edge_address[e - 1] + self.edge_count[e - 1];
        }
        let columns = edge_columns(m, f, e);
        self.edge_count[e] = columns.len() as i32;
        let row = &mut self.edge_column[self.edge_address[e] as usize..];
        row.iter_mut().zip(columns).for_each(|(to, dof)| *to = dof);
    }

    fn vertex_rows(&mut self, m: &Arrays, f: usize, stars: &[Vec<i32>]) {
        let first = vertices(m, f).start;
        let address = self.vertex_address.as_flattened_mut();
        let count = self.vertex_count.as_flattened_mut();
        let column = self.vertex_column.as_flattened_mut();
        address[2 * first] = if first > 0 { address[2 * first - 1] + count[2 * first - 1] } else { 0 };
        for (v, star) in vertices(m, f).zip(stars) {
            let columns = star_columns(m, f, star);
            for row in [2 * v, 2 * v + 1] {
                count[row] = columns.len() as i32;
                let place = &mut column[address[row] as usize..];
                place.iter_mut().zip(&columns).for_each(|(to, &dof)| *to = dof);
                if let Some(next) = address.get(row).copied().zip(address.get_mut(row + 1)) {
                    *next.1 = next.0 + columns.len() as i32;
                }
            }
        }
    }

    /// Whether the model has these patterns.
    pub fn is_in(&self, m: &Arrays) -> bool {
        self.edge_count == *m.flexedge_J_rownnz
            && self.edge_address == *m.flexedge_J_rowadr
            && self.edge_column == *m.flexedge_J_colind
            && self.vertex_count == *m.flexvert_J_rownnz
            && self.vertex_address == *m.flexvert_J_rowadr
            && self.vertex_column == *m.flexvert_J_colind
            && self.star_count == *m.flex_vertedgenum
            && self.star_address == *m.flex_vertedgeadr
            && self.star == *m.flex_vertedge
    }

    /// Puts the patterns into the model.
    pub(super) fn store(&self, m: &mut Arrays) {
        m.flexedge_J_rownnz.update(&self.edge_count);
        m.flexedge_J_rowadr.update(&self.edge_address);
        m.flexedge_J_colind.update(&self.edge_column);
        m.flexvert_J_rownnz.update(&self.vertex_count);
        m.flexvert_J_rowadr.update(&self.vertex_address);
        m.flexvert_J_colind.update(&self.vertex_column);
        m.flex_vertedgenum.update(&self.star_count);
        m.flex_vertedgeadr.update(&self.star_address);
        m.flex_vertedge.update(&self.star);
    }
}

/// Some force acts along edges.
pub(super) fn has_springs(m: &Arrays, f: usize) -> bool {
    [m.flex_edgedamping[f], m.flex_edgestiffness[f], m.flex_damping[f]].iter().any(|&x| x != 0.0)
}

/// Vertices that a body of three degrees of freedom carries, of all flexes whose bending has a constant factor.
pub(super) fn bending_vertices(m: &Arrays) -> Vec<(usize, usize)> {
    let bends = |&f: &usize| has_edges(m, f) && m.flex_dim[f] == 2 && m.flex_bendingadr[f] >= 0;
    let free = |&(_, v): &(usize, usize)| m.body_dofnum[m.flex_vertbodyid[v] as usize] == 3;
    (0..m.nflex).filter(bends).flat_map(|f| vertices(m, f).map(move |v| (f, v))).filter(free).collect()
}

/// Sets the patterns of the Jacobians.
pub(super) fn set(m: &mut Model) {
    if m.nflex > 0 {
        let patterns = Patterns::of(m);
        patterns.store(m.derived_mut());
    }
}
