//! Best tangential force of one contact for a given normal force: a quadratic program with one quadratic constraint,
//! `min ½ xᵀ A x + xᵀ b` subject to `Σ (xᵢ / μᵢ)² ≤ r²`.
//!
//! With `xᵢ = μᵢ yᵢ` the ellipsoid is a ball. Where the free minimum is outside the ball, the best point of its surface
//! is the minimum with a multiplier `λ` added to the diagonal, `y(λ) = -(A + λ)⁻¹ b`, for which `|y(λ)| = r`. The
//! length falls with `λ` and is convex, so that Newton's method climbs to the multiplier from zero.

use super::dual::project_ellipsoid;
use crate::math::cholesky::{cholesky_factor, cholesky_solve, stride};
use crate::math::dense::dot_slice;

/// Iterations, and the threshold of pivots, constraint violation and multiplier steps.
const ITERATIONS: usize = 20;
const SMALL: f64 = 1e-10;

/// Replaces `force[1..]` by the optimum for normal force `force[0]`.
pub(super) fn friction_force(force: &mut [f64], a: &[f64], b: &[f64], mu: &[f64]) {
    let (normal, n) = (force[0], force.len() - 1);
    let program = Program { a, b, mu, n };
    let best = match n {
        2 => on_ball(normal, program.planar()),
        3 => on_ball(normal, program.spatial()),
        _ => on_ball(normal, program.factored()),
    };
    let Best { y, bound } = best.unwrap_or_default();
    for k in 0..n {
        force[k + 1] = y[k] * mu[k];
    }
    if bound {
        project_ellipsoid(&mut force[1..], normal, mu, false);
    }
}

/// The best point in the ball.
#[derive(Default)]
struct Best {
    y: [f64; 5],
    /// The ball keeps it from the free minimum.
    bound: bool,
}

/// The minimum for one multiplier.
struct Minimum {
    y: [f64; 5],
    /// `|y|²`.
    length2: f64,
    /// Its derivative by the multiplier.
    slope: f64,
}

/// Finds the multiplier for which `minimum` lies on the ball of this radius, or zero when the free minimum lies
/// within; `None` where the matrix is not positive definite.
fn on_ball(radius: f64, minimum: impl Fn(f64) -> Option<Minimum>) -> Option<Best> {
    let (mut multiplier, mut y) = (0.0, [0.0; 5]);
    for _ in 0..ITERATIONS {
        let found = minimum(multiplier)?;
        y = found.y;
        let excess = found.length2 - radius * radius;
        let step = -excess / found.slope;
        let grows = excess >= SMALL && step >= SMALL;
        if !grows {
            break;
        }
        multiplier += step;
    }
    Some(Best { y, bound: multiplier != 0.0 })
}

/// The quadratic function and the axes of the ellipsoid.
struct Program<'a> {
    a: &'a [f64],
    b: &'a [f64],
    mu: &'a [f64],
    n: usize,
}

