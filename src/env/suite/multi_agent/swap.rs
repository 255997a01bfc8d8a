//! Two bodies that look at each other and are to swap their places without touching.
//!
//! Each observes where it is to go (`target_error` \[m\]), in the frame of its heading: forward, left.

use super::pair::{Bodies, Pair};
use super::part::{Part, STEPS, defaults};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::locomotion::walker::Disturbance;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use crate::team::{Stakes, Team};
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of both bodies.
    roles: String,
    #[serde(default)]
    disturbance: Disturbance,
    /// Distance between the bodies at the start \[m\].
    distance_range: [f64; 2],
    /// How far each body stands aside of the line on which they look at each other \[m\].
    aside_range: [f64; 2],
    /// Distance of a body from its place that solves its part \[m\].
    radius: f64,
}

/// The task.
#[derive(Clone)]
pub struct Swap {
    pair: Pair,
    distance: [f64; 2],
    aside: [f64; 2],
    radius: f64,
    /// Where each body is to go.
    places: [[f64; 2]; 2],
}

impl Swap {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles of `left` and `right`.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let part = |name| Part {
            name,
            rows: &["target_error"],
            own: &[("distance", 1.0), ("upright", 0.5), ("bonus", 2.0), ("fallen", 10.0)],
            shared: &[("collision", 10.0)],
        };
        let bodies = Bodies { roles: &args.roles, disturbance: &args.disturbance };
        let parts = [part("left"), part("right")];
        Ok(Swap {
            pair: Pair::new(&bodies, "swap places", parts, Stakes::Shared, setup)?,
            distance: args.distance_range,
            aside: args.aside_range,
            radius: args.radius,
            places: [[0.0; 2]; 2],
        })
    }
}

impl Task for Swap {
    fn defaults(&self) -> Defaults {
        defaults(&self.pair.team, STEPS)
    }

    fn team(&self) -> Option<&Team> {
        Some(&self.pair.team)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.pair.initial_pose(scene, pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.pair.start(episode)?;
        let half = episode.rng.uniform(self.distance[0], self.distance[1])? / 2.0;
        for (walker, goal) in self.pair.walkers.iter().zip([1, 0]) {
            let [x, y] = walker.ahead_at_start();
            let aside = episode.rng.uniform(self.aside[0], self.aside[1])?;
            let here = [-half * x - aside * y, -half * y + aside * x];
            walker.put(episode.start, here, 0.0);
            self.places[goal] = here;
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.pair.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.pair.observe(view, rows, |k, posture, rows| {
            let [x, y] = self.places[k];
            rows.set("target_error", "m", posture.towards(&[x, y, 0.0]));
        });
        rows.set("touch", "", [f64::from(self.pair.touch(view))]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let away = self.pair.walkers.each_ref().map(|it| norm(&rows.of(it.prefix())["target_error"]));
        let touch = rows["touch"][0];
        let solved = touch == 0.0 && away.iter().all(|away| *away < self.radius);
        terms.set("collision", "", [-touch]);
        let distance = |k: usize, terms: &mut Rows| terms.set("distance", "m", [-away[k]]);
        let verdict = self.pair.judge(solved, rows, terms, distance);
        Verdict { done: verdict.done || touch > 0.0, ..verdict }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.pair.keep(keeper);
        self.places.iter_mut().for_each(|place| keeper.numbers(place));
    }
}
