//! The fit: rounds of least squares, each with the noise that the one before left.

use crate::error::IdentifyError;
use crate::log::Log;
use crate::minimise::{Minimum, Trace, minimise};
use crate::parameter::Parameter;
use crate::problem::Problem;
use crate::uncertainty::{Direction, Uncertainty, uncertainty};
use crate::window::windows;
use physics::Model;

/// Rounds: with the spread of readings for their noise, then twice with the noise that is left.
const ROUNDS: usize = 3;
/// The least noise of a column, as a share of its spread: no reading is believed to more.
const LEAST_NOISE: f64 = 1e-6;

/// How a fit is done.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Options {
    /// Iterations of each round, at most.
    pub iterations: usize,
    /// Simulations restart from recorded states after this time, where logs have states in every row \[s\].
    pub window: f64,
}

impl Default for Options {
    fn default() -> Self {
        Options { iterations: 50, window: f64::INFINITY }
    }
}

impl Options {
    /// Iterations of each round, at most.
    #[must_use]
    pub fn with_iterations(mut self, iterations: usize) -> Self {
        self.iterations = iterations;
        self
    }

    /// Simulations restart from recorded states after this time \[s\].
    #[must_use]
    pub fn with_window(mut self, seconds: f64) -> Self {
        self.window = seconds;
        self
    }
}

/// What was found.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Found {
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// Their values.
    pub values: Vec<f64>,
    /// Their standard deviations; infinite of those that the log cannot tell.
    pub deviations: Vec<f64>,
    /// Covariances of the values, row by row, as far as log and priors tell them.
    pub covariance: Vec<f64>,
    /// What the log cannot tell.
    pub unknown: Vec<Direction>,
    /// Names of the columns that were compared.
    pub columns: Vec<String>,
    /// The noise that is left in each column, in its unit: the root of the mean square of residuals.
    pub noise: Vec<f64>,
    /// The same before the fit.
    pub before: Vec<f64>,
    /// Correlation of successive residuals in each column: 0 of noise; near 1 the model lacks something or this is a local minimum, and deviations
    /// are too small.
    pub correlation: Vec<f64>,
    /// The course of each round.
    pub rounds: Vec<Vec<Trace>>,
    /// Times, what was read, and what was simulated before and after, log by log.
    pub curves: Vec<Curves>,
}

/// One log's readings beside simulated ones, row by row.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Curves {
    /// The log.
    pub name: String,
    /// Times \[s\].
    pub times: Vec<f64>,
    /// Readings.
    pub measured: Vec<f64>,
    /// Simulated by the model as it was.
    pub before: Vec<f64>,
    /// Simulated with the values found.
    pub after: Vec<f64>,
}

/// Finds the values with which a model reads what logs have.
///
/// Logs are all of one model and compare the same columns.
///
/// # Errors
/// There are no logs, parameters or common columns, the model refuses values, or it cannot be simulated as it is.
pub fn identify(
    model: &Model,
    logs: &[Log],
    parameters: &[Parameter],
    options: &Options,
) -> Result<Found, IdentifyError> {
    let Some(first) = logs.first() else {
        return Err(IdentifyError::Choice("there is no log to fit to".into()));
    };
    if parameters.is_empty() {
        return Err(IdentifyError::Choice("there is no parameter to fit".into()));
    }
    let columns = first.readings.names.clone();
    if let Some(other) = logs.iter().find(|log| log.readings.names != columns) {
        let reason = format!("differ from those of {}, {}", first.name, columns.join(", "));
        return Err(IdentifyError::column(&other.name, "the columns", reason));
    }
    let windows = windows(logs, model.nq + model.nv + model.na, options.window);
    let weights = Vec::new();
    let mut problem = Problem { model, logs, windows: &windows, parameters, weights };
    let measured = problem.measured();
    let spread = spread(&measured, columns.len());
    problem.weights = spread.iter().map(|s| 1.0 / s).collect();
    let mut values: Vec<f64> = parameters.iter().map(|p| p.start).collect();
    let before = problem.readings(std::slice::from_ref(&values))?.remove(0);
    let mut rounds = Vec::new();
    let mut last: Option<(Minimum, Vec<f64>)> = None;
    for _ in 0..ROUNDS {
        let minimum = minimise(&problem, &values, &measured, options.iterations)?;
        values.clone_from(&minimum.values);
        rounds.push(minimum.trace.clone());
        let old = problem.weights.clone();
        problem.weights = weights_of(&minimum.residual, &measured, &old, &spread, parameters.len());
        last = Some((minimum, old));
    }
    let Some((minimum, weights)) = last else {
        return Err(IdentifyError::Choice("a fit has one round at least".into()));
    };
    // The last noise is that of the last fit: derivatives are weighted again.
    let jacobian: Vec<Vec<f64>> = minimum
        .jacobian
        .iter()
        .map(|column| {
            let width = columns.len();
            column
                .iter()
                .enumerate()
                .map(|(i, x)| x * problem.weights[i % width] / weights[i % width])
                .collect()
        })
        .collect();
    let Uncertainty { deviations, covariance, unknown } = uncertainty(parameters, &jacobian);
    let after = problem.readings(std::slice::from_ref(&values))?.remove(0);
    let unweighted = |readings: &[f64]| differences(&problem.differences(readings, &measured), columns.len());
    let (left, right) = (unweighted(&before), unweighted(&after));
    Ok(Found {
        parameters: parameters.to_vec(),
        values,
        deviations,
        covariance,
        unknown,
        before: left.iter().map(|column| root_mean_square(column)).collect(),
        noise: right.iter().map(|column| root_mean_square(column)).collect(),
        correlation: right.iter().zip(&spread).map(|(column, spread)| correlation(column, *spread)).collect(),
        curves: curves(&problem, &measured, &before, &after),
        columns,
        rounds,
    })
}

