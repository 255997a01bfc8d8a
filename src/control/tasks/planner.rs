//! Plans by sampling over copies of the environment: in a fork of it noisy copies of the plan are played, and the one that earns most becomes
//! the plan (predictive sampling; Howell et al., arXiv 2212.00541, 2022). It knows nothing of a task but its dense reward and whether it is
//! solved, so that it plays any; whether it solves one depends on whether less than a second ahead shows the way.

use crate::controller::Controller;
use crate::error::ControlError;
use crate::maths::{Method, Proposals, Sample, interpolate};
use env::Env;

/// Plans that are played for an action.
const SAMPLES: usize = 32;
/// Actions of a plan, between which it is linear.
const KNOTS: usize = 2;
/// What samples multiply the noise by, in turn: half of them look for something else, half make what there is better.
const SCALES: [f64; 4] = [1.0, 0.3, 1.0, 0.1];
/// What a step earns besides its dense reward where the task is solved.
const SOLVED: f64 = 5.0;

/// How plans are looked for.
#[derive(Clone, Copy)]
pub struct Sizes {
    /// How far plans look ahead \[s\].
    pub horizon: f64,
    /// Deviation of the noise, as a share of half the range of an action.
    pub noise: f64,
}

/// For any task: most samples go to the ends of ranges.
pub const WIDE: Sizes = Sizes { horizon: 0.8, noise: 2.0 };
/// For what has to be moved gently, and would be shoved away by plans that look further ahead.
pub const GENTLE: Sizes = Sizes { horizon: 0.5, noise: 1.0 };

/// Plays what it finds in a fork of the environment.
pub struct Planner {
    /// The plan of this episode, and where it is tried.
    search: Option<(Proposals, Env)>,
    noise: f64,
    /// Steps of a plan.
    steps: usize,
    samples: Vec<Sample>,
}

impl Planner {
    /// The controller for any environment.
    pub fn new(env: &Env, Sizes { horizon, noise }: Sizes) -> Self {
        let steps = ((horizon / env.dt()).round() as usize).max(1);
        Planner { search: None, noise, steps, samples: vec![Sample::default(); SAMPLES] }
    }
}

impl Controller for Planner {
    fn reset(&mut self, env: &Env, seed: u64) -> Result<(), ControlError> {
        let bounds = (0..env.action_len()).map(|k| env.action_bounds(k)).collect();
        let proposals =
            Proposals::new(bounds, Method::Predictive, KNOTS, self.noise, seed)?.with_scales(&SCALES);
        self.search = Some((proposals, env.fork()?));
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        let Some((proposals, fork)) = &mut self.search else {
            return Err(ControlError::unfit(env, "reset comes before act"));
        };
        let state = env.state();
        proposals.draw(self.samples.iter_mut());
        for sample in &mut self.samples {
            fork.set_state(&state)?;
            sample.cost = -earned(fork, &sample.plan, self.steps, action)?;
        }
        proposals.choose(&self.samples)?;
        proposals.controls(0.0, action);
        proposals.shift(1.0 / self.steps as f64);
        Ok(())
    }
}

/// What a plan earns in an environment: a task that ends the episode pays for the steps that are left as for the last one if it is solved,
/// and as for the worst one if it is not. Nothing is worse than what physics refuses.
fn earned(fork: &mut Env, plan: &[f64], steps: usize, action: &mut [f64]) -> Result<f64, ControlError> {
    let (mut sum, mut worst) = (0.0, f64::INFINITY);
    for k in 0..steps {
        interpolate(plan, KNOTS, k as f64 / steps as f64, action);
        let step = fork.step(action)?;
        if step.fault.is_some() {
            return Ok(f64::NEG_INFINITY);
        }
        let solved = fork.verdict().solved;
        let reward = fork.dense() + if solved { SOLVED } else { 0.0 };
        worst = reward.min(worst);
        sum += reward;
        if step.terminated {
            let rest = if solved { reward } else { worst };
            return Ok(sum + rest * (steps - 1 - k) as f64);
        }
    }
    Ok(sum)
}
