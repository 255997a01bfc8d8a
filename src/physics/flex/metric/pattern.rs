//! Which points of flexes have stiffness, and which of them are coupled. A point is a vertex or node that moves freely.

use super::stiffened::{has_soft_contacts, is_elastic, is_elastic_lattice};
use super::touch::{Touch, Touches};
use crate::flex::bending::STENCIL;
use crate::flex::lattice::Lattice;
use crate::model::Model;
use crate::model::flex::Flex;
use crate::stages::Contacts;

/// The point of what is held or has no stiffness.
pub(super) const NONE: u32 = u32::MAX;

/// Points, and the blocks of the matrix that couple them.
#[derive(Clone, Debug, Default)]
pub(super) struct Pattern {
    /// First degree of freedom of each point.
    pub dof: Vec<u32>,
    /// Body of each point.
    pub body: Vec<u32>,
    /// Point of each first degree of freedom.
    of_dof: Vec<u32>,
    /// Cells of lattices are part of it.
    pub has_cells: bool,
    /// Coupled points: point, and first degree of freedom of its neighbour; in any order, and more than once.
    pairs: Vec<[u32; 2]>,
    /// The neighbours in `pairs`, by point, and where the neighbours of each point begin.
    neighbours: Vec<u32>,
    first_neighbour: Vec<usize>,
    /// The last point that each degree of freedom was found to be a neighbour of.
    seen: Vec<u32>,
    /// First block of each point, and one past the last.
    pub start: Vec<usize>,
    /// Columns of each block.
    pub columns: Vec<[i32; 3]>,
}

impl Pattern {
    /// Finds the points and what is coupled; nothing where bending is all there is, whose stiffness is constant.
    pub fn find(&mut self, m: &Model, touches: &Touches, con: &Contacts) {
        self.has_cells = Flex::all(m).filter(|flex| is_elastic_lattice(*flex)).all(nodes_slide);
        let needed = |flex: Flex| {
            is_elastic_lattice(flex) && self.has_cells
                || flex.has_edges()
                    && flex.dim() > 1
                    && (flex.stiffness().is_some() || has_soft_contacts(flex))
        };
        let is_needed = Flex::all(m).any(needed);
        self.pairs.clear();
        self.dof.clear();
        self.body.clear();
        if is_needed {
            self.find_points(m);
            self.find_pairs(m, touches, con);
        }
        self.index(m.nv);
    }

    /// Numbers the points.
    fn find_points(&mut self, m: &Model) {
        self.of_dof.clear();
        self.of_dof.resize(m.nv, NONE);
        for flex in Flex::all(m) {
            let bodies = if is_elastic_lattice(flex) && self.has_cells {
                flex.node_bodies()
            } else if flex.has_edges() && flex.dim() > 1 && (is_elastic(flex) || has_soft_contacts(flex)) {
                flex.vertex_bodies()
            } else {
                continue;
            };
            for &body in bodies {
                let Some(dof) = free_dof(m, body) else { continue };
                if self.of_dof[dof] == NONE {
                    self.of_dof[dof] = self.dof.len() as u32;
                    self.dof.push(dof as u32);
                    self.body.push(body as u32);
                }
            }
        }
    }

    /// The point of a body, if it has one.
    pub fn point(&self, m: &Model, body: i32) -> u32 {
        free_dof(m, body).map_or(NONE, |dof| self.of_dof[dof])
    }

    /// Couples points with each other and themselves.
    fn couple(&mut self, points: &[u32]) {
        for &a in points.iter().filter(|&&a| a != NONE) {
            for &b in points.iter().filter(|&&b| b != NONE) {
                self.pairs.push([a, self.dof[b as usize]]);
            }
        }
    }

    fn find_pairs(&mut self, m: &Model, touches: &Touches, con: &Contacts) {
        for flex in sheets_and_solids(m) {
            let bodies = flex.vertex_bodies();
            for (corners, _) in bent_edges(flex) {
                self.couple(&corners.map(|v| self.point(m, bodies[v])));
            }
            if flex.stiffness().is_some() {
                for element in flex.corners().chunks_exact(flex.dim() + 1) {
                    let (points, count) = self.corner_points(flex, element);
                    self.couple(&points[..count]);
                }
            }
        }
        if self.has_cells {
            for flex in Flex::all(m).filter(|flex| is_elastic_lattice(*flex)) {
                let (lattice, bodies) = (Lattice::new(flex), flex.node_bodies());
                for patch in (0..lattice.patches()).map(|cell| lattice.patch(cell)) {
                    for &a in patch.nodes() {
                        for &b in patch.nodes() {
                            let (a, b) = (self.point(m, bodies[a]), self.point(m, bodies[b]));
                            if a != NONE && b != NONE {
                                self.pairs.push([a, self.dof[b as usize]]);
                            }
                        }
                    }
                }
            }
        }
        for touch in touches.all() {
            let (points, count) = self.touched(m, touch, con);
            self.couple(&points[..count]);
        }
    }

