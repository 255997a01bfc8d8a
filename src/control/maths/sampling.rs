//! Model-predictive control by sampling: many noisy copies of a plan are simulated side by side, and the plan moves towards those that
//! cost least. Predictive sampling takes the best (Howell et al., Predictive sampling: real-time behaviour synthesis with MuJoCo,
//! arXiv 2212.00541, 2022), the cross-entropy method the mean of an elite (Kobilarov, Cross-entropy motion planning, International
//! Journal of Robotics Research 31, 2012), path integrals a mean weighted by the exponential of the cost (Williams et al., Information
//! theoretic MPC for model-based reinforcement learning, ICRA 2017).

use super::NoSolution;
use physics::{Batch, Data, Model, Snapshot, step};
use random::Generator;
use std::sync::atomic::{AtomicU64, Ordering};

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

/// Sizes of a search.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// How plans move.
    pub method: Method,
    /// Plans that are simulated for one improvement, the present one among them.
    pub samples: usize,
    /// Time steps of a plan.
    pub steps: usize,
    /// Knots of a plan, between which controls are linear: 2 or more.
    pub knots: usize,
    /// Deviation of the noise, as a share of half the range of a control.
    pub noise: f64,
    /// Threads that simulate.
    pub threads: usize,
    /// Seed of the noise.
    pub seed: u64,
}

/// A plan that is improved again and again, and shifted as time passes. Its result depends on the seed and on the states that it was
/// improved from, never on the number of threads.
pub struct Sampler {
    settings: Settings,
    bounds: Vec<[f64; 2]>,
    /// Knots by controls.
    plan: Vec<f64>,
    /// Deviation of each number of the plan.
    deviation: Vec<f64>,
    noise: Generator<random::Pcg64>,
    /// A simulation a sample, with its plan and what it costs.
    batch: Batch<Sample>,
}

#[derive(Clone, Default)]
struct Sample {
    plan: Vec<f64>,
    cost: f64,
}

impl Sampler {
    /// A search for a model, whose plan is to do nothing: zero within the range of each control.
    ///
    /// # Errors
    /// Controls without a range; sizes that make no search; threads that cannot be started.
    pub fn new(model: &Model, settings: Settings) -> Result<Self, NoSolution> {
        if settings.knots < 2 || settings.samples < 2 || settings.steps < 1 {
            return Err(wrong("a search has 2 knots, 2 samples and 1 step at least".into()));
        }
        if let Some(k) = (0..model.nu).find(|&k| !model.actuator_ctrllimited[k]) {
            return Err(wrong(format!("actuator {k} has no range of controls to draw from")));
        }
        let elites = match settings.method {
            Method::CrossEntropy { elites } => elites,
            _ => 1,
        };
        if !(1..=settings.samples).contains(&elites) {
            return Err(wrong(format!("{elites} of {} samples cannot be the best", settings.samples)));
        }
        let samples = vec![Sample::default(); settings.samples];
        let batch = Batch::with_payloads(model.clone(), samples, settings.threads);
        let mut sampler = Sampler {
            bounds: model.actuator_ctrlrange[..model.nu].to_vec(),
            plan: Vec::new(),
            deviation: Vec::new(),
            noise: Generator::pcg64(settings.seed),
            batch: batch.map_err(|error| wrong(error.to_string()))?,
            settings,
        };
        sampler.reset(sampler.settings.seed);
        Ok(sampler)
    }

    /// Forgets the plan, and begins the noise of a seed.
    pub fn reset(&mut self, seed: u64) {
        let rest = self.bounds.iter().map(|[low, high]| 0.0_f64.clamp(*low, *high));
        self.plan = rest.collect::<Vec<_>>().repeat(self.settings.knots);
        self.deviation = self.widest();
        self.noise = Generator::pcg64(seed);
    }

    /// Plans to give the same controls (nu) throughout, each within its range.
    pub fn hold(&mut self, controls: &[f64]) {
        let held = self.bounds.iter().zip(controls).map(|([low, high], control)| control.clamp(*low, *high));
        self.plan = held.collect::<Vec<_>>().repeat(self.settings.knots);
    }

