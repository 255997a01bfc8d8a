//! The stiffness of flexes as a sparse matrix of blocks: 3 by 3 numbers for each pair of points that an element, a bent
//! edge, a cell or a soft contact couples.

use super::pattern::{NONE, Pattern, bent_edges, sheets_and_solids};
use super::stiffened::{cell_stiffness, is_elastic_lattice};
use super::touch::{Touch, Touches};
use crate::flex::lattice::Lattice;
use crate::flex::stretch::{METRIC, TETRAHEDRON, TRIANGLE, unpack};
use crate::inertia;
use crate::math::{Mat3, Vec3, dot_sparse, mul_mat, mul_mat_t_mat, sub};
use crate::model::Model;
use crate::model::bounds::MINVAL;
use crate::model::flex::Flex;
use crate::stages::{Contacts, Flexes, Inertia, Kinematics};

/// The matrix; rows of a point share their columns.
#[derive(Clone, Debug, Default)]
pub(super) struct Matrix {
    pattern: Pattern,
    /// Rows of each point, one after the other.
    values: Vec<f64>,
    /// Cholesky factors of the diagonal blocks of the inertia with stiffness.
    factors: Vec<Mat3>,
}

impl Matrix {
    /// Nothing is in it.
    pub fn is_empty(&self) -> bool {
        self.pattern.columns.is_empty()
    }

    /// Cells of lattices are part of it.
    pub fn has_cells(&self) -> bool {
        self.pattern.has_cells
    }

    /// Computes the matrix; empty where bending is all there is, whose stiffness is constant.
    pub fn assemble(
        &mut self,
        m: &Model,
        kin: &Kinematics,
        flexes: &Flexes,
        touches: &Touches,
        con: &Contacts,
    ) {
        self.pattern.find(m, touches, con);
        self.values.clear();
        self.values.resize(9 * self.pattern.columns.len(), 0.0);
        if self.is_empty() {
            return;
        }
        let h = m.opt.timestep;
        for flex in sheets_and_solids(m) {
            let scale = h * h + h * m.flex_damping[flex.id];
            if scale != 0.0 {
                self.add_bending(flex, scale);
                match flex.dim() {
                    2 => self.add_elements(flex, &TRIANGLE, scale, kin, flexes),
                    _ => self.add_elements(flex, &TETRAHEDRON, scale, kin, flexes),
                }
            }
        }
        if self.pattern.has_cells {
            for flex in Flex::all(m).filter(|flex| is_elastic_lattice(*flex)) {
                self.add_cells(flex, -(h * h + h * m.flex_damping[flex.id]), kin, flexes);
            }
        }
        for touch in touches.all() {
            self.add_touch(m, touch, touches, con, h * h);
        }
    }

    fn add_block(&mut self, a: u32, b: u32, block: &Mat3) {
        let (first, stride) = self.pattern.place(a, b);
        for r in 0..3 {
            (0..3).for_each(|c| self.values[first + r * stride + c] += block[3 * r + c]);
        }
    }

    fn add_bending(&mut self, flex: Flex, scale: f64) {
        let bodies = flex.vertex_bodies();
        for (corners, stencil) in bent_edges(flex) {
            let points = corners.map(|v| self.pattern.point(flex.m, bodies[v]));
            for (i, &a) in points.iter().enumerate() {
                for (j, &b) in points.iter().enumerate() {
                    let share = scale * stencil[4 * i + j];
                    if a != NONE && b != NONE && share != 0.0 {
                        let (first, stride) = self.pattern.place(a, b);
                        (0..3).for_each(|k| self.values[first + k * (stride + 1)] += share);
                    }
                }
            }
        }
    }

    /// Adds the stiffness of elements whose edges have the given ends: of the material, and of its tension, as far as that
    /// pulls.
    fn add_elements<const E: usize>(
        &mut self,
        flex: Flex,
        ends: &[[usize; 2]; E],
        scale: f64,
        kin: &Kinematics,
        flexes: &Flexes,
    ) {
        let m = flex.m;
        let Some(first) = flex.stiffness() else { return };
        let points = &flexes.flexvert_xpos[flex.vertices()];
        let edges = &m.flex_elemedge[m.flex_elemedgeadr[flex.id].max(0) as usize..];
        let corners = flex.corners().chunks_exact(flex.dim() + 1);
        let metrics = m.flex_stiffness[first..].chunks_exact(METRIC);
        for ((corners, edges), packed) in corners.zip(edges.chunks_exact(E)).zip(metrics) {
            let metric: [[f64; E]; E] = unpack(packed);
            let span = ends.map(|[a, b]| sub(points[corners[a] as usize], points[corners[b] as usize]));
            let tension = tension(flex, flexes, edges, &metric);
            let (own, count) = self.pattern.corner_points(flex, corners);
            for (i, &a) in own[..count].iter().enumerate() {
                for (j, &b) in own[..count].iter().enumerate() {
                    if a == NONE || b == NONE {
                        continue;
                    }
                    let block = element_block([i, j], ends, scale, &metric, (&span, &tension));
                    let turned = self.turned([a, b], &block, kin);
                    self.add_block(a, b, &turned);
                }
            }
        }
    }

