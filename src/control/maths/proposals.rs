//! A plan of controls as knots, noisy copies of it, and how it moves towards those that cost least. Predictive sampling takes the best
//! (Howell et al., Predictive sampling: real-time behaviour synthesis with MuJoCo, arXiv 2212.00541, 2022), the cross-entropy method the
//! mean of an elite (Kobilarov, Cross-entropy motion planning, International Journal of Robotics Research 31, 2012), path integrals a
//! mean weighted by the exponential of the cost (Williams et al., Information theoretic MPC for model-based reinforcement learning,
//! ICRA 2017).

use super::NoSolution;
use random::Generator;

/// Smallest deviation of the cross-entropy method, as a share of that at the beginning.
const LEAST: f64 = 0.1;

/// How a plan moves towards its samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// The best sample becomes the plan.
    Predictive,
    /// The mean of the best samples becomes the plan, their deviations the noise of the next.
    CrossEntropy {
        /// How many are the best.
        elites: usize,
    },
    /// The mean of all samples, each weighted by the exponential of what it costs more than the best.
    PathIntegral {
        /// Cost at which a weight is 1/e of that of the best.
        temperature: f64,
    },
}

/// A noisy copy of a plan.
#[derive(Clone, Default)]
pub struct Sample {
    /// Knots by controls.
    pub plan: Vec<f64>,
    /// What it costs: infinitely much where it cannot be followed.
    pub cost: f64,
}

/// A plan, and the noise around it.
pub struct Proposals {
    method: Method,
    bounds: Vec<[f64; 2]>,
    knots: usize,
    /// Knots by controls.
    plan: Vec<f64>,
    /// Deviation of the noise, as a share of half the range of a control.
    width: f64,
    /// Deviation of each number of the plan.
    deviation: Vec<f64>,
    /// What the noise of samples is multiplied by, in turn.
    scales: Vec<f64>,
    noise: Generator<random::Pcg64>,
}

impl Proposals {
    /// The plan that every control is zero, or what is nearest to that within its `bounds`.
    ///
    /// # Errors
    /// Less than 2 knots.
    pub fn new(
        bounds: Vec<[f64; 2]>,
        method: Method,
        knots: usize,
        width: f64,
        seed: u64,
    ) -> Result<Self, NoSolution> {
        if knots < 2 {
            return Err(wrong("a plan has 2 knots at least"));
        }
        let (plan, deviation, scales) = (Vec::new(), Vec::new(), vec![1.0]);
        let noise = Generator::pcg64(seed);
        let mut proposals = Proposals { method, bounds, knots, plan, width, deviation, scales, noise };
        proposals.restart(seed);
        Ok(proposals)
    }

    /// The same with noise of several sizes: samples multiply it by these numbers, one or more, in turn.
    pub fn with_scales(mut self, scales: &[f64]) -> Self {
        self.scales = scales.to_vec();
        self
    }

    /// Forgets the plan, and begins the noise of a seed.
    pub fn restart(&mut self, seed: u64) {
        self.hold(&vec![0.0; self.bounds.len()]);
        self.deviation = self.widest();
        self.noise = Generator::pcg64(seed);
    }

    /// Plans to give the same controls throughout, each within its bounds.
    pub fn hold(&mut self, controls: &[f64]) {
        let held = self.bounds.iter().zip(controls).map(|([low, high], control)| control.clamp(*low, *high));
        self.plan = held.collect::<Vec<_>>().repeat(self.knots);
    }

    fn widest(&self) -> Vec<f64> {
        let each = self.bounds.iter().map(|[low, high]| self.width * (high - low) / 2.0);
        each.collect::<Vec<_>>().repeat(self.knots)
    }

