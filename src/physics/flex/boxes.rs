//! Bounding boxes of elements, and the trees of boxes above them.

use crate::model::flex::{Flex, range};
use crate::model::{Disable, Model};
use crate::stages::Flexes;

/// The smaller of two numbers; unlike `f64::min` a single instruction.
fn min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers.
fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Computes `flexelem_aabb`: boxes along the world's axes, inflated by the radius.
pub(super) fn elements(m: &Model, out: &mut Flexes) {
    for flex in Flex::all(m) {
        let (points, radius) = (&out.flexvert_xpos[flex.vertices()], flex.radius());
        let corners = flex.corners().chunks_exact(flex.dim() + 1);
        for (aabb, corners) in out.flexelem_aabb[flex.elements()].iter_mut().zip(corners) {
            let first = points[corners[0] as usize];
            let (mut least, mut most) = (first, first);
            for &corner in &corners[1..] {
                let point = points[corner as usize];
                for i in 0..3 {
                    least[i] = min(least[i], point[i]);
                    most[i] = max(most[i], point[i]);
                }
            }
            for i in 0..3 {
                aabb[i] = 0.5 * (most[i] + least[i]);
                aabb[3 + i] = 0.5 * (most[i] - least[i]) + radius;
            }
        }
    }
}

/// Computes `bvh_aabb_dyn` from the boxes of elements; children come after their parents.
pub(super) fn trees(m: &Model, out: &mut Flexes) {
    if m.opt.disableflags.contains(Disable::MIDPHASE) {
        return;
    }
    for flex in Flex::all(m) {
        let Ok(root) = usize::try_from(m.flex_bvhadr[flex.id]) else { continue };
        let (first_box, first_element) = (root - m.nbvhstatic, flex.elements().start);
        for node in range(m.flex_bvhadr[flex.id], m.flex_bvhnum[flex.id]).rev() {
            let aabb = match usize::try_from(m.bvh_nodeid[node]) {
                Ok(element) => out.flexelem_aabb[first_element + element],
                Err(_) => {
                    let [a, b] = m.bvh_child[node].map(|c| &out.bvh_aabb_dyn[first_box + c as usize]);
                    around(a, b)
                }
            };
            out.bvh_aabb_dyn[node - m.nbvhstatic] = aabb;
        }
    }
}

/// Box around two boxes (centre, half sizes).
fn around(a: &[f64; 6], b: &[f64; 6]) -> [f64; 6] {
    let mut out = [0.0; 6];
    for k in 0..3 {
        let least = min(a[k] - a[k + 3], b[k] - b[k + 3]);
        let most = max(a[k] + a[k + 3], b[k] + b[k + 3]);
        out[k] = 0.5 * (most + least);
        out[k + 3] = 0.5 * (most - least);
    }
    out
}
