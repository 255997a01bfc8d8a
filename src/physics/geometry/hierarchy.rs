//! Bounding volume hierarchies of meshes (leaf = face) and bodies (leaf = geom).
//!
//! A node's box encloses its leaves; the leaves are split at the median of the longest axis of that
//! box. Nodes are numbered in preorder, the left child right after its parent, as `bvh_*` stores them.

use super::quickselect::select;
use crate::math::{quat_rotate, sub};

/// Boxes thinner than this are inflated, and coordinates closer than this tie.
const EPS: f64 = 1e-14;

/// Levels of a hierarchy; the compiler makes fewer, compiled files are refused that have more.
pub(crate) const MAX_LEVELS: usize = 64;

/// One element of a hierarchy.
#[derive(Debug, Clone, PartialEq)]
pub struct Leaf {
    /// What `bvh_nodeid` stores: face index in the mesh, or geom id.
    pub id: i32,
    /// Position the median split sorts by, and origin of `aabb` when `quat` is given.
    pub pos: [f64; 3],
    /// Orientation of `aabb`; `None` when the box is already in the hierarchy's frame.
    pub quat: Option<[f64; 4]>,
    /// Box of the element: centre, half sizes.
    pub aabb: [f64; 6],
    /// Whether the element takes part in collisions; others are left out.
    pub collides: bool,
}

/// The `bvh_*` rows of one mesh or body; children are relative to the first row.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Bvh {
    /// Depth of each node, root 0.
    pub depth: Vec<i32>,
    /// Left and right child, -1 for none.
    pub child: Vec<[i32; 2]>,
    /// Element of a leaf, -1 for inner nodes.
    pub nodeid: Vec<i32>,
    /// Box of each node: centre, half sizes.
    pub aabb: Vec<[f64; 6]>,
}

impl Bvh {
    /// Appends the nodes of another.
    pub(super) fn extend(&mut self, other: &Bvh) {
        self.depth.extend(&other.depth);
        self.child.extend(&other.child);
        self.nodeid.extend(&other.nodeid);
        self.aabb.extend(&other.aabb);
    }
}

struct Element<'a> {
    leaf: &'a Leaf,
    order: usize,
    local: [f64; 3],
}

/// Hierarchy of `leaves` in the frame (`ipos`, `iquat`): the inertial frame of the body, or identity.
pub fn build(leaves: &[Leaf], ipos: [f64; 3], iquat: [f64; 4]) -> Bvh {
    let qinv = [iquat[0], -iquat[1], -iquat[2], -iquat[3]];
    let mut elements: Vec<Element> = leaves
        .iter()
        .enumerate()
        .filter(|(_, leaf)| leaf.collides)
        .map(|(order, leaf)| Element { leaf, order, local: quat_rotate(qinv, sub(leaf.pos, ipos)) })
        .collect();
    let mut bvh = Bvh::default();
    if !elements.is_empty() {
        split(&mut bvh, &mut elements, 0, ipos, qinv);
    }
    bvh
}

fn split(bvh: &mut Bvh, elements: &mut [Element], depth: i32, ipos: [f64; 3], qinv: [f64; 4]) -> i32 {
    let (lo, hi) = enclosing(elements, ipos, qinv);
    let index = bvh.depth.len();
    bvh.depth.push(depth);
    bvh.child.push([-1, -1]);
    bvh.nodeid.push(-1);
    bvh.aabb.push([
        (hi[0] + lo[0]) / 2.0,
        (hi[1] + lo[1]) / 2.0,
        (hi[2] + lo[2]) / 2.0,
        (hi[0] - lo[0]) / 2.0,
        (hi[1] - lo[1]) / 2.0,
        (hi[2] - lo[2]) / 2.0,
    ]);
    if elements.len() == 1 {
        bvh.nodeid[index] = elements[0].leaf.id;
        return index as i32;
    }
    let axis = longest_axis(sub(hi, lo));
    let median = elements.len() / 2;
    let before = |a: &Element, b: &Element| {
        let (x, y) = (a.local[axis], b.local[axis]);
        if (x - y).abs() > EPS { x < y } else { a.order < b.order }
    };
    select(elements, median, &before);
    let (left, right) = elements.split_at_mut(median);
    let left = split(bvh, left, depth + 1, ipos, qinv);
    let right = split(bvh, right, depth + 1, ipos, qinv);
    bvh.child[index] = [left, right];
    index as i32
}

/// Corners (min, max) of the box around all elements, at least `2 EPS` wide.
fn enclosing(elements: &[Element], ipos: [f64; 3], qinv: [f64; 4]) -> ([f64; 3], [f64; 3]) {
    let mut lo = [f64::MAX; 3];
    let mut hi = [-f64::MAX; 3];
    for element in elements {
        let aabb = &element.leaf.aabb;
        let min = [aabb[0] - aabb[3], aabb[1] - aabb[4], aabb[2] - aabb[5]];
        let max = [aabb[0] + aabb[3], aabb[1] + aabb[4], aabb[2] + aabb[5]];
        let Some(quat) = element.leaf.quat else {
            for k in 0..3 {
                lo[k] = lo[k].min(min[k]).min(max[k]);
                hi[k] = hi[k].max(min[k]).max(max[k]);
            }
            continue;
        };
        for corner in 0..8 {
            let pick = |k: usize| if corner >> k & 1 == 1 { max[k] } else { min[k] };
            let turned = quat_rotate(quat, [pick(0), pick(1), pick(2)]);
            let pos = element.leaf.pos;
            let moved = [
                turned[0] + (pos[0] - ipos[0]),
                turned[1] + (pos[1] - ipos[1]),
                turned[2] + (pos[2] - ipos[2]),
            ];
            let local = quat_rotate(qinv, moved);
            for k in 0..3 {
                lo[k] = lo[k].min(local[k]);
                hi[k] = hi[k].max(local[k]);
            }
        }
    }
    for k in 0..3 {
        if (lo[k] - hi[k]).abs() < EPS {
            lo[k] -= EPS;
            hi[k] += EPS;
        }
    }
    (lo, hi)
}

/// First axis unless a later one is longer by `EPS`.
fn longest_axis(edges: [f64; 3]) -> usize {
    let mut axis = 0;
    if edges[1] >= edges[0] + EPS {
        axis = 1;
    }
    if edges[2] >= edges[axis] + EPS {
        axis = 2;
    }
    axis
}