    /// Draws samples, in order: the plan itself, then the plan with noise.
    pub fn draw<'a>(&mut self, samples: impl Iterator<Item = &'a mut Sample>) {
        for (index, sample) in samples.enumerate() {
            sample.plan.clone_from(&self.plan);
            if index == 0 {
                continue;
            }
            let scale = self.scales[index % self.scales.len()];
            for (place, value) in sample.plan.iter_mut().enumerate() {
                let [low, high] = self.bounds[place % self.bounds.len()];
                let deviation = scale * self.deviation[place];
                *value = (*value + deviation * self.noise.standard_normal()).clamp(low, high);
            }
        }
    }

    /// Moves the plan towards the samples that cost least, and returns the least cost.
    ///
    /// # Errors
    /// No sample has a finite cost.
    pub fn choose(&mut self, samples: &[Sample]) -> Result<f64, NoSolution> {
        let mut order: Vec<usize> = (0..samples.len()).collect();
        // Stable: of equal costs the first sample comes first.
        order.sort_by(|&a, &b| samples[a].cost.total_cmp(&samples[b].cost));
        let least = order.first().map_or(f64::INFINITY, |&first| samples[first].cost);
        if !least.is_finite() {
            return Err(wrong("physics refuses every sample"));
        }
        let mean = |weights: &[(usize, f64)], value: &dyn Fn(usize) -> f64| {
            let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
            weights.iter().map(|&(sample, weight)| weight * value(sample)).sum::<f64>() / sum
        };
        let weights: Vec<(usize, f64)> = match self.method {
            Method::Predictive => vec![(order[0], 1.0)],
            Method::CrossEntropy { elites } => order[..elites].iter().map(|&sample| (sample, 1.0)).collect(),
            Method::PathIntegral { temperature } => {
                let weight = |cost: f64| physics::math::ops::exp(-(cost - least) / temperature);
                samples.iter().enumerate().map(|(k, sample)| (k, weight(sample.cost))).collect()
            }
        };
        let moved: Vec<f64> =
            (0..self.plan.len()).map(|place| mean(&weights, &|sample| samples[sample].plan[place])).collect();
        if matches!(self.method, Method::CrossEntropy { .. }) {
            let widest = self.widest();
            for (place, deviation) in self.deviation.iter_mut().enumerate() {
                let square = mean(&weights, &|sample| (samples[sample].plan[place] - moved[place]).powi(2));
                *deviation = square.sqrt().max(LEAST * widest[place]);
            }
        }
        self.plan = moved;
        Ok(least)
    }

    /// Moves the beginning of the plan by a share of its length; its end stays what it was.
    pub fn shift(&mut self, share: f64) {
        let mut shifted = self.plan.clone();
        for (knot, values) in shifted.chunks_exact_mut(self.bounds.len()).enumerate() {
            let place = knot as f64 / (self.knots - 1) as f64;
            interpolate(&self.plan, self.knots, place + share, values);
        }
        self.plan = shifted;
        if matches!(self.method, Method::CrossEntropy { .. }) {
            self.deviation = self.widest();
        }
    }

    /// Writes the controls of the plan at a share of its length.
    pub fn controls(&self, share: f64, out: &mut [f64]) {
        interpolate(&self.plan, self.knots, share, out);
    }
}

/// Writes the controls of a plan at a share of its length; before its beginning and after its end it stays what it is there.
pub fn interpolate(plan: &[f64], knots: usize, share: f64, out: &mut [f64]) {
    let (nu, place) = (out.len(), share.clamp(0.0, 1.0) * (knots - 1) as f64);
    let knot = (place as usize).min(knots - 2);
    let between = place - knot as f64;
    for (k, value) in out.iter_mut().enumerate() {
        let [a, b] = [plan[knot * nu + k], plan[(knot + 1) * nu + k]];
        *value = a + between * (b - a);
    }
}

pub fn wrong(message: impl Into<String>) -> NoSolution {
    NoSolution::new("sampling", message.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_multiply_the_noise_in_turn_and_stay_within_bounds() {
        let bounds = vec![[-1.0, 1.0], [2.0, 6.0]];
        let mut proposals =
            Proposals::new(bounds.clone(), Method::Predictive, 3, 0.5, 7).unwrap().with_scales(&[8.0, 0.0]);
        let mut samples = vec![Sample::default(); 6];
        proposals.draw(samples.iter_mut());
        let rest = [0.0, 2.0].repeat(3);
        for (index, sample) in samples.iter().enumerate() {
            assert_eq!(sample.plan == rest, index == 0 || index % 2 == 1, "{index}");
            let within =
                |(place, value): (usize, &f64)| (bounds[place % 2][0]..=bounds[place % 2][1]).contains(value);
            assert!(sample.plan.iter().enumerate().all(within));
        }
        // At eight times half of the range most numbers are at an end of it.
        let ends = samples[2].plan.iter().filter(|value| [-1.0, 1.0, 2.0, 6.0].contains(value)).count();
        assert!(ends >= 3, "{:?}", samples[2].plan);
    }

    #[test]
    fn the_best_sample_becomes_the_plan_and_moves_on() {
        let mut proposals = Proposals::new(vec![[-1.0, 1.0]], Method::Predictive, 2, 0.5, 7).unwrap();
        let sample = |plan: [f64; 2], cost| Sample { plan: plan.to_vec(), cost };
        let samples = [sample([0.0, 0.0], 3.0), sample([0.5, -0.5], -2.0), sample([1.0, 1.0], f64::INFINITY)];
        assert_eq!(proposals.choose(&samples).unwrap(), -2.0);
        let at = |proposals: &Proposals, share| {
            let mut control = [0.0];
            proposals.controls(share, &mut control);
            control[0]
        };
        assert_eq!([at(&proposals, 0.0), at(&proposals, 0.25), at(&proposals, 1.0)], [0.5, 0.25, -0.5]);
        proposals.shift(0.5);
        assert_eq!([at(&proposals, 0.0), at(&proposals, 1.0)], [0.0, -0.5]);
        let refused = [sample([0.0, 0.0], f64::INFINITY)];
        assert_eq!(
            proposals.choose(&refused).unwrap_err().to_string(),
            "sampling: physics refuses every sample"
        );
    }
}
