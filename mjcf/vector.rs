//! Three-vector and quaternion arithmetic of the compiler. Where it differs from `physics::math` it
//! divides by a length instead of multiplying by its inverse, as MuJoCo's compiler does: the bits of
//! compiled meshes depend on it.

pub(crate) use physics::math::{cross, dot, mul_mat_vec as apply, quat_to_mat as matrix, sub, transpose};
use physics::math::{principal_axes_by, quat_rotate};

/// Lengths below this do not define a direction.
pub(crate) const EPS: f64 = 1e-14;

/// Scales to unit length in place and returns the old length; shorter than 1e-7 stays and gives 0.
pub(crate) fn normalize<const N: usize>(v: &mut [f64; N]) -> f64 {
    let mut squared = 0.0;
    for x in v.iter() {
        squared += x * x;
    }
    if squared < EPS {
        return 0.0;
    }
    let length = squared.sqrt();
    if (length - 1.0).abs() > EPS {
        for x in v.iter_mut() {
            *x /= length;
        }
    }
    length
}

/// Quaternion product, normalised.
pub(crate) fn compose(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    let mut q = physics::math::quat_mul(a, b);
    normalize(&mut q);
    q
}

/// `v` rotated by the unit quaternion `q`.
pub(crate) fn rotate(v: [f64; 3], q: [f64; 4]) -> [f64; 3] {
    quat_rotate(q, v)
}

/// Eigenvalues of a symmetric matrix in decreasing order and the orientation of their axes.
pub(crate) fn principal_axes(m: &[f64; 9]) -> ([f64; 3], [f64; 4]) {
    principal_axes_by(m, |mut q| {
        normalize(&mut q);
        q
    })
}
