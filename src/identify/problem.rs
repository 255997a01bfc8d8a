//! The sum of squares that is minimised: distances of readings over their noise, and of values from priors.

use crate::error::IdentifyError;
use crate::log::Log;
use crate::parameter::{Parameter, valued};
use crate::quantity::Quantity;
use crate::simulate::simulate;
use crate::window::Window;
use physics::Model;
use rayon::prelude::*;

/// Half the distance of central differences, in units of a parameter's scale: the root of what rounding and tolerances of the
/// solver leave of a reading, about 1e-8.
const STEP: f64 = 1e-4;

/// What is minimised.
pub(crate) struct Problem<'a> {
    pub model: &'a Model,
    pub logs: &'a [Log],
    pub windows: &'a [Window],
    pub parameters: &'a [Parameter],
    /// One over the noise of each column.
    pub weights: Vec<f64>,
}

impl Problem<'_> {
    /// The model with values, and the delay.
    fn built(&self, values: &[f64]) -> Result<(Model, f64), IdentifyError> {
        let mut model = self.model.clone();
        let all = self.parameters.iter().zip(values);
        let written: Vec<_> = all.clone().map(|(p, &x)| (p.quantity, p.element, x)).collect();
        Quantity::write(&mut model, &written)
            .map_err(|error| IdentifyError::Edit { values: valued(self.parameters, values), error })?;
        let delay = all.filter(|(p, _)| p.quantity == Quantity::Delay).map(|(_, &x)| x).sum();
        Ok((model, delay))
    }

    /// Simulated readings of all windows at each of several points, all side by side.
    ///
    /// # Errors
    /// A model refuses values, or a simulation fails.
    pub fn readings(&self, points: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, IdentifyError> {
        let built: Vec<_> = points.par_iter().map(|point| self.built(point)).collect::<Result<_, _>>()?;
        let jobs: Vec<_> =
            built.iter().flat_map(|point| self.windows.iter().map(move |w| (point, *w))).collect();
        let parts: Vec<_> = jobs
            .par_iter()
            .map(|((model, delay), window)| {
                let log = &self.logs[window.log];
                simulate(model, log, *window, *delay).map_err(|(time, error)| IdentifyError::Step {
                    log: log.name.clone(),
                    time,
                    error,
                })
            })
            .collect::<Result<_, _>>()?;
        Ok(parts.chunks(self.windows.len()).map(<[_]>::concat).collect())
    }

    /// What was read at the rows of all windows.
    pub fn measured(&self) -> Vec<f64> {
        let rows = self.windows.iter().flat_map(|w| {
            let (values, width) = (&self.logs[w.log].readings.values, self.logs[w.log].readings.width());
            &values[w.first * width..w.end * width]
        });
        rows.copied().collect()
    }

    /// What was simulated without what was read, quaternions of the nearer sign; NaN for what is missing.
    pub fn differences(&self, readings: &[f64], measured: &[f64]) -> Vec<f64> {
        let mut left: Vec<f64> = readings.iter().zip(measured).map(|(x, y)| x - y).collect();
        let Some(log) = self.logs.first() else { return left };
        let width = log.readings.width();
        for row in (0..readings.len()).step_by(width) {
            for first in log.readings.quaternions.iter().map(|column| row + column) {
                let (x, y) = (&readings[first..first + 4], &measured[first..first + 4]);
                if x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>() < 0.0 {
                    (0..4).for_each(|i| left[first + i] = x[i] + y[i]);
                }
            }
        }
        left
    }

    /// Residuals of readings: differences over the noise; 0 for what is missing.
    pub fn weighted(&self, readings: &[f64], measured: &[f64]) -> Vec<f64> {
        let (width, left) = (self.weights.len(), self.differences(readings, measured));
        let all = left.iter().enumerate();
        all.map(|(i, x)| if x.is_finite() { x * self.weights[i % width] } else { 0.0 }).collect()
    }

    /// Residuals of priors.
    pub fn priors(&self, values: &[f64]) -> Vec<f64> {
        let all = self.parameters.iter().zip(values);
        all.filter_map(|(p, x)| p.prior.map(|prior| (x - prior.mean) / prior.deviation)).collect()
    }

    /// Residuals of readings, then of priors, at a point.
    ///
    /// # Errors
    /// As [`Problem::readings`].
    pub fn residual(&self, values: &[f64], measured: &[f64]) -> Result<Vec<f64>, IdentifyError> {
        let readings = self.readings(std::slice::from_ref(&values.to_vec()))?;
        let mut all = self.weighted(&readings[0], measured);
        all.extend(self.priors(values));
        Ok(all)
    }

    /// The derivatives of residuals of readings by parameters over their scales, column by column: central differences, at a
    /// bound to one side.
    ///
    /// # Errors
    /// As [`Problem::readings`].
    pub fn jacobian(&self, values: &[f64], measured: &[f64]) -> Result<Vec<Vec<f64>>, IdentifyError> {
        let ends: Vec<_> = self
            .parameters
            .iter()
            .zip(values)
            .map(|(p, &x)| {
                let h = STEP * p.scale;
                ((x - h).max(p.lower), (x + h).min(p.upper))
            })
            .collect();
        let moved = |i: usize, x: f64| {
            let mut point = values.to_vec();
            point[i] = x;
            point
        };
        let points: Vec<_> =
            ends.iter().enumerate().flat_map(|(i, &(low, high))| [moved(i, low), moved(i, high)]).collect();
        let readings = self.readings(&points)?;
        let width = self.weights.len();
        Ok(readings
            .chunks(2)
            .zip(&ends)
            .zip(self.parameters)
            .map(|((pair, (low, high)), p)| {
                let factor = p.scale / (high - low);
                let rows = pair[0].iter().zip(&pair[1]).zip(measured).enumerate();
                rows.map(
                    |(i, ((a, b), y))| {
                        if y.is_finite() { (b - a) * factor * self.weights[i % width] } else { 0.0 }
                    },
                )
                .collect()
            })
            .collect())
    }
}
