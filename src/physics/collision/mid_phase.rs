//! Pairs of geoms of two bodies that may touch: descent of the two bounding-volume trees, with the separating axis
//! test of oriented boxes (Gottschalk, Lin, Manocha 1996).

use super::broad_phase::spheres_apart;
use super::mixing;
use crate::math::{Mat3, Vec3, add, column, dot, mul_mat_t_mat, mul_mat_t_vec, mul_mat_vec, sub};
use crate::model::Model;
use crate::model::bounds::MAXVAL;
use crate::stages::Kinematics;

/// A tree of boxes.
#[derive(Clone, Copy)]
pub(crate) struct Tree<'a> {
    /// Children of each node, -1 for none.
    pub children: &'a [[i32; 2]],
    /// What a leaf stands for.
    pub ids: &'a [i32],
    /// Box of each node: centre, half sizes.
    pub boxes: &'a [[f64; 6]],
}

impl<'a> Tree<'a> {
    /// The tree of the geoms of body `b`.
    #[inline(always)]
    pub fn of_body(m: &'a Model, b: usize) -> Self {
        let start = m.body_bvhadr[b] as usize;
        Tree { children: &m.bvh_child[start..], ids: &m.bvh_nodeid[start..], boxes: &m.bvh_aabb[start..] }
    }

    /// What a leaf stands for.
    fn leaf(self, node: usize) -> Option<usize> {
        (self.children[node] == [-1, -1]).then(|| self.ids[node] as usize)
    }

    /// Half the surface of the box spanned by centre and half-size: decides which tree to descend.
    fn surface(self, node: usize) -> f64 {
        let b = &self.boxes[node];
        let (x, y, z) = (b[3] - b[0], b[4] - b[1], b[5] - b[2]);
        x * y + y * z + z * x
    }
}

/// Descends two trees: calls `found` for leaves of both below nodes whose boxes `overlap`, until it answers false. A
/// tree against itself (`OWN`) gives each pair of leaves once, equal ones included. `stack` is working memory.
pub(super) fn walk<const OWN: bool>(
    [tree1, tree2]: [Tree; 2],
    stack: &mut Vec<(usize, usize)>,
    overlap: impl Fn(&[f64; 6], &[f64; 6]) -> bool,
    mut found: impl FnMut(usize, usize) -> bool,
) {
    stack.clear();
    stack.push((0, 0));
    while let Some((n1, n2)) = stack.pop() {
        if OWN && n1 > n2 {
            continue;
        }
        let (leaf1, leaf2) = (tree1.leaf(n1), tree2.leaf(n2));
        if let (Some(id1), Some(id2)) = (leaf1, leaf2) {
            if !found(id1, id2) {
                return;
            }
            continue;
        }
        if !overlap(&tree1.boxes[n1], &tree2.boxes[n2]) {
            continue;
        }
        let first = match (leaf1, leaf2) {
            (None, Some(_)) => true,
            (Some(_), None) => false,
            _ => tree1.surface(n1) > tree2.surface(n2),
        };
        if first {
            stack.extend(tree1.children[n1].into_iter().filter(|&c| c >= 0).map(|c| (c as usize, n2)));
        } else {
            stack.extend(tree2.children[n2].into_iter().filter(|&c| c >= 0).map(|c| (n1, c as usize)));
        }
    }
}

/// Calls `found(g1, g2)` for geoms of bodies `b1` and `b2` whose bounding spheres and boxes come within their
/// margins, until it answers false. `stack` is working memory.
pub fn descend(
    m: &Model,
    kin: &Kinematics,
    b1: usize,
    b2: usize,
    stack: &mut Vec<(usize, usize)>,
    mut found: impl FnMut(usize, usize) -> bool,
) {
    let body_margin =
        if mixing::overridden(m) { m.opt.o_margin } else { m.body_margin[b1] + m.body_margin[b2] };
    let relation =
        Relation::new([kin.xipos[b1], kin.xipos[b2]], [&kin.ximat[b1], &kin.ximat[b2]], Centres::InFrame);
    walk::<false>(
        [b1, b2].map(|b| Tree::of_body(m, b)),
        stack,
        |a, b| relation.overlap([a, b], body_margin),
        |g1, g2| {
            let reach = mixing::margin(m, g1, g2, None) + mixing::gap(m, g1, g2, None);
            let near = !spheres_apart(m, kin, g1, g2, reach) && geom_boxes_overlap(m, kin, g1, g2, reach);
            !near || found(g1, g2)
        },
    );
}

fn geom_boxes_overlap(m: &Model, kin: &Kinematics, g1: usize, g2: usize, margin: f64) -> bool {
    let (pos, mat) = (&kin.geom_xpos, &kin.geom_xmat);
    let relation = Relation::new([pos[g1], pos[g2]], [&mat[g1], &mat[g2]], Centres::InWorld);
    relation.overlap([&m.geom_aabb[g1], &m.geom_aabb[g2]], margin)
}

