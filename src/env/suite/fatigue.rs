//! Fatigue: muscles that lose force as they work.

use crate::error::EnvError;
use crate::peak_force::{PEAK_FORCE, peak_force};
use crate::scene::Scene;
use physics::math::ops;
use physics::model::GainType;
use physics::{Data, Model};
use robot::{Compat, Keeper};

/// How fast a muscle at its peak force fatigues [1/s]: once per minute.
const RATE: f64 = 1.0 / 60.0;
/// The degree of freedom whose moment arms the original takes for loads.
const LOAD_DOF: usize = 1;

/// Fatigue after Ma, Chablat, Bennis and Zhang, "A new simple dynamic muscle fatigue model and its validation",
/// International Journal of Industrial Ergonomics 39 (2009): the peak force decays as `MVC exp(-k integral(load / MVC))`.
///
/// The original takes for a load how far the moment arm about one joint is below its largest value so far, and sums over
/// every step since it was made. A sum of distances from a maximum grows, when the maximum does, by that growth for every
/// step before; so the sum, the maximum and the number of steps are all it needs to remember.
#[derive(Clone)]
pub struct Fatigue {
    compat: Compat,
    /// Peak forces of the rested muscles \[N\]; in the original, the parameter.
    rested: Vec<f64>,
    /// Load over time \[N s\]; in the original, the sum of distances from the largest moment arm \[m\].
    spent: Vec<f64>,
    /// Largest moment arms so far \[m\].
    largest: Vec<f64>,
    /// Steps so far.
    steps: usize,
    /// Whether each actuator is a muscle.
    affected: Vec<bool>,
}

impl Fatigue {
    /// Muscles that are rested.
    pub fn new(model: &Model, compat: Compat) -> Self {
        let muscle = |k: usize| model.actuator_gaintype[k] == GainType::Muscle as i32;
        let rested = |k: usize| match compat {
            Compat::RoboHive07 => model.actuator_gainprm[k][PEAK_FORCE],
            Compat::Fixed => peak_force(model, k),
        };
        let count = model.nactuator;
        Fatigue {
            compat,
            rested: (0..count).map(rested).collect(),
            spent: vec![0.0; count],
            largest: vec![f64::NEG_INFINITY; count],
            steps: 0,
            affected: (0..count).map(|k| compat == Compat::RoboHive07 || muscle(k)).collect(),
        }
    }

    /// Adds the load of one step of `dt` seconds.
    pub fn advance(&mut self, model: &Model, data: &Data, dt: f64) {
        for k in 0..self.spent.len() {
            let output = model.actuator_outadr[k] as usize;
            self.spent[k] += match self.compat {
                Compat::Fixed => data.actuation.actuator_force[output].abs() * dt,
                Compat::RoboHive07 => {
                    let arm = moment_arm(data, output, LOAD_DOF.min(model.nv.saturating_sub(1)));
                    distance_to_largest(arm, &mut self.largest[k], self.steps)
                }
            };
        }
        self.steps += 1;
    }

    /// Writes or reads what was spent.
    pub fn keep(&mut self, keeper: &mut Keeper) {
        keeper.numbers(&mut self.spent);
        keeper.numbers(&mut self.largest);
        keeper.count(&mut self.steps);
    }

    /// Rests all muscles.
    pub fn rest(&mut self) {
        self.spent.fill(0.0);
    }

    /// Writes the peak forces that are left.
    ///
    /// # Errors
    /// A force is no number.
    pub fn impose(&self, scene: &mut Scene) -> Result<(), EnvError> {
        let rate = if self.compat == Compat::Fixed { RATE } else { 1.0 };
        let left = |rested: f64, spent: f64| match rested {
            0.0 => 0.0,
            _ => rested * ops::exp(-rate * spent / rested),
        };
        scene.overwrite(|m| {
            for k in (0..self.rested.len()).filter(|&k| self.affected[k]) {
                m.actuator_gainprm[k][PEAK_FORCE] = left(self.rested[k], self.spent[k]);
            }
        })
    }
}

/// How much the sum of distances to the largest value grows with one more value, after `count` values.
fn distance_to_largest(value: f64, largest: &mut f64, count: usize) -> f64 {
    if count == 0 {
        *largest = value;
        return 0.0;
    }
    let above = value - *largest;
    if above <= 0.0 {
        return -above;
    }
    *largest = value;
    above * count as f64
}

/// The moment arm of an actuator about a degree of freedom.
fn moment_arm(data: &Data, output: usize, dof: usize) -> f64 {
    let start = data.trn.moment_rowadr[output] as usize;
    let row = start..start + data.trn.moment_rownnz[output] as usize;
    let entries = data.trn.moment_colind[row.clone()].iter().zip(&data.trn.actuator_moment[row]);
    entries.filter(|&(&column, _)| column as usize == dof).map(|(_, &arm)| arm).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_distances_need_no_history() {
        let values = [0.3, 0.1, 0.5, 0.5, -0.2, 0.9, 0.4];
        let (mut largest, mut sum) = (f64::NEG_INFINITY, 0.0);
        for (count, &value) in values.iter().enumerate() {
            sum += distance_to_largest(value, &mut largest, count);
            let seen = &values[..=count];
            let highest = seen.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let expected: f64 = seen.iter().map(|value| highest - value).sum();
            assert!((sum - expected).abs() < 1e-14, "{count}: {sum}, not {expected}");
        }
    }
}
