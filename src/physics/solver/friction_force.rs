//! Best tangential force of one contact for a given normal force: a quadratic program with one quadratic constraint,
//! `min ½ xᵀ A x + xᵀ b` subject to `Σ (xᵢ / μᵢ)² ≤ r²`, by Newton's method on the multiplier.

use super::dual::project_ellipsoid;
use crate::math::cholesky::{cholesky_factor, cholesky_solve, stride};
use crate::math::dense::dot_slice;

/// Iterations, and the threshold of pivots, constraint violation and multiplier steps.
const ITERATIONS: usize = 20;
const SMALL: f64 = 1e-10;

/// Replaces `force[1..]` by the optimum for normal force `force[0]`.
pub(super) fn friction_force(force: &mut [f64], a: &[f64], b: &[f64], mu: &[f64]) {
    let (normal, n) = (force[0], force.len() - 1);
    let mut x = [0.0; 5];
    let bound = match n {
        2 => solve2(&mut x, a, b, mu, normal),
        3 => solve3(&mut x, a, b, mu, normal),
        _ => solve(&mut x[..n], a, b, mu, normal),
    };
    if bound {
        project_ellipsoid(&mut x[..n], normal, mu, false);
    }
    force[1..].copy_from_slice(&x[..n]);
}

/// Next multiplier, or `None` when the constraint holds or the step is small.
fn advance(la: f64, violation: f64, derivative: f64) -> Option<f64> {
    if violation < SMALL {
        return None;
    }
    let step = -violation / derivative;
    (step >= SMALL).then_some(la + step)
}

/// Two dimensions, with an explicit inverse; true when the constraint is active.
fn solve2(x: &mut [f64; 5], a: &[f64], b: &[f64], mu: &[f64], r: f64) -> bool {
    let (b1, b2) = (b[0] * mu[0], b[1] * mu[1]);
    let (a11, a22, a12) = (a[0] * mu[0] * mu[0], a[3] * mu[1] * mu[1], a[1] * mu[0] * mu[1]);
    let (mut la, mut v1, mut v2) = (0.0, 0.0, 0.0);
    for _ in 0..ITERATIONS {
        let det = (a11 + la) * (a22 + la) - a12 * a12;
        if det < SMALL {
            (x[0], x[1]) = (0.0, 0.0);
            return false;
        }
        let inverse = 1.0 / det;
        let (p11, p22, p12) = ((a22 + la) * inverse, (a11 + la) * inverse, -a12 * inverse);
        (v1, v2) = (-p11 * b1 - p12 * b2, -p12 * b1 - p22 * b2);
        let derivative = -2.0 * (p11 * v1 * v1 + 2.0 * p12 * v1 * v2 + p22 * v2 * v2);
        match advance(la, v1 * v1 + v2 * v2 - r * r, derivative) {
            Some(next) => la = next,
            None => break,
        }
    }
    (x[0], x[1]) = (v1 * mu[0], v2 * mu[1]);
    la != 0.0
}

/// Three dimensions, with an explicit inverse; true when the constraint is active.
fn solve3(x: &mut [f64; 5], a: &[f64], b: &[f64], mu: &[f64], r: f64) -> bool {
    let [b1, b2, b3] = [b[0] * mu[0], b[1] * mu[1], b[2] * mu[2]];
    let (a11, a22, a33) = (a[0] * mu[0] * mu[0], a[4] * mu[1] * mu[1], a[8] * mu[2] * mu[2]);
    let (a12, a13, a23) = (a[1] * mu[0] * mu[1], a[2] * mu[0] * mu[2], a[5] * mu[1] * mu[2]);
    let (mut la, mut v) = (0.0, [0.0; 3]);
    for _ in 0..ITERATIONS {
        let mut p11 = (a22 + la) * (a33 + la) - a23 * a23;
        let mut p22 = (a11 + la) * (a33 + la) - a13 * a13;
        let mut p33 = (a11 + la) * (a22 + la) - a12 * a12;
        let mut p12 = a13 * a23 - a12 * (a33 + la);
        let mut p13 = a12 * a23 - a13 * (a22 + la);
        let mut p23 = a12 * a13 - a23 * (a11 + la);
        let det = (a11 + la) * p11 + a12 * p12 + a13 * p13;
        if det < SMALL {
            x[..3].fill(0.0);
            return false;
        }
        for p in [&mut p11, &mut p22, &mut p33, &mut p12, &mut p13, &mut p23] {
            *p *= 1.0 / det;
        }
        v = [
            -p11 * b1 - p12 * b2 - p13 * b3,
            -p12 * b1 - p22 * b2 - p23 * b3,
            -p13 * b1 - p23 * b2 - p33 * b3,
        ];
        let [v1, v2, v3] = v;
        let derivative = -2.0 * (p11 * v1 * v1 + p22 * v2 * v2 + p33 * v3 * v3)
            - 4.0 * (p12 * v1 * v2 + p13 * v1 * v3 + p23 * v2 * v3);
        match advance(la, v1 * v1 + v2 * v2 + v3 * v3 - r * r, derivative) {
            Some(next) => la = next,
            None => break,
        }
    }
    for k in 0..3 {
        x[k] = v[k] * mu[k];
    }
    la != 0.0
}

