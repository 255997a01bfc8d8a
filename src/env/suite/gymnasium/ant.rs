//! Ant: four legs on a torso that is to run along x.

use super::progress::Progress;
use super::start::{VelocityNoise, start};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Task, Timing, Turn, Verdict, View};
use physics::Data;
use serde::Deserialize;

/// Gymnasium's settings with its defaults.
#[derive(Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Args {
    forward_reward_weight: f64,
    ctrl_cost_weight: f64,
    contact_cost_weight: f64,
    healthy_reward: f64,
    /// Body whose position is the ant's.
    main_body: usize,
    terminate_when_unhealthy: bool,
    healthy_z_range: [f64; 2],
    contact_force_range: [f64; 2],
    reset_noise_scale: f64,
    exclude_current_positions_from_observation: bool,
    include_cfrc_ext_in_observation: bool,
}

impl Default for Args {
    fn default() -> Self {
        Args {
            forward_reward_weight: 1.0,
            ctrl_cost_weight: 0.5,
            contact_cost_weight: 5e-4,
            healthy_reward: 1.0,
            main_body: 1,
            terminate_when_unhealthy: true,
            healthy_z_range: [0.2, 1.0],
            contact_force_range: [-1.0, 1.0],
            reset_noise_scale: 0.1,
            exclude_current_positions_from_observation: true,
            include_cfrc_ext_in_observation: true,
        }
    }
}

#[derive(Clone)]
pub struct Ant {
    args: Args,
    progress: Progress,
}

impl Ant {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit the model.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let bodies = setup.scene.model.nbody;
        if args.main_body >= bodies {
            return Err(
                setup.wrong(format!("main_body is {}, and the model has {bodies} bodies", args.main_body))
            );
        }
        if setup.scene.model.nq < 3 {
            return Err(setup.wrong("the model has no free joint: an ant's height is its third position"));
        }
        Ok(Ant { args, progress: Progress::default() })
    }

    fn position(&self, data: &Data) -> [f64; 2] {
        let [x, y, _] = data.kin.xpos[self.args.main_body];
        [x, y]
    }

    fn contact_force(&self, force: f64) -> f64 {
        let [low, high] = self.args.contact_force_range;
        force.max(low).min(high)
    }

    fn is_healthy(&self, data: &Data) -> bool {
        let [low, high] = self.args.healthy_z_range;
        let state = &data.state;
        let finite = state.qpos.iter().chain(&state.qvel).all(|value| value.is_finite());
        finite && (low..=high).contains(&state.qpos[2])
    }
}

impl Task for Ant {
    fn defaults(&self) -> Defaults {
        let forces = self.args.include_cfrc_ext_in_observation.then_some("cfrc_ext");
        let keys: Vec<_> = ["qpos", "qvel"].into_iter().chain(forces).collect();
        let terms = ["reward_forward", "reward_survive", "reward_ctrl", "reward_contact"];
        Defaults::new(&keys, &terms.map(|term| (term, 1.0)), 5)
    }

    fn timing(&self) -> Timing {
        Timing::Plain
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        start(episode, self.args.reset_noise_scale, VelocityNoise::Normal)?;
        episode.scene.forward()?;
        self.progress.begin(self.position(&episode.scene.data));
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let position = self.position(&turn.scene.data);
        self.progress.act(turn, position);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let skipped = 2 * usize::from(self.args.exclude_current_positions_from_observation);
        rows.set("qpos", "m rad", &state.qpos[skipped..]);
        rows.set("qvel", "m/s rad/s", &state.qvel);
        let forces = view.data.sensor.cfrc_ext[1..].as_flattened();
        rows.set("cfrc_ext", "N m N", forces.iter().map(|&force| self.contact_force(force)));
        rows.set("position", "m", &state.qpos[..2]);
        rows.set("velocity", "m/s", self.progress.velocity(self.position(view.data), view.dt));
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let healthy = self.is_healthy(view.data);
        let forces = view.data.sensor.cfrc_ext.as_flattened().iter();
        let contact: f64 = forces.map(|&force| self.contact_force(force).powi(2)).sum();
        let forward = self.args.forward_reward_weight * rows["velocity"][0];
        terms.set("reward_forward", "", [forward]);
        terms.set("reward_survive", "", [if healthy { self.args.healthy_reward } else { 0.0 }]);
        terms.set("reward_ctrl", "", [-self.args.ctrl_cost_weight * self.progress.effort()]);
        terms.set("reward_contact", "", [-self.args.contact_cost_weight * contact]);
        Verdict { sparse: forward, solved: false, done: !healthy && self.args.terminate_when_unhealthy }
    }

    fn rewards_paths(&self) -> bool {
        false
    }
}
