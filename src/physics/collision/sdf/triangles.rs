//! A mesh and a field: triangles whose boxes come near the field, and the deepest point of each (Macklin et al. 2020,
//! "Local optimization for robust signed distance field collision"; Frank and Wolfe 1956).

use super::distance::Distance;
use super::order::larger;
use super::{Points, Transfer, halton};
use crate::collision::mid_phase::Tree;
use crate::collision::scratch::{Candidate, ConvexScratch, FieldScratch};
use crate::collision::shape::PreContact;
use crate::geometry::hierarchy::MAX_LEVELS;
use crate::math::{
    IDENTITY, Quat, Vec3, add, add_scaled, cross, distance, dot, mat_to_quat, norm, normalize, scale, sub,
};
use crate::model::Model;
use crate::model::bounds::{MAXCONPAIR, MAXVAL, MINVAL};
use crate::stages::Kinematics;

/// How a field is searched.
struct Search<'a> {
    field: Distance<'a>,
    starts: usize,
    steps: i32,
}

/// Contacts of a mesh and a field, the second geom.
pub(crate) fn mesh_and_field(
    m: &Model,
    kin: &Kinematics,
    g1: usize,
    g2: usize,
    _margin: f64,
    scratch: &mut ConvexScratch,
    out: &mut Vec<PreContact>,
) {
    let (Some(field), Ok(mesh)) = (Distance::of(m, g2), usize::try_from(m.geom_dataid[g1])) else { return };
    let [pose1, pose2] = [g1, g2].map(|g| (kin.geom_xpos[g], mat_to_quat(&kin.geom_xmat[g])));
    let across = Transfer::new(pose1, pose2);
    let (starts, steps) = (m.opt.sdf_initpoints.max(1) as usize, m.opt.sdf_iterations);
    let search = Search { field, starts, steps };
    let FieldScratch { known, candidates, .. } = &mut scratch.field;
    candidates.clear();
    let Ok(root) = usize::try_from(m.mesh_bvhadr[mesh]) else { return };
    let tree =
        Tree { children: &m.bvh_child[root..], ids: &m.bvh_nodeid[root..], boxes: &m.bvh_aabb[root..] };
    let (first_face, first_vertex) = (m.mesh_faceadr[mesh] as usize, m.mesh_vertadr[mesh] as usize);
    search.near_leaves(tree, &across, |face| {
        let face = m.mesh_face[first_face + face];
        let corners = face.map(|v| m.mesh_vert[first_vertex + v as usize].map(f64::from));
        search.triangle(corners.map(|p| across.point(p)), candidates);
    });
    let mut points = Points::new(pose2, known, out);
    for Candidate { at, depth } in candidates.drain(..) {
        points.add(at, depth, || field.gradient(at));
    }
}

/// Triangles that move on their own, in the world.
#[derive(Clone, Copy)]
pub(crate) struct Sheet<'a> {
    /// Corners of all triangles.
    pub elements: &'a [i32],
    pub points: &'a [Vec3],
    /// Boxes around the triangles.
    pub tree: Option<Tree<'a>>,
}

impl Sheet<'_> {
    fn corners(&self, e: usize, across: &Transfer) -> [Vec3; 3] {
        [0, 1, 2].map(|k| across.point(self.points[self.elements[3 * e + k] as usize]))
    }
}

/// Contacts of the field of a geom, the first, with a sheet; `scratch.elements` says of each which triangle touches.
///
/// With a tree of boxes, each triangle touches at its deepest point alone.
pub(crate) fn sheet_and_field(
    m: &Model,
    kin: &Kinematics,
    g: usize,
    sheet: Sheet,
    scratch: &mut FieldScratch,
    out: &mut Vec<PreContact>,
) {
    const WORLD: (Vec3, Quat) = ([0.0; 3], IDENTITY);
    let FieldScratch { known, candidates: own, deepest, elements } = scratch;
    elements.clear();
    let Some(field) = Distance::of(m, g) else { return };
    let pose = (kin.geom_xpos[g], mat_to_quat(&kin.geom_xmat[g]));
    let across = Transfer::new(WORLD, pose);
    let (starts, steps) = (m.opt.sdf_initpoints.max(1) as usize, m.opt.sdf_iterations);
    let search = Search { field, starts, steps };
    if let Some(tree) = sheet.tree {
        deepest.clear();
        search.near_leaves(tree, &across, |e| {
            own.clear();
            search.triangle(sheet.corners(e, &across), own);
            let best = own.drain(..).reduce(|best, next| if next.depth < best.depth { next } else { best });
            if let Some(best) = best.filter(|_| deepest.len() < MAXCONPAIR) {
                deepest.push((e, best));
            }
        });
        let mut points = Points { outward: true, ..Points::new(pose, known, out) };
        for (e, Candidate { at, depth }) in deepest.drain(..) {
            if points.add(at, depth, || field.gradient(at)) {
                elements.push(e);
            }
        }
        return;
    }
    for e in 0..sheet.elements.len() / 3 {
        own.clear();
        search.triangle(sheet.corners(e, &across), own);
        let mut points = Points { outward: true, ..Points::new(pose, known, out) };
        for Candidate { at, depth } in own.drain(..) {
            if elements.len() < MAXCONPAIR && points.add(at, depth, || field.gradient(at)) {
                elements.push(e);
            }
        }
    }
}

