//! Strain at the vertices of a sheet, for constraints that let it bend without stretching (Chen, Kry and Vouga,
//! Locking-free Simulation of Isometric Thin Plates, 2019): the first two invariants of the Cauchy–Green tensor, fitted
//! to the edges around a vertex.

use crate::math::{Vec3, dot, scale, sub};
use crate::model::Model;
use crate::model::bounds::MINVAL;
use crate::model::flex::{Flex, held, range};
use crate::position::chain::{chain, com_offset, point_column};
use crate::stages::{Com, Flexes};

/// A matrix of three rows and two columns.
type Tall = [f64; 6];

/// Computes `flexvert_length` and `flexvert_J`; `rows` is working memory.
pub(super) fn isometry(m: &Model, com: &Com, out: &mut Flexes, rows: &mut [Vec<f64>; 2]) {
    out.flexvert_J.as_flattened_mut().fill(0.0);
    out.flexvert_length.as_flattened_mut().fill(0.0);
    let constrained = |f: &Flex| f.has_edges() && f.dim() == 2 && m.flex_edgeequality[f.id] == held::VERTICES;
    for flex in Flex::all(m).filter(constrained) {
        for row in rows.iter_mut() {
            row.clear();
            row.resize(m.nv, 0.0);
        }
        for v in flex.vertices() {
            vertex(Star { flex, v }, com, out, rows);
        }
    }
}

/// A vertex with the edges around it.
#[derive(Clone, Copy)]
struct Star<'a> {
    flex: Flex<'a>,
    v: usize,
}

/// An edge of a star.
struct Spoke {
    /// Global indices of its vertices.
    ends: [usize; 2],
    /// Where it leads at rest, in the plane of the sheet.
    rest: [f64; 2],
    /// Mass of the vertex at the other end.
    weight: f64,
}

impl<'a> Star<'a> {
    fn spokes(self) -> impl Iterator<Item = Spoke> + use<'a> {
        let Star { flex, v } = self;
        let m = flex.m;
        let (first, size) = (flex.vertices().start, m.flex_size[flex.id]);
        let edges = &m.flex_vertedge.as_flattened()[range(m.flex_vertedgeadr[v], m.flex_vertedgenum[v])];
        edges.iter().map(move |&e| {
            let ends = m.flex_edge[flex.edges().start + e as usize].map(|k| first + k as usize);
            let rest = sub(m.flex_vert0[ends[1]], m.flex_vert0[ends[0]]);
            let rest = [0, 1].map(|k| rest[k] * (2.0 * size[k]));
            let other = if v == ends[0] { ends[1] } else { ends[0] };
            let weight = usize::try_from(m.flex_vertbodyid[other])
                .map_or(1.0, |b| if m.body_mass[b] < MINVAL { MINVAL } else { m.body_mass[b] });
            Spoke { ends, rest, weight }
        })
    }

    /// Square root of the vertex's mass, which evens out the constraints.
    fn scale(self) -> f64 {
        let mass = usize::try_from(self.flex.m.flex_vertbodyid[self.v]).map(|b| self.flex.m.body_mass[b]);
        mass.ok().filter(|&mass| mass > MINVAL).map_or(1.0, f64::sqrt)
    }
}

/// Product with a 2x2 matrix.
fn mul(a: &Tall, b: &[f64; 4]) -> Tall {
    std::array::from_fn(|k| {
        let (r, c) = (k / 2 * 2, k % 2);
        a[r] * b[c] + a[r + 1] * b[c + 2]
    })
}

fn mul_vec(a: &Tall, b: [f64; 2]) -> Vec3 {
    std::array::from_fn(|r| a[2 * r] * b[0] + a[2 * r + 1] * b[1])
}

/// `aᵀ a`.
fn gram(a: &Tall) -> [f64; 4] {
    std::array::from_fn(|k| {
        let (i, j) = (k / 2, k % 2);
        a[i] * a[j] + a[2 + i] * a[2 + j] + a[4 + i] * a[4 + j]
    })
}

fn vertex(star: Star, com: &Com, out: &mut Flexes, rows: &mut [Vec<f64>; 2]) {
    let (m, v) = (star.flex.m, star.v);
    let mut shape: Tall = [0.0; 6];
    for spoke in star.spokes() {
        let now = sub(out.flexvert_xpos[spoke.ends[1]], out.flexvert_xpos[spoke.ends[0]]);
        for (k, sum) in shape.iter_mut().enumerate() {
            *sum += spoke.weight * now[k / 2] * spoke.rest[k % 2];
        }
    }
    let metric = &m.flex_vertmetric[v];
    let gradient = mul(&shape, metric);
    let [c00, c01, c10, c11] = gram(&gradient);
    let scale = star.scale();
    out.flexvert_length[v] = [(c00 + c11 - 2.0) * scale, (c00 * c11 - c01 * c10 - 1.0) * scale];

    let slopes = [mul(&gradient, metric), mul(&mul(&gradient, &[c11, -c01, -c10, c00]), metric)];
    for spoke in star.spokes() {
        for (row, slope) in rows.iter_mut().zip(&slopes) {
            pull(m, com, &spoke, slope, &out.flexvert_xpos, row);
        }
    }
    for (k, row) in rows.iter_mut().enumerate() {
        let at = range(m.flexvert_J_rowadr[v][k], m.flexvert_J_rownnz[v][k]);
        let columns = &m.flexvert_J_colind.as_flattened()[at.clone()];
        for (entry, &column) in out.flexvert_J.as_flattened_mut()[at].iter_mut().zip(columns) {
            *entry += std::mem::take(&mut row[column as usize]) * scale;
        }
    }
}

/// Adds to a full row how both ends of a spoke change the invariant with the given slope.
fn pull(m: &Model, com: &Com, spoke: &Spoke, slope: &Tall, points: &[Vec3], row: &mut [f64]) {
    let first = scale(mul_vec(slope, spoke.rest), -2.0 * spoke.weight);
    for (v, direction) in spoke.ends.into_iter().zip([first, scale(first, -1.0)]) {
        let body = m.flex_vertbodyid[v] as usize;
        let offset = com_offset(m, com, body, points[v]);
        for dof in chain(m, body) {
            row[dof] += dot(direction, point_column(com, dof, offset));
        }
    }
}