/// Which of the half-sizes are infinite: (some, all).
fn infinite(aabb: &[f64; 6]) -> (bool, bool) {
    let beyond = |i: usize| aabb[i] >= MAXVAL;
    (beyond(3) || beyond(4) || beyond(5), beyond(3) && beyond(4) && beyond(5))
}

/// How MuJoCo adds up where a box is along an axis, which decides boxes that meet exactly.
#[derive(Clone, Copy)]
pub(super) enum Centres {
    /// The origin of the frame and the centre in it are projected one by one, as for bodies.
    InFrame,
    /// The centre is projected as a point of the world, as for geoms.
    InWorld,
}

/// Two frames, and where one is seen from the other: shared by all box pairs of two trees.
pub(super) struct Relation<'a> {
    pos: [Vec3; 2],
    mat: [&'a Mat3; 2],
    centres: Centres,
    /// Second frame's axes (columns) in the first.
    rot: Mat3,
    /// From the first origin to the second, in the first frame and in the second.
    offset: [Vec3; 2],
    /// Sum of the origins' coordinates: rounding is a small part of it.
    size: f64,
}

/// Far above the share of rounding in the sum of what is added up, and far below any difference that matters.
const UNDECIDED: f64 = 1e-12;

impl<'a> Relation<'a> {
    pub fn new(pos: [Vec3; 2], mat: [&'a Mat3; 2], centres: Centres) -> Self {
        let between = sub(pos[1], pos[0]);
        Relation {
            pos,
            mat,
            centres,
            rot: mul_mat_t_mat(mat[0], mat[1]),
            offset: mat.map(|mat| mul_mat_t_vec(mat, between)),
            size: magnitude(&pos[0]) + magnitude(&pos[1]),
        }
    }

    /// Separating axis test along the six face normals of two boxes; a box without end has no faces to test the
    /// other against. Where rounding decides an axis, the sums are MuJoCo's.
    pub fn overlap(&self, [a, b]: [&[f64; 6]; 2], margin: f64) -> bool {
        let [(some_a, all_a), (some_b, all_b)] = [infinite(a), infinite(b)];
        if all_a || all_b {
            return true;
        }
        let r = &self.rot;
        let size = self.size + magnitude(&[a[0], a[1], a[2]]) + magnitude(&[b[0], b[1], b[2]]);
        let decide = |frame: usize, k: usize, between: f64, radius: f64| {
            let gap = between.abs() - (radius + margin);
            let undecided = UNDECIDED * (size + radius);
            if gap.abs() > undecided { gap > 0.0 } else { self.apart_along(frame, k, [a, b], margin) }
        };
        let apart_in_first = |k: usize| {
            let (x, y, z) = (r[3 * k], r[3 * k + 1], r[3 * k + 2]);
            let between = self.offset[0][k] + (b[0] * x + b[1] * y + b[2] * z) - a[k];
            let radius = a[3 + k] + ((b[3] * x).abs() + (b[4] * y).abs() + (b[5] * z).abs());
            decide(0, k, between, radius)
        };
        let apart_in_second = |k: usize| {
            let (x, y, z) = (r[k], r[3 + k], r[6 + k]);
            let between = self.offset[1][k] + b[k] - (a[0] * x + a[1] * y + a[2] * z);
            let radius = ((a[3] * x).abs() + (a[4] * y).abs() + (a[5] * z).abs()) + b[3 + k];
            decide(1, k, between, radius)
        };
        (some_b || !(0..3).any(apart_in_first)) && (some_a || !(0..3).any(apart_in_second))
    }

    /// Whether two boxes are apart along axis `k` of a frame, by MuJoCo's sums.
    #[cold]
    fn apart_along(&self, frame: usize, k: usize, boxes: [&[f64; 6]; 2], margin: f64) -> bool {
        let normal = column(self.mat[frame], k);
        let project = |i: usize| {
            let (b, mat) = (boxes[i], self.mat[i]);
            let product = [0, 1, 2].map(|l| dot(column(mat, l), normal));
            let radius = (b[3] * product[0]).abs() + (b[4] * product[1]).abs() + (b[5] * product[2]).abs();
            let local = [b[0], b[1], b[2]];
            let centre = match self.centres {
                Centres::InFrame => dot(local, product) + dot(self.pos[i], normal),
                Centres::InWorld => dot(add(mul_mat_vec(mat, local), self.pos[i]), normal),
            };
            (centre, radius)
        };
        let [(first, radius1), (second, radius2)] = [project(0), project(1)];
        radius1 + radius2 + margin < (second - first).abs()
    }
}

fn magnitude(v: &Vec3) -> f64 {
    v[0].abs() + v[1].abs() + v[2].abs()
}
