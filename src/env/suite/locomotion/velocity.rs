//! Following a velocity that changes every few seconds: forward, to the left, and turning.

use super::interval::Interval;
use super::walker::{Disturbance, Walker};
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::math::ops;
use robot::{Keeper, Walk};
use serde::Deserialize;

/// Steps near the command that make a success, of an episode of 1000.
const STEPS: usize = 600;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the body.
    roles: String,
    #[serde(default)]
    disturbance: Disturbance,
    /// Smallest command as shares of what the body walks: forward, to the left, turning counterclockwise.
    command_low: [f64; 3],
    /// Largest command.
    command_high: [f64; 3],
    /// Steps from one command to the next.
    every: Interval,
    /// Errors of the mean velocity and of the mean rate of turning that solve the task, as shares of what the body walks.
    near: [f64; 2],
    /// Time constant of the mean velocity that is compared with the command \[s\]: about two steps of a gait, if left out.
    #[serde(default = "two_steps")]
    memory: f64,
}

fn two_steps() -> f64 {
    0.5
}

/// The task.
#[derive(Clone)]
pub struct Velocity {
    walker: Walker,
    low: [f64; 3],
    high: [f64; 3],
    every: Interval,
    near: [f64; 2],
    memory: f64,
    command: [f64; 3],
    mean: [f64; 3],
}

impl Velocity {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let walker = Walker::new(&args.roles, "velocity", args.disturbance, setup)?;
        if args.memory.is_nan() || args.memory <= 0.0 {
            return Err(setup.wrong(format!("memory is a positive time, not {} s", args.memory)));
        }
        let Walk { speed, turn } = walker.walk;
        let scaled = |[ahead, left, round]: [f64; 3]| [ahead * speed, left * speed, round * turn];
        Ok(Velocity {
            walker,
            low: scaled(args.command_low),
            high: scaled(args.command_high),
            every: args.every,
            near: [args.near[0] * speed, args.near[1] * turn],
            memory: args.memory,
            command: [0.0; 3],
            mean: [0.0; 3],
        })
    }

    fn draw(&mut self, rng: &mut Rng) -> Result<(), EnvError> {
        for part in 0..3 {
            self.command[part] = rng.uniform(self.low[part], self.high[part])?;
        }
        Ok(())
    }
}

impl Task for Velocity {
    fn defaults(&self) -> Defaults {
        let weights = [("speed", 1.0), ("turning", 0.5), ("upright", 0.5), ("bonus", 1.0), ("fallen", 10.0)];
        Walker::defaults(&["command", "mean_velocity"], &weights, STEPS)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(&scene.model, pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.mean = [0.0; 3];
        self.walker.start(episode)?;
        self.every.restart();
        self.draw(episode.rng)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        if self.every.passes() {
            self.draw(turn.rng)?;
        }
        let posture = self.walker.posture(&turn.scene.model, &turn.scene.data);
        let now = [posture.velocity[0], posture.velocity[1], posture.turning[2]];
        for (mean, now) in self.mean.iter_mut().zip(now) {
            *mean += (now - *mean) * turn.dt / self.memory;
        }
        self.walker.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.walker.observe(view, rows);
        rows.set("command", "m/s, rad/s", self.command);
        rows.set("mean_velocity", "m/s, rad/s", self.mean);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (command, mean) = (&rows["command"], &rows["mean_velocity"]);
        let off = norm(&[mean[0] - command[0], mean[1] - command[1]]);
        let twist = (mean[2] - command[2]).abs();
        let solved = off < self.near[0] && twist < self.near[1];
        let tracking = |error: f64, near: f64| ops::exp(-(error / near).powi(2));
        terms.set("speed", "", [tracking(off, self.near[0])]);
        terms.set("turning", "", [tracking(twist, self.near[1])]);
        self.walker.judge(solved, rows, terms)
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
        keeper.numbers(&mut self.command);
        keeper.numbers(&mut self.mean);
        self.every.keep(keeper);
    }
}
