//! The rotation in a deformation (Müller et al., A robust method to extract the rotational part of deformations, 2016).

use crate::math::{
    IDENTITY, Mat3, Quat, add, column, cross, dot, normalize, quat_from_axis_angle, quat_mul, quat_normalize,
    quat_to_mat, scale,
};
use crate::model::bounds::MINVAL;

const MAX_ITERATIONS: usize = 500;
/// Turns below this end the search \[rad\].
const TOLERANCE: f64 = 1e-9;

/// The rotation nearest to a matrix, found by turning from no rotation.
pub(super) fn rotation_of(mat: &Mat3) -> Quat {
    let mut quat = IDENTITY;
    for _ in 0..MAX_ITERATIONS {
        let now = quat_to_mat(quat);
        let pair = |k: usize| (column(&now, k), column(mat, k));
        let turn = |k: usize| cross(pair(k).0, pair(k).1);
        let along = |k: usize| dot(pair(k).0, pair(k).1);
        let total = add(add(turn(0), turn(1)), turn(2));
        let (axis, angle) = normalize(scale(total, 1.0 / ((along(0) + along(1) + along(2)).abs() + MINVAL)));
        if angle < TOLERANCE {
            break;
        }
        quat = quat_normalize(quat_mul(quat_from_axis_angle(axis, angle), quat));
    }
    quat
}
