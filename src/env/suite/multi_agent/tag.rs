//! Tag on a round field: a chaser is to come within reach of an evader, which loses as well when it leaves the field or falls.
//!
//! Each observes where the centre of the field is (`centre_error` \[m\]), in the frame of its heading: forward, left. What one earns the
//! other pays.

use super::pair::{Bodies, Pair};
use super::part::{Part, defaults};
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
    /// How far each body is turned at the start from where the model has it look \[rad\].
    turn_range: [f64; 2],
    /// Distance between the roots at which the evader is caught \[m\].
    reach: f64,
    /// Radius of the field \[m\].
    field: f64,
}

/// The task. The evader begins in the middle of the field.
#[derive(Clone)]
pub struct Tag {
    pair: Pair,
    distance: [f64; 2],
    turn: [f64; 2],
    reach: f64,
    field: f64,
}

impl Tag {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles of `chaser` and `evader`.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let part = |name, shared| Part { name, rows: &["centre_error"], own: &[], shared };
        let bodies = Bodies { roles: &args.roles, disturbance: &args.disturbance };
        let parts = [
            part("chaser", &[("distance", -0.1), ("won", 10.0)][..]),
            part("evader", &[("distance", 0.1), ("won", -10.0)][..]),
        ];
        Ok(Tag {
            pair: Pair::new(&bodies, "play tag", parts, Stakes::Opposed, setup)?,
            distance: args.distance_range,
            turn: args.turn_range,
            reach: args.reach,
            field: args.field,
        })
    }
}

impl Task for Tag {
    fn defaults(&self) -> Defaults {
        // The episode ends in the step that catches the evader.
        defaults(&self.pair.team, 0)
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
        let away = episode.rng.uniform(self.distance[0], self.distance[1])?;
        let [chaser, evader] = &self.pair.walkers;
        let [x, y] = chaser.ahead_at_start();
        for (walker, place) in [(chaser, [-away * x, -away * y]), (evader, [0.0; 2])] {
            walker.put(episode.start, place, episode.rng.uniform(self.turn[0], self.turn[1])?);
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.pair.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.pair.observe(view, rows, |_, posture, rows| {
            rows.set("centre_error", "m", posture.towards(&[0.0; 3]));
        });
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let [chaser, evader] = self.pair.walkers.each_ref().map(|walker| rows.of(walker.prefix()));
        let distance = norm(&chaser["mate_error"]);
        let caught = distance < self.reach;
        let out = norm(&evader["centre_error"]) > self.field;
        terms.set("distance", "m", [distance]);
        self.pair.judge(caught, rows, terms, |_, _| {});
        let fell = ["chaser_fallen", "evader_fallen"].map(|term| terms[term][0] < 0.0);
        let lost = caught || out || fell[1];
        terms.set("won", "", [f64::from(lost) - f64::from(fell[0])]);
        Verdict { sparse: f64::from(caught), solved: caught, done: lost || fell[0] }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.pair.keep(keeper);
    }
}
