//! Linear-quadratic regulators: the feedback `u = -K x` that minimises the sum, or the integral, of `x' Q x + u' R u` of a linear
//! system. The discrete Riccati equation is solved by doubling (Chu, Fan, Lin and Wang, Structure-preserving algorithms for periodic
//! discrete-time algebraic Riccati equations, International Journal of Control 77, 2004), the continuous one by the sign of its
//! Hamiltonian (Roberts, Linear model reduction and solution of the algebraic Riccati equation by use of the sign function,
//! International Journal of Control 32, 1980).

use super::NoSolution;
use nalgebra::DMatrix;

/// Iterations after which a solution is given up; both methods converge quadratically.
const ITERATIONS: usize = 100;
/// Relative change at which an iteration has converged.
const CONVERGED: f64 = 1e-12;
/// Relative residual that a solution may have.
const RESIDUAL: f64 = 1e-6;

/// The optimal feedback of a linear system.
#[derive(Clone, Debug, PartialEq)]
pub struct Regulator {
    /// Feedback, controls by states: `u = -gain x`.
    pub gain: DMatrix<f64>,
    /// What is still to be paid from a state: `x' cost x`.
    pub cost: DMatrix<f64>,
}

impl Regulator {
    /// Adds the feedback to `controls`, for a state that is `error` away from where it should be.
    pub fn feed_back(&self, error: &[f64], controls: &mut [f64]) {
        for (k, control) in controls.iter_mut().enumerate() {
            *control -= error.iter().enumerate().map(|(i, error)| self.gain[(k, i)] * error).sum::<f64>();
        }
    }

    /// What is still to be paid from a state that is `error` away.
    pub fn to_pay(&self, error: &[f64]) -> f64 {
        let row = |i: usize| error.iter().enumerate().map(|(j, e)| self.cost[(i, j)] * e).sum::<f64>();
        error.iter().enumerate().map(|(i, e)| e * row(i)).sum()
    }
}

/// The regulator of `x' = a x + b u` from step to step, with the cost `x' q x + u' r u` a step.
///
/// ```
/// use nalgebra::DMatrix;
/// use robohive_control::maths::discrete;
///
/// // A number that doubles with every step, and what brings it back.
/// let [one, two] = [1.0, 2.0].map(|x| DMatrix::from_element(1, 1, x));
/// let regulator = discrete(&two, &one, &one, &one)?;
/// assert!((regulator.cost[0] - (2.0 + 5.0_f64.sqrt())).abs() < 1e-12);
/// # Ok::<(), robohive_control::maths::NoSolution>(())
/// ```
///
/// # Errors
/// Shapes that do not fit; an `r` that is not positive; a system that no feedback steadies.
pub fn discrete(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    q: &DMatrix<f64>,
    r: &DMatrix<f64>,
) -> Result<Regulator, NoSolution> {
    check_shapes(a, b, q, r)?;
    let n = a.nrows();
    let identity = DMatrix::identity(n, n);
    let inverse_of_r = inverse(r.clone(), "the weights of the controls have no inverse")?;
    let (mut drift, mut reach, mut cost) = (a.clone(), b * inverse_of_r * b.transpose(), q.clone());
    for _ in 0..ITERATIONS {
        let middle = inverse(&identity + &reach * &cost, "an iteration is singular")?;
        let next = &cost + drift.transpose() * &cost * &middle * &drift;
        let change = (&next - &cost).norm();
        reach = &reach + &drift * &middle * &reach * drift.transpose();
        drift = &drift * &middle * &drift;
        cost = symmetric(next);
        if change <= CONVERGED * cost.norm() {
            break;
        }
    }
    let weight = r + b.transpose() * &cost * b;
    let gain = inverse(weight, "the weights of the controls are not positive")? * b.transpose() * &cost * a;
    let residual = q + a.transpose() * &cost * (a - b * &gain) - &cost;
    settled(Regulator { gain, cost }, &residual)
}

/// The regulator of `dx/dt = a x + b u`, with the cost `x' q x + u' r u` a second.
///
/// # Errors
/// As [`discrete`].
pub fn continuous(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    q: &DMatrix<f64>,
    r: &DMatrix<f64>,
) -> Result<Regulator, NoSolution> {
    check_shapes(a, b, q, r)?;
    let n = a.nrows();
    let inverse_of_r = inverse(r.clone(), "the weights of the controls have no inverse")?;
    let reach = b * &inverse_of_r * b.transpose();
    let mut sign = DMatrix::zeros(2 * n, 2 * n);
    sign.view_mut((0, 0), (n, n)).copy_from(a);
    sign.view_mut((0, n), (n, n)).copy_from(&-&reach);
    sign.view_mut((n, 0), (n, n)).copy_from(&-q);
    sign.view_mut((n, n), (n, n)).copy_from(&-a.transpose());
    for _ in 0..ITERATIONS {
        let inverted = inverse(sign.clone(), "a mode can be neither steadied nor seen")?;
        // Scaling by the norms brings the first iterations near.
        let scale = (inverted.norm() / sign.norm()).sqrt();
        let next = (&sign * scale + inverted / scale) * 0.5;
        let change = (&next - &sign).norm();
        sign = next;
        if change <= CONVERGED * sign.norm() {
            break;
        }
    }
    // The stable subspace, spanned by (1, cost): (sign + 1) (1, cost) = 0.
    sign += DMatrix::identity(2 * n, 2 * n);
    let left = sign.columns(n, n).clone_owned();
    let right = -sign.columns(0, n);
    let solved = left.svd(true, true).solve(&right, f64::EPSILON);
    let cost = symmetric(solved.map_err(|why| NoSolution::new("Riccati", why))?);
    let gain = inverse_of_r * b.transpose() * &cost;
    let residual = a.transpose() * &cost + &cost * a - &cost * reach * &cost + q;
    settled(Regulator { gain, cost }, &residual)
}

