//! Body inertia: sums of parts about their common centre of mass, and its principal axes.

use super::frame::Pose;
use crate::vector::{EPS, matrix, principal_axes, sub};
use physics::math::{Quat, Vec3};
use physics::model::bounds::MINVAL;

/// Mass and principal moments in the frame of a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MassPart {
    pub mass: f64,
    pub inertia: Vec3,
    pub pose: Pose,
}

/// Principal moments (decreasing) and axes of `xx yy zz xy xz yz`.
pub(super) fn principal(full: [f64; 6]) -> Result<(Vec3, Quat), String> {
    let [xx, yy, zz, xy, xz, yz] = full;
    let (moments, quat) = principal_axes(&[xx, xy, xz, xy, yy, yz, xz, yz, zz]);
    if moments[2] < EPS || moments[2].is_nan() {
        return Err("a principal moment of inertia is not above 0: check 'fullinertia', or the shapes that mass comes from".into());
    }
    Ok((moments, quat))
}

/// One body out of several parts; `Ok(None)` without mass.
pub(super) fn combine(parts: &[MassPart]) -> Result<Option<MassPart>, String> {
    sum(parts, |total, own, shift| total + own + shift)
}

/// A body and one that is welded to it; `Ok(None)` without mass. It rounds as MuJoCo's `fusestatic` does, which is not
/// how the parts of one body are summed.
pub(super) fn fuse(body: MassPart, welded: MassPart) -> Result<Option<MassPart>, String> {
    sum(&[body, welded], |total, own, shift| total + (own + shift))
}

/// Sum of parts, where `add` adds to an element of the inertia what a part has about its own centre and what its offset
/// adds.
fn sum(parts: &[MassPart], add: impl Fn(f64, f64, f64) -> f64) -> Result<Option<MassPart>, String> {
    let mut mass = 0.0;
    let mut com = [0.0; 3];
    for part in parts {
        mass += part.mass;
        for k in 0..3 {
            com[k] += part.mass * part.pose.pos[k];
        }
    }
    if mass < MINVAL {
        return Ok(None);
    }
    let com = com.map(|x| x / mass);
    let mut total = [0.0; 6];
    for part in parts {
        let own = in_parent_axes(part.inertia, part.pose.quat);
        let shift = about_offset(part.mass, sub(part.pose.pos, com));
        for k in 0..6 {
            total[k] = add(total[k], own[k], shift[k]);
        }
    }
    let (inertia, quat) = principal(total)?;
    Ok(Some(MassPart { mass, inertia, pose: Pose { pos: com, quat } }))
}

/// `R diag(moments) Rᵀ` as xx yy zz xy xz yz.
fn in_parent_axes(moments: Vec3, quat: Quat) -> [f64; 6] {
    let m = matrix(quat);
    // t[3 i + j]: moment i times element (j, i) of the rotation.
    let t: [f64; 9] = std::array::from_fn(|k| m[3 * (k % 3) + k / 3] * moments[k / 3]);
    let product = |r: usize, c: usize| m[3 * r] * t[c] + m[3 * r + 1] * t[3 + c] + m[3 * r + 2] * t[6 + c];
    [product(0, 0), product(1, 1), product(2, 2), product(0, 1), product(0, 2), product(1, 2)]
}

/// Inertia of a point mass at `d` (parallel axis theorem).
fn about_offset(mass: f64, d: Vec3) -> [f64; 6] {
    [
        mass * (d[1] * d[1] + d[2] * d[2]),
        mass * (d[0] * d[0] + d[2] * d[2]),
        mass * (d[0] * d[0] + d[1] * d[1]),
        -mass * d[0] * d[1],
        -mass * d[0] * d[2],
        -mass * d[1] * d[2],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_half_boxes_are_one_box() {
        // A box of 0.2 x 0.4 x 0.6 cut in the middle of its x side.
        let half = |x: f64| MassPart {
            mass: 1.5,
            inertia: [1.5 * (0.04 + 0.09) / 3.0, 1.5 * (0.0025 + 0.09) / 3.0, 1.5 * (0.0025 + 0.04) / 3.0],
            pose: Pose { pos: [x, 0.1, -0.2], ..Pose::IDENTITY },
        };
        let whole = combine(&[half(0.05), half(-0.05)]).unwrap().unwrap();
        let expected = [3.0 * (0.04 + 0.09) / 3.0, 3.0 * (0.01 + 0.09) / 3.0, 3.0 * (0.01 + 0.04) / 3.0];
        assert!(same_sorted(whole.inertia, expected));
        assert!((whole.pose.pos[1] - 0.1).abs() < 1e-15 && whole.mass == 3.0);
    }

    fn same_sorted(a: Vec3, mut b: Vec3) -> bool {
        b.sort_by(|x, y| y.total_cmp(x));
        (0..3).all(|k| (a[k] - b[k]).abs() < 1e-14)
    }
}