impl Search<'_> {
    /// Calls `visit` for the leaves whose boxes come near the field.
    fn near_leaves(&self, tree: Tree, across: &Transfer, mut visit: impl FnMut(usize)) {
        let (mut stack, mut waiting) = ([0_usize; MAX_LEVELS + 1], 1);
        while waiting > 0 {
            waiting -= 1;
            let node = stack[waiting];
            if !self.near_box(&tree.boxes[node], across) {
                continue;
            }
            if let Ok(leaf) = usize::try_from(tree.ids[node]) {
                visit(leaf);
                continue;
            }
            for child in tree.children[node].iter().filter_map(|&c| usize::try_from(c).ok()) {
                stack[waiting] = child;
                waiting += 1;
            }
        }
    }

    /// The sphere around a box reaches the field.
    fn near_box(&self, aabb: &[f64; 6], across: &Transfer) -> bool {
        let centre = across.point([aabb[0], aabb[1], aabb[2]]);
        self.field.at(centre) < norm([aabb[3], aabb[4], aabb[5]])
    }

    /// Adds the points of a triangle that lie inside, one for each start.
    fn triangle(&self, corners: [Vec3; 3], out: &mut Vec<Candidate>) {
        if !self.near_triangle(&corners) {
            return;
        }
        for start in 1..=self.starts {
            if out.len() >= MAXCONPAIR {
                return;
            }
            let (mut u, mut v) = (halton(start, 2), halton(start, 3));
            if u + v > 1.0 {
                (u, v) = (1.0 - u, 1.0 - v);
            }
            let rest = 1.0 - u - v;
            let [a, b, c] = corners;
            let at = std::array::from_fn(|k| rest * a[k] + u * b[k] + v * c[k]);
            let at = self.deepest(at, &corners);
            let depth = self.field.at(at);
            if depth < 0.0 {
                out.push(Candidate { at, depth });
            }
        }
    }

    /// Goes towards the corner that lies farthest down the slope, by smaller and smaller shares.
    fn deepest(&self, mut x: Vec3, corners: &[Vec3; 3]) -> Vec3 {
        for step in 0..self.steps {
            let gradient = self.field.gradient(x);
            let (mut best, mut towards) = (MAXVAL, [0.0; 3]);
            for corner in corners {
                let height = dot(*corner, gradient);
                if height < best {
                    (best, towards) = (height, *corner);
                }
            }
            x = add_scaled(x, sub(towards, x), 2.0 / (f64::from(step) + 2.0));
        }
        x
    }

    /// The sphere around a triangle and a point beside it, on the side of the field, reaches the field.
    fn near_triangle(&self, corners: &[Vec3; 3]) -> bool {
        const SHARE: f64 = 10.0;
        const LEAST_HEIGHT: f64 = 0.1;
        let [a, b, c] = *corners;
        let edges = [sub(b, a), sub(c, a)];
        let (normal, _) = normalize(cross(edges[0], edges[1]));
        let third = 1.0 / 3.0;
        let centroid = add_scaled(add_scaled(scale(a, third), b, third), c, third);
        let depth = self.field.at(centroid);
        let height = -depth / SHARE;
        if height.abs() < LEAST_HEIGHT {
            return depth < circumradius(corners);
        }
        let apex = add_scaled(centroid, normal, -height);
        let v = corners.map(|p| sub(p, apex));
        let crosses = [cross(v[1], v[2]), cross(v[2], v[0]), cross(v[0], v[1])];
        let sum = scale(crosses[0], dot(v[0], v[0]));
        let sum = add_scaled(sum, crosses[1], dot(v[1], v[1]));
        let sum = add_scaled(sum, crosses[2], dot(v[2], v[2]));
        let volume = 2.0 * dot(v[0], crosses[0]);
        if volume.abs() < MINVAL {
            return depth < norm(edges[0]);
        }
        let centre = scale(sum, 1.0 / volume);
        self.field.at(add(centre, apex)) < dot(centre, centre).sqrt()
    }
}

/// Radius of the circle through the corners (Heron).
fn circumradius([p, q, r]: &[Vec3; 3]) -> f64 {
    let (a, b, c) = (distance(*p, *q), distance(*q, *r), distance(*r, *p));
    let s = (a + b + c) / 2.0;
    let area = (s * (s - a) * (s - b) * (s - c)).sqrt();
    a * b * c / (4.0 * larger(area, MINVAL))
}