/// Standard deviations of columns; 1 of those that never change.
fn spread(measured: &[f64], width: usize) -> Vec<f64> {
    (0..width)
        .map(|column| {
            let values: Vec<f64> =
                measured.iter().skip(column).step_by(width).copied().filter(|x| x.is_finite()).collect();
            let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
            let centred: Vec<f64> = values.iter().map(|x| x - mean).collect();
            let deviation = root_mean_square(&centred);
            if deviation > 0.0 { deviation } else { 1.0 }
        })
        .collect()
}

/// One over the noise that residuals have, with the degrees of freedom that the fit took.
fn weights_of(
    residual: &[f64],
    measured: &[f64],
    old: &[f64],
    spread: &[f64],
    parameters: usize,
) -> Vec<f64> {
    let width = old.len();
    let known = measured.iter().filter(|y| y.is_finite()).count() as f64;
    let freedom = (1.0 - parameters as f64 / known).max(0.1);
    (0..width)
        .map(|column| {
            let all =
                residual.iter().zip(measured).skip(column).step_by(width).filter(|(_, y)| y.is_finite());
            let left: Vec<f64> = all.map(|(r, _)| r / old[column]).collect();
            1.0 / (root_mean_square(&left) / freedom.sqrt()).max(LEAST_NOISE * spread[column])
        })
        .collect()
}

fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|x| x * x).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

/// What is left of each column, without what is missing.
fn differences(left: &[f64], width: usize) -> Vec<Vec<f64>> {
    let column = |c: usize| left.iter().skip(c).step_by(width).copied().filter(|x| x.is_finite()).collect();
    (0..width).map(column).collect()
}

/// Correlation of each number with the next; none of what is rounding beside the spread of readings.
fn correlation(left: &[f64], spread: f64) -> f64 {
    if root_mean_square(left) <= LEAST_NOISE * spread {
        return 0.0;
    }
    let square: f64 = left.iter().map(|x| x * x).sum();
    let product: f64 = left.windows(2).map(|pair| pair[0] * pair[1]).sum();
    if square > 0.0 { product / square } else { 0.0 }
}

/// Readings of all windows, put together log by log.
fn curves(problem: &Problem<'_>, measured: &[f64], before: &[f64], after: &[f64]) -> Vec<Curves> {
    let width = problem.weights.len();
    let mut all: Vec<Curves> = problem
        .logs
        .iter()
        .map(|log| Curves {
            name: log.name.clone(),
            times: Vec::new(),
            measured: Vec::new(),
            before: Vec::new(),
            after: Vec::new(),
        })
        .collect();
    let mut at = 0;
    for window in problem.windows {
        let rows = window.end - window.first;
        let (curve, part) = (&mut all[window.log], at * width..(at + rows) * width);
        curve.times.extend_from_slice(&problem.logs[window.log].times[window.first..window.end]);
        curve.measured.extend_from_slice(&measured[part.clone()]);
        curve.before.extend_from_slice(&before[part.clone()]);
        curve.after.extend_from_slice(&after[part]);
        at += rows;
    }
    all
}