    fn widest(&self) -> Vec<f64> {
        let each = self.bounds.iter().map(|[low, high]| self.settings.noise * (high - low) / 2.0);
        each.collect::<Vec<_>>().repeat(self.settings.knots)
    }

    /// Improves the plan once from a state. `cost`, which is not negative, is asked after every time step of every sample, and its sum is
    /// what the sample costs; a sample that physics refuses costs infinitely much. Predictive sampling ends a sample as soon as it costs more
    /// than another one does in all, since it cannot be the best. Returns the least cost.
    ///
    /// # Errors
    /// A state of another model; a negative cost; every sample was refused.
    pub fn improve(
        &mut self,
        state: &Snapshot,
        cost: impl Fn(&Model, &Data) -> f64 + Sync,
    ) -> Result<f64, NoSolution> {
        self.draw();
        let (steps, knots, bounds) = (self.settings.steps, self.settings.knots, &self.bounds);
        // Whichever samples are over first, the best is never ended early. Bits of numbers that are not negative have their order.
        let least = AtomicU64::new(f64::INFINITY.to_bits());
        let only_the_best_counts = self.settings.method == Method::Predictive;
        let simulated = self.batch.run(|env| {
            env.data.restore(state).map_err(|error| wrong(error.to_string()))?;
            let Sample { plan, cost: sum } = env.payload;
            *sum = 0.0;
            for k in 0..steps {
                interpolate(plan, knots, k as f64 / steps as f64, &mut env.data.state.ctrl[..bounds.len()]);
                let more = step(env.model, env.data).map_or(f64::INFINITY, |()| cost(env.model, env.data));
                if more < 0.0 {
                    return Err(wrong(format!("a state costs {more}; costs are not negative")));
                }
                *sum += more;
                if !(*sum <= f64::from_bits(least.load(Ordering::Relaxed)) && sum.is_finite()) {
                    *sum = f64::INFINITY;
                    return Ok(());
                }
            }
            if only_the_best_counts {
                least.fetch_min(sum.to_bits(), Ordering::Relaxed);
            }
            Ok::<_, NoSolution>(())
        });
        simulated.map_err(|mut failed| failed.failures.swap_remove(0).error)?;
        self.choose()
    }

    /// Writes the controls of the plan, `time` time steps after its beginning.
    pub fn controls(&self, time: f64, out: &mut [f64]) {
        interpolate(&self.plan, self.settings.knots, time / self.settings.steps as f64, out);
    }

    /// Moves the beginning of the plan by time steps; its end stays what it was.
    pub fn shift(&mut self, steps: usize) {
        let (knots, nu) = (self.settings.knots, self.bounds.len());
        let mut shifted = self.plan.clone();
        for (knot, values) in shifted.chunks_exact_mut(nu).enumerate() {
            let share = knot as f64 / (knots - 1) as f64 + steps as f64 / self.settings.steps as f64;
            interpolate(&self.plan, knots, share, values);
        }
        self.plan = shifted;
        if matches!(self.settings.method, Method::CrossEntropy { .. }) {
            self.deviation = self.widest();
        }
    }

    /// Draws the samples, in order: the plan itself, then the plan with noise.
    fn draw(&mut self) {
        let Sampler { plan, deviation, noise, bounds, .. } = self;
        for (index, sample) in self.batch.payloads_mut().iter_mut().enumerate() {
            sample.plan.clone_from(plan);
            if index > 0 {
                for (place, value) in sample.plan.iter_mut().enumerate() {
                    let [low, high] = bounds[place % bounds.len()];
                    *value = (*value + deviation[place] * noise.standard_normal()).clamp(low, high);
                }
            }
        }
    }

