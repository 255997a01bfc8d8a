//! Chasing a mark that moves over the ground and changes its direction every few seconds.

use super::FRAME_SKIP;
use super::walker::{Disturbance, Walker};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::SiteId;
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
    every: usize,
    /// Distance from the mark that solves the task, in heights of the root.
    radius: f64,
}

/// The task.
#[derive(Clone)]
pub struct Chase {
    walker: Walker,
    target: SiteId,
    distance: [f64; 2],
    speed: f64,
    turn: f64,
    every: usize,
    radius: f64,
    heading: f64,
    place: [f64; 2],
    since: usize,
}

impl Chase {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles, or has no site `target`.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        if args.every == 0 {
            return Err(setup.wrong("`every` is 0; a direction has to last a step at least"));
        }
        let walker = Walker::new(&args.roles, "chase", args.disturbance, setup)?;
        let height = walker.height;
        Ok(Chase {
            target: setup.scene.site("target")?,
            distance: args.distance_range.map(|distance| distance * height),
            speed: args.speed * walker.walk.speed,
            turn: args.turn,
            every: args.every,
            radius: args.radius * height,
            heading: 0.0,
            place: [0.0; 2],
            since: 0,
            walker,
        })
    }

    fn mark(&self, scene: &mut Scene) -> Result<(), EnvError> {
        let [x, y] = self.place;
        scene.overwrite(|m| m.site_pos[self.target.index()] = [x, y, 0.0])
    }
}

impl Task for Chase {
    fn defaults(&self) -> Defaults {
        let weights =
            [("distance", 1.0), ("heading", 0.5), ("upright", 0.5), ("bonus", 2.0), ("fallen", 10.0)];
        let rows = [&Walker::ROWS[..], &["target_error"]].concat();
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP);
        Defaults { success: Success::MoreThan(STEPS), ..defaults }.proprio(&["joint_pos", "joint_vel"])
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.walker.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.walker.start(episode)?;
        let distance = episode.rng.uniform(self.distance[0], self.distance[1])?;
        let [x, y] = self.walker.ahead_at_start();
        (self.place, self.since) = ([distance * x, distance * y], 0);
        self.heading = ops::angle(y, x) + episode.rng.uniform(-self.turn, self.turn)?;
        self.mark(episode.scene)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.since += 1;
        if self.since == self.every {
            self.since = 0;
            self.heading += turn.rng.uniform(-self.turn, self.turn)?;
        }
        let (sine, cosine) = ops::sincos(self.heading);
        self.place[0] += self.speed * cosine * turn.dt;
        self.place[1] += self.speed * sine * turn.dt;
        self.mark(turn.scene)?;
        self.walker.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let posture = self.walker.observe(view, rows);
        rows.set("target_error", "m", posture.towards(view.data.site(self.target).xpos()));
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (error, up) = (&rows["target_error"], rows["up"][2]);
        let distance = norm(error);
        let solved = distance < self.radius;
        let fallen = self.walker.has_fallen(rows["height"][0], up);
        terms.set("distance", "m", [-distance]);
        terms.set("heading", "", [if solved { 1.0 } else { error[0] / distance }]);
        terms.set("upright", "", [up]);
        terms.set("bonus", "", [f64::from(solved)]);
        terms.set("fallen", "", [-f64::from(fallen)]);
        Verdict { sparse: f64::from(solved), solved, done: fallen }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.walker.keep(keeper);
        keeper.number(&mut self.heading);
        keeper.numbers(&mut self.place);
        keeper.count(&mut self.since);
    }
}
