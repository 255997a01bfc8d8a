//! Plans by sampling for the servos of a hand: from the present state, noisy copies of the plan are simulated on the environment's own model
//! with longer time steps, and the best becomes the plan (predictive sampling). Horizon, knots and noise are near those that MuJoCo MPC
//! has for hands (`mjpc/tasks/{allegro,shadow_reorient}/task.xml` of google-deepmind/mujoco_mpc, Apache-2.0). A plan takes one thread
//! 0.1 to 0.3 s.

use crate::controller::command;
use crate::error::ControlError;
use crate::maths::{Method, Sampler, Settings};
use env::Env;
use physics::{Data, Snapshot};

/// Sizes of a search.
#[derive(Clone, Copy)]
pub struct Sizes {
    /// Plans that are simulated for an improvement.
    pub samples: usize,
    /// How far plans look ahead, and their time step \[s\].
    pub horizon: f64,
    pub step: f64,
    /// Time from one plan to the next \[s\].
    pub every: f64,
    pub knots: usize,
    /// Deviation of the noise, as a share of half the range of a control.
    pub noise: f64,
}

/// A search for the controls of an environment.
pub struct Search {
    sizes: Sizes,
    /// The search of this episode, whose model is that of the episode.
    sampler: Option<Sampler>,
    /// Steps of the environment from one plan to the next, and since the last one.
    every: usize,
    since: usize,
    state: Snapshot,
    controls: Vec<f64>,
}

impl Search {
    /// A search of these sizes.
    pub fn new(env: &Env, sizes: Sizes) -> Self {
        let every = ((sizes.every / env.dt()).round() as usize).max(1);
        let controls = vec![0.0; env.scene().model.nu];
        Search { sizes, sampler: None, every, since: 0, state: Snapshot::default(), controls }
    }

    /// Begins an episode with the plan that every servo stays where it is.
    ///
    /// # Errors
    /// An actuator without a range.
    pub fn begin(&mut self, env: &Env, seed: u64) -> Result<(), ControlError> {
        let Sizes { samples, horizon, step, knots, noise, .. } = self.sizes;
        let mut model = env.scene().model.clone();
        model.options_mut().timestep = step;
        let steps = (horizon / step).round() as usize;
        let method = Method::Predictive;
        let settings = Settings { method, samples, steps, knots, noise, threads: 1, seed };
        let mut sampler = Sampler::new(&model, settings)?;
        sampler.hold(&env.scene().data.trn.actuator_length);
        (self.sampler, self.since) = (Some(sampler), 0);
        Ok(())
    }

    /// Writes the action of the plan that costs least: `cost` is that of a state, for a step of the plan.
    ///
    /// # Errors
    /// No episode has begun; physics refuses every plan.
    pub fn act(
        &mut self,
        env: &Env,
        cost: impl Fn(&Data) -> f64 + Sync,
        action: &mut [f64],
    ) -> Result<(), ControlError> {
        let Some(sampler) = &mut self.sampler else {
            return Err(ControlError::unfit(env, "reset comes before act"));
        };
        let steps = |count: usize| count as f64 * env.dt() / self.sizes.step;
        if self.since == self.every {
            sampler.shift(steps(self.every).round() as usize);
            self.since = 0;
        }
        if self.since == 0 {
            env.scene().data.save(&mut self.state);
            sampler.improve(&self.state, |_, data| cost(data))?;
        }
        // The controls of the middle of the step, as they are held throughout.
        sampler.controls(steps(self.since) + 0.5 * steps(1), &mut self.controls);
        self.since += 1;
        command(env, &self.controls, action)
    }
}
