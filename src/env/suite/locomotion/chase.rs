//! Chasing a mark that moves over the ground and changes its direction every few seconds.

use super::interval::Interval;
use super::mark::Mark;
use super::walker::{Disturbance, Walker};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;

/// Steps near the mark that make a success, of an episode of 1000.
const STEPS: usize = 300;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of the body.
    roles: String,
    #[serde(default)]
    disturbance: Disturbance,
    /// Distance of the mark at the start, in heights of the root.
    distance_range: [f64; 2],
    /// Velocity of the mark, as a share of what the body walks.
    speed: f64,
    /// Largest change of the direction in which the mark moves \[rad\].
    turn: f64,
    /// Steps from one direction to the next.
    every: Interval,
    /// Distance from the mark that solves the task, in heights of the root.
    radius: f64,
}

/// The task.
#[derive(Clone)]
pub struct Chase {
    walker: Walker,
    mark: Mark,
    distance: [f64; 2],
    speed: f64,
    turn: f64,
    every: Interval,
    heading: f64,
    place: [f64; 2],
}

impl Chase {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no site `target`.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let walker = Walker::new(&args.roles, "chase", args.disturbance, setup)?;
        let height = walker.height;
        Ok(Chase {
            mark: Mark::new(args.radius, &walker, setup)?,
            distance: args.distance_range.map(|distance| distance * height),
            speed: args.speed * walker.walk.speed,
            turn: args.turn,
            every: args.every,
            heading: 0.0,
            place: [0.0; 2],
            walker,
        })
    }
}

impl Task for Chase {
    fn defaults(&self) -> Defaults {
        Walker::defaults(&["target_error"], &Mark::WEIGHTS, STEPS)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(&scene.model, pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.walker.start(episode)?;
        let distance = episode.rng.uniform(self.distance[0], self.distance[1])?;
        let [x, y] = self.walker.ahead_at_start();
        self.every.restart();
        self.place = [distance * x, distance * y];
        self.heading = ops::angle(y, x) + episode.rng.uniform(-self.turn, self.turn)?;
        self.mark.put(episode.scene, self.place)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        if self.every.passes() {
            self.heading += turn.rng.uniform(-self.turn, self.turn)?;
        }
        let (sine, cosine) = ops::sincos(self.heading);
        self.place[0] += self.speed * cosine * turn.dt;
        self.place[1] += self.speed * sine * turn.dt;
        self.mark.put(turn.scene, self.place)?;
        self.walker.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let posture = self.walker.observe(view, rows);
        self.mark.observe(&posture, view, rows);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        self.mark.reward(&self.walker, rows, terms)
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
        keeper.number(&mut self.heading);
        keeper.numbers(&mut self.place);
        self.every.keep(keeper);
    }
}
