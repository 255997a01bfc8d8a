//! Pairs of geoms of two bodies that may touch: descent of the two bounding-volume trees, with the separating axis
//! test of oriented boxes (Gottschalk, Lin, Manocha 1996).

use super::broad_phase::spheres_apart;
use super::mixing;
use crate::data::Kinematics;
use crate::math::{Mat3, Vec3, add, dot, mul_mat_vec};
use crate::model::Model;
use crate::model::bounds::MAXVAL;

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
/// margins, until it answers false. `stack` is working memory.
pub fn descend(
    m: &Model,
    kin: &Kinematics,
    b1: usize,
    b2: usize,
    stack: &mut Vec<(usize, usize)>,
    mut found: impl FnMut(usize, usize) -> bool,
) {
    let tree1 = Tree { m, start: m.body_bvhadr[b1] as usize };
    let tree2 = Tree { m, start: m.body_bvhadr[b2] as usize };
    let body_margin =
        if mixing::overridden(m) { m.opt.o_margin } else { m.body_margin[b1] + m.body_margin[b2] };
    let relation = Relation::new([kin.xipos[b1], kin.xipos[b2]], [&kin.ximat[b1], &kin.ximat[b2]]);

    stack.clear();
    stack.push((0, 0));
    while let Some((n1, n2)) = stack.pop() {
        let (leaf1, leaf2) = (tree1.leaf(n1), tree2.leaf(n2));
        if let (Some(g1), Some(g2)) = (leaf1, leaf2) {
            let reach = mixing::margin(m, g1, g2, None) + mixing::gap(m, g1, g2, None);
            let near = !spheres_apart(m, kin, g1, g2, reach) && geom_boxes_overlap(m, kin, g1, g2, reach);
            if near && !found(g1, g2) {
                return;
            }
            continue;
        }
        if !relation.overlap([tree1.aabb(n1), tree2.aabb(n2)], body_margin) {
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

/// Separating axis test along the six face normals of the boxes of two geoms. Centres are projected as points of the
/// world: boxes that touch exactly are apart or not by the rounding of these sums, as in MuJoCo.
fn geom_boxes_overlap(m: &Model, kin: &Kinematics, g1: usize, g2: usize, margin: f64) -> bool {
    let boxes = [&m.geom_aabb[g1], &m.geom_aabb[g2]];
    let mats = [&kin.geom_xmat[g1], &kin.geom_xmat[g2]];
    let axes = mats.map(columns);
    let centre = |i: usize, g: usize| {
        add(mul_mat_vec(mats[i], [boxes[i][0], boxes[i][1], boxes[i][2]]), kin.geom_xpos[g])
    };
    let centres = [centre(0, g1), centre(1, g2)];
    let apart_along = |normal: &Vec3| {
        let shadow = |i: usize| {
            let reach = |l: usize| (boxes[i][3 + l] * dot(axes[i][l], *normal)).abs();
            Shadow { centre: dot(centres[i], *normal), radius: reach(0) + reach(1) + reach(2) }
        };
        shadow(0).apart(shadow(1), margin)
    };
    overlap(boxes, |j, k| apart_along(&axes[j][k]))
}

/// A box projected onto an axis.
struct Shadow {
    centre: f64,
    radius: f64,
}

impl Shadow {
    fn apart(self, other: Shadow, margin: f64) -> bool {
        self.radius + other.radius + margin < (other.centre - self.centre).abs()
    }
}

/// True unless `apart(j, k)` along the normal of a face `k` of box `j`. A box without end in all directions touches
/// everything; one without end in some has no faces to test the other against.
fn overlap(boxes: [&[f64; 6]; 2], apart: impl Fn(usize, usize) -> bool) -> bool {
    let [(some_a, all_a), (some_b, all_b)] = boxes.map(infinite);
    all_a || all_b || ((some_b || !(0..3).any(|k| apart(0, k))) && (some_a || !(0..3).any(|k| apart(1, k))))
}

/// Which of the half-sizes are infinite: (some, all).
fn infinite(aabb: &[f64; 6]) -> (bool, bool) {
    let beyond = |i: usize| aabb[i] >= MAXVAL;
    (beyond(3) || beyond(4) || beyond(5), beyond(3) && beyond(4) && beyond(5))
}

fn columns(mat: &Mat3) -> [Vec3; 3] {
    [0, 1, 2].map(|k| [mat[k], mat[3 + k], mat[6 + k]])
}

/// Two frames projected onto the axes of both: shared by all box pairs of two trees.
struct Relation {
    /// `product[i][j][k][l]`: axis `l` of frame `i` along axis `k` of frame `j`.
    product: [[Mat3; 2]; 2],
    /// `offset[i][j][k]`: origin of frame `i` along axis `k` of frame `j`.
    offset: [[Vec3; 2]; 2],
}

impl Relation {
    fn new(pos: [Vec3; 2], mats: [&Mat3; 2]) -> Self {
        let axes = mats.map(columns);
        let product = |i: usize, j: usize| std::array::from_fn(|at| dot(axes[i][at % 3], axes[j][at / 3]));
        let offset = |i: usize, j: usize| axes[j].map(|axis| dot(pos[i], axis));
        Relation {
            product: [0, 1].map(|i| [0, 1].map(|j| product(i, j))),
            offset: [0, 1].map(|i| [0, 1].map(|j| offset(i, j))),
        }
    }

    /// Separating axis test along the six face normals of two boxes.
    fn overlap(&self, boxes: [&[f64; 6]; 2], margin: f64) -> bool {
        overlap(boxes, |j, k| {
            let shadow = |i: usize| {
                let (b, p) = (boxes[i], &self.product[i][j][3 * k..3 * k + 3]);
                Shadow {
                    centre: b[0] * p[0] + b[1] * p[1] + b[2] * p[2] + self.offset[i][j][k],
                    radius: (b[3] * p[0]).abs() + (b[4] * p[1]).abs() + (b[5] * p[2]).abs(),
                }
            };
            shadow(0).apart(shadow(1), margin)
        })
    }
}