    /// Moves the plan, and returns the least cost.
    fn choose(&mut self) -> Result<f64, NoSolution> {
        let samples = self.batch.payloads();
        let mut order: Vec<usize> = (0..samples.len()).collect();
        // Stable: of equal costs the first sample comes first.
        order.sort_by(|&a, &b| samples[a].cost.total_cmp(&samples[b].cost));
        let least = samples[order[0]].cost;
        if !least.is_finite() {
            return Err(wrong("physics refuses every sample".into()));
        }
        let mean = |weights: &[(usize, f64)], value: &dyn Fn(usize) -> f64| {
            let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
            weights.iter().map(|&(sample, weight)| weight * value(sample)).sum::<f64>() / sum
        };
        let weights: Vec<(usize, f64)> = match self.settings.method {
            Method::Predictive => vec![(order[0], 1.0)],
            Method::CrossEntropy { elites } => order[..elites].iter().map(|&sample| (sample, 1.0)).collect(),
            Method::PathIntegral { temperature } => {
                let weight = |cost: f64| physics::math::ops::exp(-(cost - least) / temperature);
                samples.iter().enumerate().map(|(k, sample)| (k, weight(sample.cost))).collect()
            }
        };
        let moved: Vec<f64> =
            (0..self.plan.len()).map(|place| mean(&weights, &|sample| samples[sample].plan[place])).collect();
        if matches!(self.settings.method, Method::CrossEntropy { .. }) {
            let widest = self.widest();
            for (place, deviation) in self.deviation.iter_mut().enumerate() {
                let square = mean(&weights, &|sample| (samples[sample].plan[place] - moved[place]).powi(2));
                *deviation = square.sqrt().max(LEAST * widest[place]);
            }
        }
        self.plan = moved;
        Ok(least)
    }
}

fn wrong(message: String) -> NoSolution {
    NoSolution::new("sampling", message)
}