impl Program<'_> {
    /// Entry of the matrix where the ellipsoid is a ball.
    fn entry(&self, i: usize, j: usize) -> f64 {
        self.a[i * self.n + j] * self.mu[i] * self.mu[j]
    }

    fn linear<const N: usize>(&self) -> [f64; N] {
        std::array::from_fn(|i| self.b[i] * self.mu[i])
    }

    /// Two dimensions, with an explicit inverse.
    fn planar(&self) -> impl Fn(f64) -> Option<Minimum> {
        let (diagonal, off, b): (_, _, [f64; 2]) =
            ([0, 1].map(|i| self.entry(i, i)), self.entry(0, 1), self.linear());
        move |multiplier| {
            let [first, second] = diagonal.map(|x| x + multiplier);
            let det = first * second - off * off;
            if det < SMALL {
                return None;
            }
            let inverse = 1.0 / det;
            let (p, q, mixed) = (second * inverse, first * inverse, -off * inverse);
            let y = [-p * b[0] - mixed * b[1], -mixed * b[0] - q * b[1]];
            let slope = -2.0 * (p * y[0] * y[0] + 2.0 * mixed * y[0] * y[1] + q * y[1] * y[1]);
            Some(Minimum { y: [y[0], y[1], 0.0, 0.0, 0.0], length2: y[0] * y[0] + y[1] * y[1], slope })
        }
    }

    /// Three dimensions, with an explicit inverse. Entries off the diagonal are numbered by the axis that they leave
    /// out, so that the cofactors of both kinds have one formula each.
    fn spatial(&self) -> impl Fn(f64) -> Option<Minimum> {
        let off = [self.entry(1, 2), self.entry(0, 2), self.entry(0, 1)];
        let (diagonal, b): (_, [f64; 3]) = ([0, 1, 2].map(|i| self.entry(i, i)), self.linear());
        move |multiplier| {
            let shifted = diagonal.map(|x| x + multiplier);
            let others = |k: usize| [(k + 1) % 3, (k + 2) % 3];
            let on_diagonal = [0, 1, 2].map(|k| {
                let [i, j] = others(k);
                shifted[i] * shifted[j] - off[k] * off[k]
            });
            let off_diagonal = [0, 1, 2].map(|k| {
                let [i, j] = others(k);
                off[i] * off[j] - off[k] * shifted[k]
            });
            let det = shifted[0] * on_diagonal[0] + off[2] * off_diagonal[2] + off[1] * off_diagonal[1];
            if det < SMALL {
                return None;
            }
            let inverse = 1.0 / det;
            let (p, q) = (on_diagonal.map(|x| x * inverse), off_diagonal.map(|x| x * inverse));
            let rows = [[p[0], q[2], q[1]], [q[2], p[1], q[0]], [q[1], q[0], p[2]]];
            let [x, y, z] = rows.map(|row| -row[0] * b[0] - row[1] * b[1] - row[2] * b[2]);
            let squares = p[0] * x * x + p[1] * y * y + p[2] * z * z;
            let mixed = q[2] * x * y + q[1] * x * z + q[0] * y * z;
            let slope = -2.0 * squares - 4.0 * mixed;
            Some(Minimum { y: [x, y, z, 0.0, 0.0], length2: x * x + y * y + z * z, slope })
        }
    }

    /// Up to five dimensions, with a Cholesky factor.
    fn factored(&self) -> impl Fn(f64) -> Option<Minimum> {
        let (n, stride) = (self.n, stride(self.n));
        let (mut matrix, mut b) = ([0.0; 5 * crate::math::cholesky::stride(5)], [0.0; 5]);
        for i in 0..n {
            b[i] = self.b[i] * self.mu[i];
            for j in 0..n {
                matrix[i * stride + j] = self.entry(i, j);
            }
        }
        move |multiplier| {
            let mut factor = matrix;
            for i in 0..n {
                factor[i * (stride + 1)] += multiplier;
            }
            if cholesky_factor(&mut factor, n, SMALL) < n {
                return None;
            }
            let mut y = b;
            cholesky_solve(&factor, n, &mut y[..n]);
            y[..n].iter_mut().for_each(|x| *x = -*x);
            let mut twice = y;
            cholesky_solve(&factor, n, &mut twice[..n]);
            let slope = -2.0 * dot_slice(&y[..n], &twice[..n]);
            Some(Minimum { y, length2: dot_slice(&y[..n], &y[..n]), slope })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Explicit inverses and the Cholesky version agree, lie on the ellipsoid, and beat their neighbours there.
    #[test]
    fn optimum_lies_on_the_ellipsoid() {
        let a = [4.0, 1.0, 0.5, 1.0, 3.0, 0.2, 0.5, 0.2, 2.0];
        let (b, mu) = ([-9.0, 5.0, 7.0], [0.8, 0.5, 0.3]);
        let program = Program { a: &a, b: &b, mu: &mu, n: 3 };
        let (explicit, factored) =
            (on_ball(1.5, program.spatial()).unwrap(), on_ball(1.5, program.factored()).unwrap());
        assert!(explicit.bound && factored.bound);
        let x: [f64; 3] = std::array::from_fn(|k| explicit.y[k] * mu[k]);
        let size = (0..3).map(|k| (x[k] / mu[k]).powi(2)).sum::<f64>();
        assert!((size - 2.25).abs() < 1e-8);
        let cost =
            |x: &[f64]| (0..3).map(|i| x[i] * (b[i] + 0.5 * dot_slice(&a[3 * i..3 * i + 3], x))).sum::<f64>();
        for k in 0..3 {
            assert!((explicit.y[k] - factored.y[k]).abs() < 1e-8);
            for h in [-1e-3, 1e-3] {
                let mut near = x;
                near[k] += h;
                project_ellipsoid(&mut near, 1.5, &mu, false);
                assert!(cost(&near) > cost(&x));
            }
        }
    }

    #[test]
    fn interior_optimum_is_unconstrained() {
        let program = Program { a: &[2.0, 0.0, 0.0, 4.0], b: &[-0.2, 0.4], mu: &[1.0, 1.0], n: 2 };
        let Best { y, bound } = on_ball(1.0, program.planar()).unwrap();
        assert!(!bound && (y[0] - 0.1).abs() < 1e-15 && (y[1] + 0.1).abs() < 1e-15);
    }
}
