//! How certain values are, and what a log cannot tell.

use crate::minimise::normal;
use crate::parameter::Parameter;
use nalgebra::{DMatrix, Dyn, SymmetricEigen};

/// A direction whose standard deviation is larger than this share of the parameters' own scales cannot be told.
const UNKNOWN: f64 = 0.5;
/// Parts of a direction that are named: those above this share of the largest.
const NAMED: f64 = 0.2;
/// Eigenvalues below this share of the largest are rounding.
const ROUNDING: f64 = 1e-14;

/// A combination of parameters that the log does not tell: values may move along it and readings hardly change.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Direction {
    /// The standard deviation along it, in units of the parameters' scales; infinite where no reading changes.
    pub deviation: f64,
    /// Parameters with their shares, of which the largest is 1 or -1; in units of their scales.
    pub parts: Vec<(String, f64)>,
}

/// What follows from the derivatives at the values found.
pub(crate) struct Uncertainty {
    /// Standard deviations, infinite of parameters that are part of an unknown direction.
    pub deviations: Vec<f64>,
    /// Covariances, row by row, of what is known of all parameters: log and priors.
    pub covariance: Vec<f64>,
    pub unknown: Vec<Direction>,
}

/// Uncertainty of values, from derivatives of residuals over their noise by values over their scales.
pub(crate) fn uncertainty(parameters: &[Parameter], jacobian: &[Vec<f64>]) -> Uncertainty {
    let n = parameters.len();
    let information = normal(jacobian);
    let SymmetricEigen { eigenvalues, eigenvectors } = spectrum(&information);
    let most = eigenvalues.max();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| eigenvalues[a].total_cmp(&eigenvalues[b]));
    let mut unknown = Vec::new();
    let mut unsure = vec![false; n];
    for (value, vector) in order.into_iter().map(|k| (eigenvalues[k], eigenvectors.column(k))) {
        let deviation = if value > ROUNDING * most { 1.0 / value.sqrt() } else { f64::INFINITY };
        if deviation <= UNKNOWN {
            continue;
        }
        let largest = vector.iter().copied().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        let parts = vector.iter().map(|x| x / largest).enumerate().filter(|(_, share)| share.abs() > NAMED);
        let parts: Vec<_> = parts.collect();
        // What a prior says is known all the same.
        parts.iter().for_each(|&(i, _)| unsure[i] |= parameters[i].prior.is_none());
        let named = parts.into_iter().map(|(i, share)| (parameters[i].name.clone(), share));
        unknown.push(Direction { deviation, parts: named.collect() });
    }
    let mut whole = information;
    for (i, p) in parameters.iter().enumerate() {
        whole[(i, i)] += p.prior.map_or(0.0, |prior| (p.scale / prior.deviation).powi(2));
    }
    let covariance = inverse(&whole, parameters);
    let deviations =
        (0..n).map(|i| if unsure[i] { f64::INFINITY } else { covariance[i * n + i].sqrt() }).collect();
    Uncertainty { deviations, covariance, unknown }
}

/// The inverse of the information, in the units of values; directions without any are left out.
fn inverse(information: &DMatrix<f64>, parameters: &[Parameter]) -> Vec<f64> {
    let n = parameters.len();
    let SymmetricEigen { eigenvalues, eigenvectors } = spectrum(information);
    let most = eigenvalues.max();
    let entry = |r: usize, c: usize| {
        let kept = (0..n).filter(|&k| eigenvalues[k] > ROUNDING * most);
        let sum: f64 = kept.map(|k| eigenvectors[(r, k)] * eigenvectors[(c, k)] / eigenvalues[k]).sum();
        sum * parameters[r].scale * parameters[c].scale
    };
    (0..n * n).map(|i| entry(i / n, i % n)).collect()
}

/// Eigenvalues with their eigenvectors. A derivative that is no finite number tells nothing.
fn spectrum(information: &DMatrix<f64>) -> SymmetricEigen<f64, Dyn> {
    SymmetricEigen::new(information.map(|entry| if entry.is_finite() { entry } else { 0.0 }))
}