/// Writes the controls of a plan at a share of its length; before its beginning and after its end it stays what it is there.
fn interpolate(plan: &[f64], knots: usize, share: f64, out: &mut [f64]) {
    let (nu, place) = (out.len(), share.clamp(0.0, 1.0) * (knots - 1) as f64);
    let knot = (place as usize).min(knots - 2);
    let between = place - knot as f64;
    for (k, value) in out.iter_mut().enumerate() {
        let [a, b] = [plan[knot * nu + k], plan[(knot + 1) * nu + k]];
        *value = a + between * (b - a);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pendulum whose motor lifts half of its weight: it has to swing.
    const PENDULUM: &str = "<mujoco><option timestep='0.01'/><worldbody><body>
        <joint name='hinge' axis='0 1 0' damping='0.02'/><geom type='sphere' size='.05' pos='0 0 -1' mass='1'/></body></worldbody>
        <actuator><motor joint='hinge' ctrlrange='-5 5'/></actuator></mujoco>";

    /// Distance from upright, and speed.
    fn cost(_: &Model, data: &Data) -> f64 {
        let (angle, speed) = (data.state.qpos[0], data.state.qvel[0]);
        1.0 + angle.cos() + 0.01 * speed * speed
    }

    /// Swings for eight seconds, replanning ten times a second; the controls that were given, and the least height of the last second.
    fn swing(method: Method, threads: usize) -> (Vec<f64>, f64) {
        let model = mjcf::load_str(PENDULUM).unwrap().model;
        let settings = Settings { method, samples: 24, steps: 200, knots: 10, noise: 0.5, threads, seed: 5 };
        let mut sampler = Sampler::new(&model, settings).unwrap();
        let (mut data, mut state) = (Data::new(&model), Snapshot::default());
        let (mut given, mut least) = (Vec::new(), f64::INFINITY);
        for turn in 0..80 {
            data.save(&mut state);
            sampler.improve(&state, cost).unwrap();
            for k in 0..10 {
                sampler.controls(f64::from(k), &mut data.state.ctrl);
                given.push(data.state.ctrl[0]);
                step(&model, &mut data).unwrap();
                if turn >= 70 {
                    least = least.min(-data.state.qpos[0].cos());
                }
            }
            sampler.shift(10);
        }
        (given, least)
    }

    #[test]
    fn every_method_swings_a_pendulum_up() {
        let methods = [
            Method::Predictive,
            Method::CrossEntropy { elites: 4 },
            Method::PathIntegral { temperature: 1.0 },
        ];
        for method in methods {
            let (given, least) = swing(method, 1);
            // It stays within 30 degrees of upright.
            assert!(least > 0.866, "{method:?} {least}");
            assert!(given.iter().all(|control| control.abs() <= 5.0));
        }
    }

    #[test]
    fn threads_change_no_bit() {
        let method = Method::CrossEntropy { elites: 4 };
        assert_eq!(swing(method, 1), swing(method, 3));
    }

    #[test]
    fn samples_end_once_they_cannot_be_the_best() {
        let model = mjcf::load_str(PENDULUM).unwrap().model;
        let (data, mut state) = (Data::new(&model), Snapshot::default());
        data.save(&mut state);
        let improved = |method| {
            let settings =
                Settings { method, samples: 24, steps: 200, knots: 10, noise: 0.5, threads: 1, seed: 5 };
            let (mut sampler, asked) = (Sampler::new(&model, settings).unwrap(), AtomicU64::new(0));
            // To swing costs: the plan to do nothing, which is simulated first, costs least.
            let counted = |_: &Model, data: &Data| {
                asked.fetch_add(1, Ordering::Relaxed);
                data.state.qvel[0].abs()
            };
            let least = sampler.improve(&state, counted).unwrap();
            (sampler.plan, least, asked.into_inner())
        };
        // One elite is the best sample, too, but all samples are simulated to their ends.
        let (plan, least, all) = improved(Method::CrossEntropy { elites: 1 });
        let (same, cost, some) = improved(Method::Predictive);
        assert_eq!((same, cost), (plan, least));
        // One whole sample, and the first step of 23.
        assert_eq!((all, some), (24 * 200, 200 + 23));
    }

    #[test]
    fn negative_costs_are_refused() {
        let model = mjcf::load_str(PENDULUM).unwrap().model;
        let method = Method::Predictive;
        let settings = Settings { method, samples: 8, steps: 10, knots: 3, noise: 0.5, threads: 1, seed: 0 };
        let (data, mut state) = (Data::new(&model), Snapshot::default());
        data.save(&mut state);
        let error =
            Sampler::new(&model, settings).unwrap().improve(&state, |_, _| -1.0).unwrap_err().to_string();
        assert_eq!(error, "sampling: a state costs -1; costs are not negative");
    }

    #[test]
    fn a_held_plan_gives_the_same_controls_within_their_range() {
        let model = mjcf::load_str(PENDULUM).unwrap().model;
        let method = Method::Predictive;
        let settings = Settings { method, samples: 8, steps: 10, knots: 3, noise: 0.5, threads: 1, seed: 0 };
        let mut sampler = Sampler::new(&model, settings).unwrap();
        let mut given = [0.0];
        for (held, expected) in [(2.0, 2.0), (-7.0, -5.0)] {
            sampler.hold(&[held]);
            sampler.controls(4.5, &mut given);
            assert_eq!(given, [expected]);
        }
    }

    #[test]
    fn sizes_that_make_no_search_are_refused() {
        let model = mjcf::load_str(PENDULUM).unwrap().model;
        let method = Method::CrossEntropy { elites: 9 };
        let settings = Settings { method, samples: 8, steps: 10, knots: 2, noise: 0.5, threads: 1, seed: 0 };
        let error = |settings| Sampler::new(&model, settings).err().unwrap().to_string();
        assert_eq!(error(settings.clone()), "sampling: 9 of 8 samples cannot be the best");
        assert!(error(Settings { knots: 1, ..settings }).contains("2 knots"));
        let free = mjcf::load_str(PENDULUM.replace("ctrlrange='-5 5'", "")).unwrap().model;
        let settings = Settings {
            method: Method::Predictive,
            samples: 8,
            steps: 10,
            knots: 2,
            noise: 0.5,
            threads: 1,
            seed: 0,
        };
        let error = Sampler::new(&free, settings).err().unwrap().to_string();
        assert!(error.contains("no range of controls"), "{error}");
    }
}