    /// A block in the axes of the bodies of two points.
    fn turned(&self, [a, b]: [u32; 2], block: &Mat3, kin: &Kinematics) -> Mat3 {
        let [ra, rb] = [a, b].map(|p| &kin.xmat[self.pattern.body[p as usize] as usize]);
        if *ra == UPRIGHT && *rb == UPRIGHT { *block } else { mul_mat_t_mat(ra, &mul_mat(block, rb)) }
    }

    fn add_cells(&mut self, flex: Flex, scale: f64, kin: &Kinematics, flexes: &Flexes) {
        let m = flex.m;
        let Some(first) = flex.stiffness().filter(|_| scale != 0.0) else { return };
        let (lattice, bodies) = (Lattice::new(flex), flex.node_bodies());
        for cell in 0..lattice.patches() {
            let patch = lattice.patch(cell);
            let size = 3 * patch.nodes().len();
            let at = cell_stiffness(first, cell, size);
            if m.flex_stiffness[at.start] == 0.0 {
                continue;
            }
            let stiffness = &flexes.flexelem_krot[at];
            for (i, &a) in patch.nodes().iter().enumerate() {
                for (j, &b) in patch.nodes().iter().enumerate() {
                    let (a, b) = (self.pattern.point(m, bodies[a]), self.pattern.point(m, bodies[b]));
                    if a != NONE && b != NONE {
                        let entry = |k: usize| scale * stiffness[(3 * i + k / 3) * size + 3 * j + k % 3];
                        let turned = self.turned([a, b], &std::array::from_fn(entry), kin);
                        self.add_block(a, b, &turned);
                    }
                }
            }
        }
    }

    fn add_touch(&mut self, m: &Model, touch: &Touch, touches: &Touches, con: &Contacts, scale: f64) {
        let (points, count) = self.pattern.touched(m, touch, con);
        let stiffness = scale * touch.stiffness;
        let normal = |p: u32| -> Vec3 {
            let dof = self.pattern.dof[p as usize] as i32;
            touches.normal(touch, dof)
        };
        let normals: [Vec3; 8] =
            std::array::from_fn(|k| if k < count { normal(points[k]) } else { [0.0; 3] });
        for (&a, na) in points[..count].iter().zip(&normals) {
            for (&b, nb) in points[..count].iter().zip(&normals) {
                let (first, stride) = self.pattern.place(a, b);
                for r in 0..3 {
                    for c in 0..3 {
                        self.values[first + r * stride + c] += stiffness * na[r] * nb[c];
                    }
                }
            }
        }
    }

    /// Factors the diagonal block of each point, with its inertia.
    pub fn factor_blocks(&mut self, m: &Model, inertia: &Inertia) {
        self.factors.clear();
        if self.is_empty() {
            return;
        }
        for p in 0..self.pattern.dof.len() {
            let (dof, blocks) =
                (self.pattern.dof[p] as usize, self.pattern.start[p]..self.pattern.start[p + 1]);
            let mut block = [0.0; 9];
            for r in 0..3 {
                for k in inertia::row(m, dof + r) {
                    let c = m.M_colind[k] as usize;
                    if (dof..dof + 3).contains(&c) {
                        block[3 * r + c - dof] += inertia.M[k];
                    }
                }
            }
            if !blocks.is_empty() {
                let (first, stride) = self.pattern.place(p as u32, p as u32);
                for r in 0..3 {
                    (0..3).for_each(|c| block[3 * r + c] += self.values[first + r * stride + c]);
                }
            }
            self.factors.push(factor(&block));
        }
    }

    /// Adds the matrix times `v` to `out`.
    pub fn add_product(&self, v: &[f64], out: &mut [f64]) {
        let mut gathered = [0.0; GATHERED];
        for (dof, blocks) in self.pattern.rows() {
            let (columns, width) = (&self.pattern.columns[blocks.clone()], 3 * blocks.len());
            if width == 0 {
                continue;
            }
            let rows = self.values[9 * blocks.start..9 * blocks.end].chunks_exact(width);
            if width > GATHERED {
                for (r, row) in rows.enumerate() {
                    out[dof + r] += dot_sparse(row, columns.as_flattened(), v);
                }
                continue;
            }
            // The three rows of a point meet the same entries of `v`.
            for (to, columns) in gathered.as_chunks_mut::<3>().0.iter_mut().zip(columns) {
                let first = columns[0] as usize;
                to.copy_from_slice(&v[first..first + 3]);
            }
            for (r, row) in rows.enumerate() {
                out[dof + r] += dot_lanes(row, &gathered[..width]);
            }
        }
    }