/// A regulator whose equation is solved.
fn settled(regulator: Regulator, residual: &DMatrix<f64>) -> Result<Regulator, NoSolution> {
    let (left, cost) = (residual.norm(), regulator.cost.norm());
    let fine = left.is_finite() && left <= RESIDUAL * cost.max(1.0);
    let why = "no feedback steadies the system, or its state costs nothing";
    if fine { Ok(regulator) } else { Err(NoSolution::new("Riccati", why)) }
}

fn check_shapes(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    q: &DMatrix<f64>,
    r: &DMatrix<f64>,
) -> Result<(), NoSolution> {
    let (n, m) = b.shape();
    for (name, matrix, shape) in [("a", a, (n, n)), ("q", q, (n, n)), ("r", r, (m, m))] {
        if matrix.shape() != shape {
            let (rows, columns) = matrix.shape();
            let message =
                format!("b is {n} x {m}, so {name} is {} x {}, not {rows} x {columns}", shape.0, shape.1);
            return Err(NoSolution::new("Riccati", message));
        }
    }
    Ok(())
}

fn inverse(matrix: DMatrix<f64>, why: &str) -> Result<DMatrix<f64>, NoSolution> {
    matrix.try_inverse().ok_or_else(|| NoSolution::new("Riccati", why))
}

fn symmetric(matrix: DMatrix<f64>) -> DMatrix<f64> {
    (&matrix + matrix.transpose()) * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The double integrator with unit weights: cost [[sqrt 3, 1], [1, sqrt 3]], gain [1, sqrt 3].
    #[test]
    fn a_double_integrator_has_the_known_regulator() {
        let (a, b) = (dmatrix![0.0, 1.0; 0.0, 0.0], dmatrix![0.0; 1.0]);
        let regulator = continuous(&a, &b, &DMatrix::identity(2, 2), &dmatrix![1.0]).unwrap();
        let root = 3.0_f64.sqrt();
        assert!((regulator.cost - dmatrix![root, 1.0; 1.0, root]).norm() < 1e-9);
        assert!((regulator.gain - dmatrix![1.0, root]).norm() < 1e-9);
    }

    /// From step to step, a short step gives the continuous regulator.
    #[test]
    fn short_steps_approach_the_continuous_regulator() {
        let dt = 1e-3;
        let (a, b) = (dmatrix![1.0, dt; 0.0, 1.0], dmatrix![dt * dt / 2.0; dt]);
        let (q, r) = (DMatrix::identity(2, 2) * dt, dmatrix![dt]);
        let regulator = discrete(&a, &b, &q, &r).unwrap();
        assert!((regulator.gain - dmatrix![1.0, 3.0_f64.sqrt()]).norm() < 5e-3);
    }

    /// What the regulator pays along its motion is what its cost says, and every other gain pays more.
    #[test]
    fn the_cost_is_paid_and_no_gain_pays_less() {
        let (a, b) = (dmatrix![1.1, 0.3; -0.2, 0.9], dmatrix![0.1; 0.5]);
        let (q, r) = (dmatrix![2.0, 0.0; 0.0, 1.0], dmatrix![0.5]);
        let regulator = discrete(&a, &b, &q, &r).unwrap();
        let paid = |gain: &DMatrix<f64>| {
            let mut x = dmatrix![1.0; -0.5];
            (0..500).fold(0.0, |sum, _| {
                let u = -gain * &x;
                let now = (x.transpose() * &q * &x)[0] + (u.transpose() * &r * &u)[0];
                x = &a * &x + &b * u;
                sum + now
            })
        };
        let least = paid(&regulator.gain);
        assert!((least - regulator.to_pay(&[1.0, -0.5])).abs() < 1e-9);
        for other in [dmatrix![0.05, 0.0], dmatrix![0.0, -0.05]] {
            assert!(paid(&(&regulator.gain + other)) > least);
        }
    }

    #[test]
    fn impossible_systems_are_refused() {
        let error =
            |a, b| discrete(&a, &b, &DMatrix::identity(2, 2), &dmatrix![1.0]).unwrap_err().to_string();
        let unreachable = error(dmatrix![2.0, 0.0; 0.0, 1.0], dmatrix![0.0; 1.0]);
        assert!(unreachable.contains("Riccati"), "{unreachable}");
        let shape = error(dmatrix![1.0], dmatrix![0.0; 1.0]);
        assert!(shape.contains("a is 2 x 2, not 1 x 1"), "{shape}");
    }
}
