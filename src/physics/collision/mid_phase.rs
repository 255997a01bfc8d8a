//! Pairs of geoms of two bodies that may touch: descent of the two bounding-volume trees, with the separating axis
//! test of oriented boxes (Gottschalk, Lin, Manocha 1996).

use super::broad_phase::spheres_apart;
use super::mixing;
use crate::data::Kinematics;
use crate::math::{Mat3, Vec3, add, column, dot, mul_mat_vec};
use crate::model::Model;
use crate::model::bounds::MAXVAL;

/// A box in a frame: centre and half-sizes, and where the frame is.
struct OrientedBox<'a> {
    aabb: &'a [f64; 6],
    pos: Vec3,
    mat: &'a Mat3,
}

/// A tree of boxes: nodes `start..`, children counted from `start`.
#[derive(Clone, Copy)]
struct Tree<'a> {
    m: &'a Model,
    start: usize,
}

impl<'a> Tree<'a> {
    fn children(self, node: usize) -> [i32; 2] {
        self.m.bvh_child[self.start + node]
    }

    fn aabb(self, node: usize) -> &'a [f64; 6] {
        &self.m.bvh_aabb[self.start + node]
    }

    /// The geom of a leaf.
    fn leaf(self, node: usize) -> Option<usize> {
        (self.children(node) == [-1, -1]).then(|| self.m.bvh_nodeid[self.start + node] as usize)
    }

    /// Half the surface of the box spanned by centre and half-size: decides which tree to descend.
    fn surface(self, node: usize) -> f64 {
        let b = self.aabb(node);
        let (x, y, z) = (b[3] - b[0], b[4] - b[1], b[5] - b[2]);
        x * y + y * z + z * x
    }
}

/// Calls `found(g1, g2)` for geoms of bodies `b1` and `b2` whose bounding spheres and boxes come within their
/// margins. `stack` is working memory.
pub fn descend(
    m: &Model,
    kin: &Kinematics,
    b1: usize,
    b2: usize,
    stack: &mut Vec<(usize, usize)>,
    mut found: impl FnMut(usize, usize),
) {
    let tree1 = Tree { m, start: m.body_bvhadr[b1] as usize };
    let tree2 = Tree { m, start: m.body_bvhadr[b2] as usize };
    let body_margin =
        if mixing::overridden(m) { m.opt.o_margin } else { m.body_margin[b1] + m.body_margin[b2] };
    let relation = Relation::new(kin.xipos[b1], &kin.ximat[b1], kin.xipos[b2], &kin.ximat[b2]);

    stack.clear();
    stack.push((0, 0));
    while let Some((n1, n2)) = stack.pop() {
        let (leaf1, leaf2) = (tree1.leaf(n1), tree2.leaf(n2));
        if let (Some(g1), Some(g2)) = (leaf1, leaf2) {
            let reach = mixing::margin(m, g1, g2, None) + mixing::gap(m, g1, g2, None);
            if !spheres_apart(m, kin, g1, g2, reach) && geom_boxes_overlap(m, kin, g1, g2, reach) {
                found(g1, g2);
            }
            continue;
        }
        if !relation.overlap(tree1.aabb(n1), tree2.aabb(n2), body_margin) {
            continue;
        }
        let first = match (leaf1, leaf2) {
            (None, Some(_)) => true,
            (Some(_), None) => false,
            _ => tree1.surface(n1) > tree2.surface(n2),
        };
        if first {
            stack.extend(tree1.children(n1).into_iter().filter(|&c| c >= 0).map(|c| (c as usize, n2)));
        } else {
            stack.extend(tree2.children(n2).into_iter().filter(|&c| c >= 0).map(|c| (n1, c as usize)));
        }
    }
}

fn geom_boxes_overlap(m: &Model, kin: &Kinematics, g1: usize, g2: usize, margin: f64) -> bool {
    let of = |g: usize| OrientedBox { aabb: &m.geom_aabb[g], pos: kin.geom_xpos[g], mat: &kin.geom_xmat[g] };
    boxes_overlap([of(g1), of(g2)], margin)
}

/// Which of the half-sizes are infinite: (some, all).
fn infinite(aabb: &[f64; 6]) -> (bool, bool) {
    let beyond = |i: usize| aabb[i] >= MAXVAL;
    (beyond(3) || beyond(4) || beyond(5), beyond(3) && beyond(4) && beyond(5))
}

/// Separating axis test along the six face normals, in the world.
fn boxes_overlap(boxes: [OrientedBox; 2], margin: f64) -> bool {
    let [(some1, all1), (some2, all2)] = [infinite(boxes[0].aabb), infinite(boxes[1].aabb)];
    if all1 || all2 {
        return true;
    }
    let centre = |b: &OrientedBox| add(mul_mat_vec(b.mat, [b.aabb[0], b.aabb[1], b.aabb[2]]), b.pos);
    let centres = [centre(&boxes[0]), centre(&boxes[1])];
    for (owner, skip) in [(0, some2), (1, some1)] {
        if skip {
            continue;
        }
        for k in 0..3 {
            let axis = column(boxes[owner].mat, k);
            let radius = |b: &OrientedBox| {
                (b.aabb[3] * dot(column(b.mat, 0), axis)).abs()
                    + (b.aabb[4] * dot(column(b.mat, 1), axis)).abs()
                    + (b.aabb[5] * dot(column(b.mat, 2), axis)).abs()
            };
            let between = (dot(centres[1], axis) - dot(centres[0], axis)).abs();
            if radius(&boxes[0]) + radius(&boxes[1]) + margin < between {
                return false;
            }
        }
    }
    true
}

/// Products of the axes of two bodies, shared by all box pairs of their trees.
struct Relation {
    /// `[box][owner of the axis][axis]`: box axes along the face normal.
    product: [[[Vec3; 3]; 2]; 2],
    /// Body position along the face normal.
    offset: [[[f64; 3]; 2]; 2],
}

impl Relation {
    fn new(pos1: Vec3, mat1: &Mat3, pos2: Vec3, mat2: &Mat3) -> Self {
        let (pos, mat) = ([pos1, pos2], [mat1, mat2]);
        let along = |i: usize, j: usize, k: usize, l: usize| dot(column(mat[i], l), column(mat[j], k));
        Relation {
            product: std::array::from_fn(|i| {
                std::array::from_fn(|j| std::array::from_fn(|k| std::array::from_fn(|l| along(i, j, k, l))))
            }),
            offset: std::array::from_fn(|i| {
                std::array::from_fn(|j| std::array::from_fn(|k| dot(pos[i], column(mat[j], k))))
            }),
        }
    }

    /// Separating axis test of two boxes in the frames of the bodies.
    fn overlap(&self, aabb1: &[f64; 6], aabb2: &[f64; 6], margin: f64) -> bool {
        let [(some1, all1), (some2, all2)] = [infinite(aabb1), infinite(aabb2)];
        if all1 || all2 {
            return true;
        }
        for (owner, skip) in [(0, some2), (1, some1)] {
            if skip {
                continue;
            }
            for k in 0..3 {
                let project = |i: usize, b: &[f64; 6]| {
                    let p = self.product[i][owner][k];
                    let centre = b[0] * p[0] + b[1] * p[1] + b[2] * p[2] + self.offset[i][owner][k];
                    (centre, (b[3] * p[0]).abs() + (b[4] * p[1]).abs() + (b[5] * p[2]).abs())
                };
                let (c1, r1) = project(0, aabb1);
                let (c2, r2) = project(1, aabb2);
                if r1 + r2 + margin < (c2 - c1).abs() {
                    return false;
                }
            }
        }
        true
    }
}
