//! Nonlinear least squares within bounds, by Levenberg and Marquardt's method (Marquardt, "An algorithm for least-squares
//! estimation of nonlinear parameters", 1963) with the damping of Nielsen ("Damping parameter in Marquardt's method", 1999).
//! Values at a bound that the gradient pushes out of it are held there for a step (projected: Kanzow, Yamashita and Fukushima,
//! 2004); others are cut off at their bounds.

use crate::error::IdentifyError;
use crate::problem::Problem;
use nalgebra::{Cholesky, DMatrix, DVector};

/// Ends: a step's share of the values, of the objective, the gradient's share of the first one.
const SMALL_STEP: f64 = 1e-9;
const SMALL_REDUCTION: f64 = 1e-10;
const SMALL_GRADIENT: f64 = 1e-10;
/// First damping, and the largest, over the diagonal.
const FIRST: f64 = 1e-3;
const LARGEST: f64 = 1e12;

/// The course of a fit: half the sum of squares, and the values, at each iteration.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Trace {
    /// Half the sum of squares.
    pub objective: f64,
    /// The values.
    pub values: Vec<f64>,
}

/// Where a minimisation ended.
pub(crate) struct Minimum {
    pub values: Vec<f64>,
    /// Residuals of readings.
    pub residual: Vec<f64>,
    /// Their derivatives by values over scales, column by column.
    pub jacobian: Vec<Vec<f64>>,
    pub trace: Vec<Trace>,
}

/// The quadratic model at a point, in values over scales.
struct Local {
    hessian: DMatrix<f64>,
    gradient: DVector<f64>,
}

/// Minimises from a point.
///
/// # Errors
/// A simulation fails at the first point or beside an accepted one; those at points that are only tried are no errors.
pub(crate) fn minimise(
    problem: &Problem<'_>,
    start: &[f64],
    measured: &[f64],
    iterations: usize,
) -> Result<Minimum, IdentifyError> {
    let mut values = start.to_vec();
    let mut residual = problem.residual(&values, measured)?;
    let mut objective = half_square(&residual);
    let mut trace = vec![Trace { objective, values: values.clone() }];
    let (mut damping, mut growth, mut first) = (FIRST, 2.0, None);
    let mut jacobian = problem.jacobian(&values, measured)?;
    for _ in 0..iterations {
        let local = local(problem, &values, &jacobian, &residual);
        let held = held(problem, &values, local.gradient.as_slice());
        let slope = local
            .gradient
            .iter()
            .zip(&held)
            .filter(|(_, held)| !**held)
            .map(|(g, _)| g.abs())
            .fold(0.0, f64::max);
        if slope <= SMALL_GRADIENT * *first.get_or_insert(slope.max(f64::MIN_POSITIVE)) {
            break;
        }
        let mut moved = false;
        while damping <= LARGEST {
            let Some((point, promised, length)) = step(problem, &values, &local, &held, damping) else {
                (damping, growth) = (damping * growth, growth * 2.0);
                continue;
            };
            let tried = problem.residual(&point, measured).ok();
            let gain = tried.as_ref().map_or(f64::NEG_INFINITY, |r| objective - half_square(r));
            if let Some(new) = tried.filter(|_| gain > 0.0) {
                let ratio = if promised > 0.0 { gain / promised } else { 1.0 };
                let inner = 2.0 * ratio - 1.0;
                damping *= (1.0 - inner * inner * inner).max(1.0 / 3.0);
                growth = 2.0;
                moved = gain > SMALL_REDUCTION * objective && length > SMALL_STEP;
                (values, residual, objective) = (point, new, objective - gain);
                trace.push(Trace { objective, values: values.clone() });
                jacobian = problem.jacobian(&values, measured)?;
                break;
            }
            if length <= SMALL_STEP {
                break;
            }
            (damping, growth) = (damping * growth, growth * 2.0);
        }
        if !moved {
            break;
        }
    }
    residual.truncate(measured.len());
    Ok(Minimum { values, residual, jacobian, trace })
}

fn half_square(residual: &[f64]) -> f64 {
    0.5 * residual.iter().map(|r| r * r).sum::<f64>()
}

/// `J'J`.
pub(crate) fn normal(jacobian: &[Vec<f64>]) -> DMatrix<f64> {
    let n = jacobian.len();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    DMatrix::from_fn(n, n, |r, c| dot(&jacobian[r], &jacobian[c]))
}

/// Gradient and Gauss and Newton's Hessian, priors included.
fn local(problem: &Problem<'_>, values: &[f64], jacobian: &[Vec<f64>], residual: &[f64]) -> Local {
    let mut hessian = normal(jacobian);
    let slope = |column: &Vec<f64>| column.iter().zip(residual).map(|(j, r)| j * r).sum();
    let mut gradient = DVector::from_iterator(values.len(), jacobian.iter().map(slope));
    for (i, p) in problem.parameters.iter().enumerate() {
        if let Some(prior) = p.prior {
            let slope = p.scale / prior.deviation;
            hessian[(i, i)] += slope * slope;
            gradient[i] += slope * (values[i] - prior.mean) / prior.deviation;
        }
    }
    Local { hessian, gradient }
}

/// Values at a bound that descent would leave.
fn held(problem: &Problem<'_>, values: &[f64], gradient: &[f64]) -> Vec<bool> {
    let all = problem.parameters.iter().zip(values).zip(gradient);
    all.map(|((p, &x), &g)| (x <= p.lower && g > 0.0) || (x >= p.upper && g < 0.0)).collect()
}

/// The point after a step, the reduction that the quadratic model promises, and the step's length over the values.
fn step(
    problem: &Problem<'_>,
    values: &[f64],
    local: &Local,
    held: &[bool],
    damping: f64,
) -> Option<(Vec<f64>, f64, f64)> {
    let n = values.len();
    let most = local.hessian.diagonal().iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let mut matrix = local.hessian.clone();
    let mut change = -&local.gradient;
    for i in 0..n {
        matrix[(i, i)] += damping * local.hessian[(i, i)].max(1e-9 * most);
    }
    for i in (0..n).filter(|&i| held[i]) {
        matrix.fill_row(i, 0.0);
        matrix.fill_column(i, 0.0);
        (matrix[(i, i)], change[i]) = (1.0, 0.0);
    }
    Cholesky::new(matrix)?.solve_mut(&mut change);
    let all = problem.parameters.iter().zip(values).zip(&change);
    let point: Vec<f64> = all.map(|((p, &x), &dz)| (x + p.scale * dz).clamp(p.lower, p.upper)).collect();
    let all = problem.parameters.iter().zip(values).zip(&point);
    let taken = DVector::from_iterator(n, all.map(|((p, x), y)| (y - x) / p.scale));
    let promised = -local.gradient.dot(&taken) - 0.5 * taken.dot(&(&local.hessian * &taken));
    Some((point, promised, taken.norm()))
}
