//! Robots that move in a plane: Walker2d, HalfCheetah and Hopper are to run along x.

use super::progress::Progress;
use super::start::{VelocityNoise, start};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Task, Timing, Turn, Verdict, View};
use physics::Data;
use serde::Deserialize;
use std::ops::Range;

/// Settings that every robot of this file has; what is left out is the robot's own.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Args {
    forward_reward_weight: Option<f64>,
    ctrl_cost_weight: Option<f64>,
    healthy_reward: Option<f64>,
    terminate_when_unhealthy: Option<bool>,
    healthy_state_range: Option<[f64; 2]>,
    healthy_z_range: Option<[f64; 2]>,
    healthy_angle_range: Option<[f64; 2]>,
    reset_noise_scale: Option<f64>,
    exclude_current_positions_from_observation: Option<bool>,
}

/// When a robot counts as healthy: all values strictly between bounds.
#[derive(Clone)]
struct Health {
    reward: f64,
    terminates: bool,
    /// Height \[m\].
    height: [f64; 2],
    /// Pitch \[rad\].
    angle: [f64; 2],
    /// All positions and velocities but the first two positions.
    state: [f64; 2],
}

#[derive(Clone)]
pub struct Planar {
    forward_weight: f64,
    control_weight: f64,
    /// `None` where a robot can do as it likes.
    health: Option<Health>,
    noise: (f64, VelocityNoise),
    /// Positions that are not observed.
    skipped: usize,
    /// Velocities are observed within plus and minus this.
    fastest: f64,
    frame_skip: usize,
    progress: Progress,
}

const UNBOUNDED: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

impl Planar {
    /// The task of a walker on two legs.
    ///
    /// # Errors
    /// Settings do not fit the model.
    pub fn walker(mut args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        args.ctrl_cost_weight.get_or_insert(1e-3);
        args.healthy_z_range.get_or_insert([0.8, 2.0]);
        args.healthy_angle_range.get_or_insert([-1.0, 1.0]);
        args.reset_noise_scale.get_or_insert(5e-3);
        if args.healthy_state_range.is_some() {
            return Err(setup.wrong("healthy_state_range is a setting of Hopper"));
        }
        Self::new(&args, Some(UNBOUNDED), setup)
    }

    /// The task of a hopper on one leg.
    ///
    /// # Errors
    /// Settings do not fit the model.
    pub fn hopper(mut args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        args.ctrl_cost_weight.get_or_insert(1e-3);
        args.healthy_z_range.get_or_insert([0.7, f64::INFINITY]);
        args.healthy_angle_range.get_or_insert([-0.2, 0.2]);
        args.reset_noise_scale.get_or_insert(5e-3);
        Self::new(&args, Some([-100.0, 100.0]), setup)
    }

    /// The task of a cheetah, which is never unhealthy.
    ///
    /// # Errors
    /// Settings do not fit the model.
    pub fn cheetah(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let ranges = [args.healthy_state_range, args.healthy_z_range, args.healthy_angle_range];
        if ranges.iter().any(Option::is_some)
            || args.healthy_reward.is_some()
            || args.terminate_when_unhealthy.is_some()
        {
            return Err(setup.wrong("a cheetah is never unhealthy: it has no settings of health"));
        }
        Self::new(&args, None, setup)
    }

    fn new(args: &Args, healthy_state: Option<[f64; 2]>, setup: &Setup<'_>) -> Result<Self, EnvError> {
        if setup.scene.model.nq < 3 {
            return Err(setup.wrong("a planar robot's first positions are x, height and pitch"));
        }
        let health = healthy_state.map(|state| Health {
            reward: args.healthy_reward.unwrap_or(1.0),
            terminates: args.terminate_when_unhealthy.unwrap_or(true),
            height: args.healthy_z_range.unwrap_or(UNBOUNDED),
            angle: args.healthy_angle_range.unwrap_or(UNBOUNDED),
            state: args.healthy_state_range.unwrap_or(state),
        });
        let free = health.is_none();
        let velocity = if free { VelocityNoise::Normal } else { VelocityNoise::Uniform };
        Ok(Planar {
            forward_weight: args.forward_reward_weight.unwrap_or(1.0),
            control_weight: args.ctrl_cost_weight.unwrap_or(0.1),
            noise: (args.reset_noise_scale.unwrap_or(0.1), velocity),
            skipped: usize::from(args.exclude_current_positions_from_observation.unwrap_or(true)),
            fastest: if free { f64::INFINITY } else { 10.0 },
            frame_skip: if free { 5 } else { 4 },
            health,
            progress: Progress::default(),
        })
    }
}

fn within(value: f64, [low, high]: [f64; 2]) -> bool {
    low < value && value < high
}

impl Health {
    fn holds(&self, data: &Data) -> bool {
        let state = &data.state;
        let mut others = state.qpos[2..].iter().chain(&state.qvel);
        within(state.qpos[1], self.height)
            && within(state.qpos[2], self.angle)
            && (self.state == UNBOUNDED || others.all(|&value| within(value, self.state)))
    }
}

/// The place along x; the second coordinate is not used.
fn position(data: &Data) -> [f64; 2] {
    [data.state.qpos[0], 0.0]
}

impl Task for Planar {
    fn defaults(&self) -> Defaults {
        let terms: &[_] = if self.health.is_some() {
            &[("reward_forward", 1.0), ("reward_survive", 1.0), ("reward_ctrl", 1.0)]
        } else {
            &[("reward_forward", 1.0), ("reward_ctrl", 1.0)]
        };
        Defaults::new(&["qpos", "qvel"], terms, self.frame_skip)
    }

    fn timing(&self) -> Timing {
        Timing::Plain
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        start(episode, self.noise.0, self.noise.1)?;
        self.progress.begin(position(&episode.scene.data));
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let position = position(&turn.scene.data);
        self.progress.act(turn, position);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let observed: Range<usize> = self.skipped..state.qpos.len();
        rows.set("qpos", "m rad", &state.qpos[observed]);
        let velocities = state.qvel.iter().map(|v| v.max(-self.fastest).min(self.fastest));
        rows.set("qvel", "m/s rad/s", velocities);
        rows.set("position", "m", &state.qpos[..1]);
        rows.set("velocity", "m/s", &self.progress.velocity(position(view.data), view.dt)[..1]);
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let forward = self.forward_weight * rows["velocity"][0];
        terms.set("reward_forward", "", [forward]);
        terms.set("reward_ctrl", "", [-self.control_weight * self.progress.effort()]);
        let mut done = false;
        if let Some(health) = &self.health {
            let healthy = health.holds(view.data);
            terms.set("reward_survive", "", [if healthy { health.reward } else { 0.0 }]);
            done = !healthy && health.terminates;
        }
        Verdict { sparse: forward, solved: false, done }
    }

    fn rewards_paths(&self) -> bool {
        false
    }
}