    /// Zeroes what the blocks of points stand for.
    pub fn clear_points(&self, x: &mut [f64]) {
        self.pattern
            .rows()
            .filter(|(_, blocks)| !blocks.is_empty())
            .for_each(|(dof, _)| x[dof..dof + 3].fill(0.0));
    }

    /// Solves with the factors of the points' blocks.
    pub fn solve_blocks(&self, b: &[f64], x: &mut [f64]) {
        for ((dof, blocks), l) in self.pattern.rows().zip(&self.factors) {
            if !blocks.is_empty() {
                x[dof..dof + 3].copy_from_slice(&solve(l, [b[dof], b[dof + 1], b[dof + 2]]));
            }
        }
    }
}

/// Entries of a vector that a product keeps at hand.
const GATHERED: usize = 192;

/// Inner product, in the order of [`dot_sparse`].
fn dot_lanes(a: &[f64], b: &[f64]) -> f64 {
    let ((a4, a_rest), (b4, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut lane = [0.0; 4];
    for (a, b) in a4.iter().zip(b4) {
        (0..4).for_each(|i| lane[i] += a[i] * b[i]);
    }
    let sum = (lane[0] + lane[2]) + (lane[1] + lane[3]);
    a_rest.iter().zip(b_rest).fold(sum, |sum, (a, b)| sum + a * b)
}

const UPRIGHT: Mat3 = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// How strongly each edge of an element pulls, zero where it pushes.
pub(super) fn tension<const E: usize>(
    flex: Flex,
    flexes: &Flexes,
    edges: &[i32],
    metric: &[[f64; E]; E],
) -> [f64; E] {
    let own = flex.edges();
    let (now, rest) = (&flexes.flexedge_length[own.clone()], &flex.m.flexedge_length0[own]);
    std::array::from_fn(|a| {
        let stretch = |e: usize| now[e] * now[e] - rest[e] * rest[e];
        let terms = metric[a].iter().zip(edges).map(|(share, &e)| share * stretch(e as usize));
        terms.fold(0.0, |sum, term| sum + term).max(0.0)
    })
}

/// Sign of vertex `v` in an edge: 1 where the edge begins, -1 where it ends.
fn sign(v: usize, [begin, end]: [usize; 2]) -> f64 {
    f64::from(i8::from(v == begin) - i8::from(v != begin && v == end))
}

/// Stiffness between vertices `i` and `j` of an element.
fn element_block<const E: usize>(
    [i, j]: [usize; 2],
    ends: &[[usize; 2]; E],
    scale: f64,
    metric: &[[f64; E]; E],
    (span, tension): (&[Vec3; E], &[f64; E]),
) -> Mat3 {
    let (mut block, mut pull) = ([0.0; 9], 0.0);
    for a in 0..E {
        let sa = sign(i, ends[a]);
        if sa == 0.0 {
            continue;
        }
        for b in 0..E {
            let sb = sign(j, ends[b]);
            if sb == 0.0 {
                continue;
            }
            let weight = 2.0 * scale * metric[a][b] * sa * sb;
            for r in 0..3 {
                let row = weight * span[a][r];
                (0..3).for_each(|c| block[3 * r + c] += row * span[b][c]);
            }
        }
        let sb = sign(j, ends[a]);
        if sb != 0.0 {
            pull += tension[a] * sa * sb;
        }
    }
    (0..3).for_each(|k| block[4 * k] += pull * scale);
    block
}

/// Cholesky factor of a symmetric matrix; only its lower triangle is read.
fn factor(a: &Mat3) -> Mat3 {
    let mut l = [0.0; 9];
    for j in 0..3 {
        let before = |i: usize| (0..j).fold(0.0, |sum, k| sum + l[3 * i + k] * l[3 * j + k]);
        let pivot = a[4 * j] - before(j);
        let root = if pivot < MINVAL { MINVAL } else { pivot }.sqrt();
        let inverse = 1.0 / root;
        let below: [f64; 3] = std::array::from_fn(|i| (a[3 * i + j] - before(i)) * inverse);
        l[4 * j] = root;
        if pivot >= MINVAL {
            (j + 1..3).for_each(|i| l[3 * i + j] = below[i]);
        }
    }
    l
}

fn solve(l: &Mat3, b: Vec3) -> Vec3 {
    let x0 = b[0] / l[0];
    let x1 = (b[1] - l[3] * x0) / l[4];
    let x2 = (b[2] - (l[6] * x0 + l[7] * x1)) / l[8];
    let z = x2 / l[8];
    let y = (x1 - l[7] * z) / l[4];
    [(x0 - l[3] * y - l[6] * z) / l[0], y, z]
}
