//! Humanoid: a body on two legs that is to walk along x without falling.

use super::progress::Progress;
use super::start::{VelocityNoise, start};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Task, Timing, Turn, Verdict, View};
use physics::{Data, Model};
use serde::Deserialize;

/// Degrees of freedom of the free joint, which no actuator moves.
const ROOT: usize = 6;

/// Gymnasium's settings with its defaults.
#[derive(Clone, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Args {
    forward_reward_weight: f64,
    ctrl_cost_weight: f64,
    contact_cost_weight: f64,
    contact_cost_range: [f64; 2],
    healthy_reward: f64,
    terminate_when_unhealthy: bool,
    healthy_z_range: [f64; 2],
    reset_noise_scale: f64,
    exclude_current_positions_from_observation: bool,
    include_cinert_in_observation: bool,
    include_cvel_in_observation: bool,
    include_qfrc_actuator_in_observation: bool,
    include_cfrc_ext_in_observation: bool,
}

impl Default for Args {
    fn default() -> Self {
        Args {
            forward_reward_weight: 1.25,
            ctrl_cost_weight: 0.1,
            contact_cost_weight: 5e-7,
            contact_cost_range: [f64::NEG_INFINITY, 10.0],
            healthy_reward: 5.0,
            terminate_when_unhealthy: true,
            healthy_z_range: [1.0, 2.0],
            reset_noise_scale: 1e-2,
            exclude_current_positions_from_observation: true,
            include_cinert_in_observation: true,
            include_cvel_in_observation: true,
            include_qfrc_actuator_in_observation: true,
            include_cfrc_ext_in_observation: true,
        }
    }
}

#[derive(Clone)]
pub struct Humanoid {
    args: Args,
    /// Mass of all bodies \[kg\].
    mass: f64,
    progress: Progress,
}

impl Humanoid {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit the model.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let model = &setup.scene.model;
        if model.nq < 3 || model.nv < ROOT {
            return Err(setup.wrong("the model has no free joint: a humanoid's height is its third position"));
        }
        let mass = model.body_mass.iter().sum();
        Ok(Humanoid { args, mass, progress: Progress::default() })
    }

    /// The centre of mass in the plane.
    fn position(&self, model: &Model, data: &Data) -> [f64; 2] {
        let bodies = || model.body_mass.iter().zip(data.kin.xipos.iter());
        std::array::from_fn(|k| bodies().map(|(mass, at)| mass * at[k]).sum::<f64>() / self.mass)
    }

    fn is_healthy(&self, data: &Data) -> bool {
        let [low, high] = self.args.healthy_z_range;
        low < data.state.qpos[2] && data.state.qpos[2] < high
    }
}

impl Task for Humanoid {
    fn defaults(&self) -> Defaults {
        let optional = [
            ("cinert", self.args.include_cinert_in_observation),
            ("cvel", self.args.include_cvel_in_observation),
            ("qfrc_actuator", self.args.include_qfrc_actuator_in_observation),
            ("cfrc_ext", self.args.include_cfrc_ext_in_observation),
        ];
        let included = optional.iter().filter(|(_, included)| *included).map(|(key, _)| *key);
        let keys: Vec<_> = ["qpos", "qvel"].into_iter().chain(included).collect();
        let terms = ["reward_forward", "reward_survive", "reward_ctrl", "reward_contact"];
        Defaults::new(&keys, &terms.map(|term| (term, 1.0)), 5)
    }

    fn timing(&self) -> Timing {
        Timing::Plain
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        start(episode, self.args.reset_noise_scale, VelocityNoise::Uniform)?;
        episode.scene.forward()?;
        self.progress.begin(self.position(&episode.scene.model, &episode.scene.data));
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let position = self.position(&turn.scene.model, &turn.scene.data);
        self.progress.act(turn, position);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let data = view.data;
        let skipped = 2 * usize::from(self.args.exclude_current_positions_from_observation);
        rows.set("qpos", "m rad", &data.state.qpos[skipped..]);
        rows.set("qvel", "m/s rad/s", &data.state.qvel);
        rows.set("cinert", "kg m^2 kg m kg", data.com.cinert[1..].as_flattened());
        rows.set("cvel", "rad/s m/s", data.vel.cvel[1..].as_flattened());
        rows.set("qfrc_actuator", "N m", &data.actuation.qfrc_actuator[ROOT..]);
        rows.set("cfrc_ext", "N m N", data.sensor.cfrc_ext[1..].as_flattened());
        rows.set("position", "m", &data.state.qpos[..2]);
        rows.set("velocity", "m/s", self.progress.velocity(self.position(view.model, data), view.dt));
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let healthy = self.is_healthy(view.data);
        let forces = view.data.sensor.cfrc_ext.as_flattened().iter();
        let squares: f64 = forces.map(|force| force * force).sum();
        let [least, most] = self.args.contact_cost_range;
        let contact = (self.args.contact_cost_weight * squares).max(least).min(most);
        let forward = self.args.forward_reward_weight * rows["velocity"][0];
        terms.set("reward_forward", "", [forward]);
        terms.set("reward_survive", "", [if healthy { self.args.healthy_reward } else { 0.0 }]);
        terms.set("reward_ctrl", "", [-self.args.ctrl_cost_weight * self.progress.effort()]);
        terms.set("reward_contact", "", [-contact]);
        Verdict { sparse: forward, solved: false, done: !healthy && self.args.terminate_when_unhealthy }
    }

    fn rewards_paths(&self) -> bool {
        false
    }
}