    /// Points of the vertices of an element.
    pub fn corner_points(&self, flex: Flex, element: &[i32]) -> ([u32; 4], usize) {
        let mut points = [NONE; 4];
        for (point, &v) in points.iter_mut().zip(element) {
            *point = self.point(flex.m, flex.vertex_bodies()[v as usize]);
        }
        (points, element.len())
    }

    /// Points of a contact, each once.
    pub fn touched(&self, m: &Model, touch: &Touch, con: &Contacts) -> ([u32; 8], usize) {
        let (mut points, mut count) = ([NONE; 8], 0);
        touch.for_vertices(m, con, |body| {
            let point = self.point(m, body);
            if point != NONE && count < points.len() && !points[..count].contains(&point) {
                points[count] = point;
                count += 1;
            }
        });
        (points, count)
    }

    /// Sorts the pairs into blocks.
    fn index(&mut self, dofs: usize) {
        self.sort_by_point();
        self.seen.clear();
        self.seen.resize(dofs, NONE);
        self.start.clear();
        self.columns.clear();
        for point in 0..self.dof.len() {
            let first = self.columns.len();
            self.start.push(first);
            let own = self.first_neighbour[point]..self.first_neighbour[point + 1];
            for &dof in &self.neighbours[own] {
                let seen = &mut self.seen[dof as usize];
                if *seen != point as u32 {
                    *seen = point as u32;
                    let dof = dof as i32;
                    self.columns.push([dof, dof + 1, dof + 2]);
                }
            }
            self.columns[first..].sort_unstable_by_key(|columns| columns[0]);
        }
        self.start.push(self.columns.len());
    }

    /// Puts the neighbours of each point together.
    fn sort_by_point(&mut self) {
        let Pattern { pairs, neighbours, first_neighbour, dof, .. } = self;
        first_neighbour.clear();
        first_neighbour.resize(dof.len() + 2, 0);
        pairs.iter().for_each(|&[point, _]| first_neighbour[point as usize + 2] += 1);
        (2..first_neighbour.len()).for_each(|k| first_neighbour[k] += first_neighbour[k - 1]);
        neighbours.clear();
        neighbours.resize(pairs.len(), 0);
        for &[point, dof] in pairs.iter() {
            let next = &mut first_neighbour[point as usize + 1];
            neighbours[*next] = dof;
            *next += 1;
        }
    }

    /// Where the block of two points is: its first number, and the distance of its rows.
    pub fn place(&self, a: u32, b: u32) -> (usize, usize) {
        let (a, dof) = (a as usize, self.dof[b as usize] as i32);
        let (first, end) = (self.start[a], self.start[a + 1]);
        let at = self.columns[first..end].partition_point(|columns| columns[0] < dof);
        (9 * first + 3 * at, 3 * (end - first))
    }

    /// Points in the matrix: first degree of freedom, and their blocks.
    pub fn rows(&self) -> impl Iterator<Item = (usize, std::ops::Range<usize>)> {
        self.dof.iter().zip(self.start.windows(2)).map(|(&dof, ends)| (dof as usize, ends[0]..ends[1]))
    }
}

/// Flexes of triangles and tetrahedra that resist deformation.
pub(super) fn sheets_and_solids(m: &Model) -> impl Iterator<Item = Flex<'_>> {
    Flex::all(m).filter(|flex| flex.has_edges() && flex.dim() > 1 && is_elastic(*flex))
}

/// All nodes are fixed, or do nothing but slide along three axes.
fn nodes_slide(flex: Flex) -> bool {
    let m = flex.m;
    flex.node_bodies()
        .iter()
        .map(|&b| b as usize)
        .all(|body| m.body_dofnum[body] == 0 || m.body_simple[body] == 2 && m.body_dofnum[body] == 3)
}

/// First degree of freedom of a body with three.
fn free_dof(m: &Model, body: i32) -> Option<usize> {
    let body = usize::try_from(body).ok().filter(|&body| m.body_dofnum[body] == 3)?;
    usize::try_from(m.body_dofadr[body]).ok()
}

/// Edges with a triangle on both sides: the four vertices, and the stencil.
pub(super) fn bent_edges<'a>(flex: Flex<'a>) -> impl Iterator<Item = ([usize; 4], &'a [f64])> {
    let m = flex.m;
    let first = flex.bending().filter(|_| flex.dim() == 2);
    let stencils = first.map_or(&[][..], |first| &m.flex_bending[first..]).chunks_exact(STENCIL);
    flex.edges().zip(stencils).filter(move |&(e, _)| m.flex_edgeflap[e][1] != -1).map(move |(e, stencil)| {
        let ([a, b], [c, d]) = (m.flex_edge[e], m.flex_edgeflap[e]);
        ([a, b, c, d].map(|v| v as usize), stencil)
    })
}
