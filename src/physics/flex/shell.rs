//! Bending of shells: the normals of two faces that share an edge keep the difference that they have at rest, seen in
//! a frame that turns with both.

use super::lattice::{Lattice, MAX_NODES, Patch};
use super::scratch::FlexScratch;
use super::stretch::Inputs;
use super::{cells, vertices};
use crate::math::dense::dot_slice;
use crate::math::{Quat, Vec3, cross, dot, norm, quat_conj, quat_rotate, scale, sub};
use crate::model::bounds::MINVAL;
use crate::model::flex::Flex;
use crate::stages::Passive;

/// Numbers of an edge in `flex_bending` of a shell, after the number of edges: two faces, a point of each, stiffness, and
/// the difference of the normals at rest.
const EDGE: usize = 10;

/// A face with the positions of its nodes.
struct Placed<'a> {
    patch: &'a Patch,
    points: [Vec3; MAX_NODES],
    local: [f64; 2],
}

/// Unit normal of a face, its length before, and the tangents it is the product of.
struct Normal {
    unit: Vec3,
    inverse: f64,
    tangents: [Vec3; 2],
}

impl Placed<'_> {
    fn new<'a>(patch: &'a Patch, nodes: &[Vec3], local: [f64; 2]) -> Placed<'a> {
        let mut points = [[0.0; 3]; MAX_NODES];
        for (point, &n) in points.iter_mut().zip(patch.nodes()) {
            *point = nodes[n];
        }
        Placed { patch, points, local }
    }

    fn points(&self) -> &[Vec3] {
        &self.points[..self.patch.nodes().len()]
    }

    /// `None` for a face without area.
    fn normal(&self) -> Option<Normal> {
        let tangents = self.patch.tangents(self.points(), self.local);
        let product = cross(tangents[0], tangents[1]);
        let length = norm(product);
        let inverse = 1.0 / length;
        (length >= MINVAL).then(|| Normal { unit: scale(product, inverse), inverse, tangents })
    }

    /// Adds the forces that turn the normal towards `-residual`.
    fn push(&self, normal: &Normal, residual: Vec3, stiffness: f64, sign: f64, force: &mut [Vec3]) {
        let along = dot(normal.unit, residual);
        let across = [0, 1, 2].map(|x| (residual[x] - normal.unit[x] * along) * normal.inverse);
        let [first, second] = normal.tangents.map(|tangent| cross(across, tangent));
        for (&n, [a, b]) in self.patch.nodes().iter().zip(self.patch.face_slopes(self.local)) {
            for x in 0..3 {
                force[n][x] += sign * (stiffness * (a * second[x] - b * first[x]));
            }
        }
    }
}

/// Adds the forces of the bent edges of a shell.
pub(crate) fn shell(flex: Flex, at: Inputs, springs: bool, scratch: &mut FlexScratch, out: &mut Passive) {
    let (m, lattice) = (flex.m, Lattice::new(flex));
    let Some(first) = flex.bending().filter(|_| lattice.is_shell && springs) else { return };
    let edges = m.flex_bending[first] as usize;
    let FlexScratch { nodes, force, faces, .. } = scratch;
    vertices::nodes(flex, at.kin, nodes);
    force.clear();
    force.resize(nodes.len(), [0.0; 3]);
    faces.clear();
    faces.extend((0..lattice.patches()).map(|index| lattice.patch(index)));
    for edge in m.flex_bending[first + 1..first + 1 + edges * EDGE].chunks_exact(EDGE) {
        if edge[6] != 0.0 {
            let face = |k: usize| {
                let local = [edge[2 + 2 * k], edge[3 + 2 * k]];
                Placed::new(&faces[edge[k] as usize], nodes, local)
            };
            bend([face(0), face(1)], edge[6], [edge[7], edge[8], edge[9]], force);
        }
    }
    cells::apply(flex, at, nodes, force, &mut out.qfrc_spring);
}

fn bend(faces: [Placed; 2], stiffness: f64, rest: Vec3, force: &mut [Vec3]) {
    let [Some(a), Some(b)] = [faces[0].normal(), faces[1].normal()] else { return };
    let turn = mean(faces.each_ref().map(|face| face.patch.inverse_rotation(face.points())));
    let rest = quat_rotate(quat_conj(turn), rest);
    let residual = sub(sub(a.unit, b.unit), rest);
    faces[0].push(&a, residual, stiffness, 1.0, force);
    faces[1].push(&b, residual, stiffness, -1.0, force);
}

/// The rotation halfway between two.
fn mean([a, b]: [Quat; 2]) -> Quat {
    let sign = if dot_slice(&a, &b) < 0.0 { -1.0 } else { 1.0 };
    let sum: Quat = std::array::from_fn(|i| a[i] + sign * b[i]);
    normalized(sum)
}

/// Unit quaternion, with the order of additions of long vectors.
fn normalized(q: Quat) -> Quat {
    let length = dot_slice(&q, &q).sqrt();
    if length < MINVAL { [1.0, 0.0, 0.0, 0.0] } else { q.map(|x| x * (1.0 / length)) }
}