/// Up to five dimensions, with a Cholesky factor; true when the constraint is active.
fn solve(x: &mut [f64], a: &[f64], b: &[f64], mu: &[f64], r: f64) -> bool {
    let n = x.len();
    let (mut scaled, mut rhs, stride) = ([0.0; 5 * stride(5)], [0.0; 5], stride(n));
    for i in 0..n {
        rhs[i] = b[i] * mu[i];
        for j in 0..n {
            scaled[i * stride + j] = a[i * n + j] * mu[i] * mu[j];
        }
    }
    let mut la = 0.0;
    for _ in 0..ITERATIONS {
        let mut factor = scaled;
        for i in 0..n {
            factor[i * (stride + 1)] += la;
        }
        if cholesky_factor(&mut factor, n, SMALL) < n {
            x.fill(0.0);
            return false;
        }
        x.copy_from_slice(&rhs[..n]);
        cholesky_solve(&factor, n, x);
        x.iter_mut().for_each(|x| *x = -*x);
        let mut again = [0.0; 5];
        again[..n].copy_from_slice(x);
        cholesky_solve(&factor, n, &mut again[..n]);
        match advance(la, dot_slice(x, x) - r * r, -2.0 * dot_slice(x, &again[..n])) {
            Some(next) => la = next,
            None => break,
        }
    }
    for i in 0..n {
        x[i] *= mu[i];
    }
    la != 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Explicit inverses and the Cholesky version agree, lie on the ellipsoid, and beat their neighbours there.
    #[test]
    fn optimum_lies_on_the_ellipsoid() {
        let a = [4.0, 1.0, 0.5, 1.0, 3.0, 0.2, 0.5, 0.2, 2.0];
        let (b, mu) = ([-9.0, 5.0, 7.0], [0.8, 0.5, 0.3]);
        let (mut x, mut y) = ([0.0; 5], [0.0; 3]);
        assert!(solve3(&mut x, &a, &b, &mu, 1.5));
        assert!(solve(&mut y, &a, &b, &mu, 1.5));
        let size = (0..3).map(|k| (x[k] / mu[k]).powi(2)).sum::<f64>();
        assert!((size - 2.25).abs() < 1e-8);
        let cost = |x: &[f64]| {
            (0..3).map(|i| x[i] * (b[i] + 0.5 * dot_slice(&a[3 * i..3 * i + 3], &x[..3]))).sum::<f64>()
        };
        for k in 0..3 {
            assert!((x[k] - y[k]).abs() < 1e-8);
            for h in [-1e-3, 1e-3] {
                let mut near = x;
                near[k] += h;
                project_ellipsoid(&mut near[..3], 1.5, &mu, false);
                assert!(cost(&near) > cost(&x));
            }
        }
    }

    #[test]
    fn interior_optimum_is_unconstrained() {
        let mut x = [0.0; 5];
        assert!(!solve2(&mut x, &[2.0, 0.0, 0.0, 4.0], &[-0.2, 0.4], &[1.0, 1.0], 1.0));
        assert!((x[0] - 0.1).abs() < 1e-15 && (x[1] + 0.1).abs() < 1e-15);
    }
}
