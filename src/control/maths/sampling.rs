//! Model-predictive control by sampling: noisy copies of a plan are simulated side by side from the present state, and the plan moves
//! towards those that cost least.

use super::NoSolution;
use super::proposals::{Method, Proposals, Sample, interpolate, wrong};
use physics::{Batch, Data, Model, Snapshot, step};
use std::sync::atomic::{AtomicU64, Ordering};

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
    proposals: Proposals,
    /// A simulation a sample, with its plan and what it costs.
    batch: Batch<Sample>,
}

impl Sampler {
    /// A search for a model, whose plan is to do nothing: zero within the range of each control.
    ///
    /// # Errors
    /// Controls without a range; sizes that make no search; threads that cannot be started.
    pub fn new(model: &Model, settings: Settings) -> Result<Self, NoSolution> {
        let Settings { method, samples, steps, knots, noise, threads, seed } = settings;
        if knots < 2 || samples < 2 || steps < 1 {
            return Err(wrong("a search has 2 knots, 2 samples and 1 step at least"));
        }
        if let Some(k) = (0..model.nu).find(|&k| !model.actuator_ctrllimited[k]) {
            return Err(wrong(format!("actuator {k} has no range of controls to draw from")));
        }
        let elites = match method {
            Method::CrossEntropy { elites } => elites,
            _ => 1,
        };
        if !(1..=samples).contains(&elites) {
            return Err(wrong(format!("{elites} of {samples} samples cannot be the best")));
        }
        let batch = Batch::with_payloads(model.clone(), vec![Sample::default(); samples], threads);
        let bounds = model.actuator_ctrlrange[..model.nu].to_vec();
        Ok(Sampler {
            proposals: Proposals::new(bounds, method, knots, noise, seed)?,
            batch: batch.map_err(|error| wrong(error.to_string()))?,
            settings,
        })
    }

    /// Forgets the plan, and begins the noise of a seed.
    pub fn reset(&mut self, seed: u64) {
        self.proposals.restart(seed);
    }

    /// Plans to give the same controls (nu) throughout, each within its range.
    pub fn hold(&mut self, controls: &[f64]) {
        self.proposals.hold(controls);
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
        self.proposals.draw(self.batch.payloads_mut().iter_mut());
        let Settings { method, steps, knots, .. } = self.settings;
        // Whichever samples are over first, the best is never ended early. Bits of numbers that are not negative have their order.
        let least = AtomicU64::new(f64::INFINITY.to_bits());
        let only_the_best_counts = method == Method::Predictive;
        let simulated = self.batch.run(|env| {
            env.data.restore(state).map_err(|error| wrong(error.to_string()))?;
            let Sample { plan, cost: sum } = env.payload;
            *sum = 0.0;
            for k in 0..steps {
                interpolate(plan, knots, k as f64 / steps as f64, &mut env.data.state.ctrl[..env.model.nu]);
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
        self.proposals.choose(self.batch.payloads())
    }

    /// Writes the controls of the plan, `time` time steps after its beginning.
    pub fn controls(&self, time: f64, out: &mut [f64]) {
        self.proposals.controls(time / self.settings.steps as f64, out);
    }

    /// Moves the beginning of the plan by time steps; its end stays what it was.
    pub fn shift(&mut self, steps: usize) {
        self.proposals.shift(steps as f64 / self.settings.steps as f64);
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
            let mut plan = [0.0; 200];
            plan.iter_mut()
                .enumerate()
                .for_each(|(k, control)| sampler.controls(k as f64, std::slice::from_mut(control)));
            (plan, least, asked.into_inner())
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
