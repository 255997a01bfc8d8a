//! Two bodies that pass a ball to each other over the middle of a field.
//!
//! A pass has come when the ball is in the half of the body that it was for, and within `radius` of it, while both bodies stand in their
//! own halves, farther than `strip` from the middle line: the ball has to roll there. The left body passes first. Each observes the ball
//! (`ball_error` \[m\], `ball_velocity` \[m/s\]) and the direction of the other half (`forth`) in the frame of its heading: forward,
//! left; how far it is from the middle line (`line_distance` \[m\]), negative in the other half; and whose the next pass is (`turn`: 1
//! its own, -1 the other's, 0 that of none). Solved: all `passes` have come.

use super::pair::{Bodies, Pair};
use super::part::{Part, STEPS, defaults};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::locomotion::walker::Disturbance;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use crate::team::{Stakes, Team};
use physics::Data;
use physics::elements::BodyId;
use physics::math::Vec3;
use robot::Keeper;
use serde::Deserialize;
use std::ops::Range;

/// Settings of the task.
#[derive(Clone, Deserialize)]
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
    /// How far the ball lies before the left body \[m\].
    ball_distance_range: [f64; 2],
    /// How many passes there are to be.
    passes: usize,
    /// Distance of the ball from a body at which it has come to it \[m\].
    radius: f64,
    /// Half the width of the middle of the field \[m\].
    strip: f64,
}

/// The task.
#[derive(Clone)]
pub struct PassBall {
    pair: Pair,
    ball: BodyId,
    /// Where `qpos` has the free joint of the ball, and `qvel` its velocity.
    pose: Range<usize>,
    speed: usize,
    args: Args,
    /// Passes that had come before the present state.
    passed: usize,
}

impl PassBall {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles of `left` and `right`, or has no body `ball` with a free joint; no passes.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let part = |name| Part {
            name,
            rows: &["ball_error", "ball_velocity", "forth", "line_distance", "turn"],
            own: &[("reach", 0.5), ("upright", 0.5), ("bonus", 2.0), ("fallen", 10.0)],
            shared: &[("distance", 1.0), ("passes", 2.0)],
        };
        if args.passes == 0 {
            return Err(setup.wrong("passes is 0"));
        }
        let bodies = Bodies { roles: &args.roles, disturbance: &args.disturbance };
        let parts = [part("left"), part("right")];
        let pair = Pair::new(&bodies, "pass a ball", parts, Stakes::Shared, setup)?;
        let (ball, pose) = setup.loose_body("ball")?;
        let speed = setup.scene.model.body_dofadr[ball.index()].max(0) as usize;
        Ok(PassBall { pair, ball, pose, speed, args, passed: 0 })
    }

    /// How far a place is in the half of a body \[m\].
    fn within(&self, number: usize, place: &Vec3) -> f64 {
        let [x, y] = self.pair.walkers[number].ahead_at_start();
        -(x * place[0] + y * place[1])
    }

    /// The body that the next pass is for, if there is one.
    fn receiver(&self, passed: usize) -> Option<usize> {
        (passed < self.args.passes).then_some(1 - passed % 2)
    }

    /// Passes that have come in this state.
    fn passes(&self, data: &Data) -> usize {
        let places = self.pair.walkers.each_ref().map(|walker| data.kin.xpos[walker.root().index()]);
        let ball = data.kin.xpos[self.ball.index()];
        let comes = self.receiver(self.passed).is_some_and(|to| {
            let [x, y, _] = places[to];
            let stand = |number: usize| self.within(number, &places[number]) > self.args.strip;
            norm(&[ball[0] - x, ball[1] - y]) < self.args.radius
                && self.within(to, &ball) > 0.0
                && (0..2).all(stand)
        });
        self.passed + usize::from(comes)
    }
}

impl Task for PassBall {
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
        self.passed = 0;
        self.pair.start(episode)?;
        let half = episode.rng.uniform(self.args.distance_range[0], self.args.distance_range[1])? / 2.0;
        let asides = self.args.aside_range;
        for (k, walker) in self.pair.walkers.iter().enumerate() {
            let [x, y] = walker.ahead_at_start();
            let aside = episode.rng.uniform(asides[0], asides[1])?;
            let at = |back: f64, aside: f64| [-back * x - aside * y, -back * y + aside * x];
            walker.put(episode.start, at(half, aside), 0.0);
            if k == 0 {
                let [least, most] = self.args.ball_distance_range;
                let ball = at(half - episode.rng.uniform(least, most)?, aside);
                episode.start.qpos[self.pose.start..self.pose.start + 2].copy_from_slice(&ball);
            }
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.passed = self.passes(&turn.scene.data);
        self.pair.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let passes = self.passes(view.data);
        let ball = view.data.kin.xpos[self.ball.index()];
        let [u, v] = [0, 1].map(|i| view.data.state.qvel[self.speed + i]);
        self.pair.observe(view, rows, |k, posture, rows| {
            let [c, s] = posture.ahead;
            rows.set("ball_error", "m", posture.towards(&ball));
            rows.set("ball_velocity", "m/s", [c * u + s * v, c * v - s * u]);
            let [x, y] = self.pair.walkers[k].ahead_at_start();
            rows.set("forth", "", [c * x + s * y, c * y - s * x]);
            rows.set("line_distance", "m", [self.within(k, &posture.place)]);
            rows.set("turn", "", [self.receiver(passes).map_or(0.0, |to| if to == k { -1.0 } else { 1.0 })]);
        });
        rows.set("passes", "", [passes as f64]);
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let own = self.pair.walkers.each_ref().map(|walker| rows.of(walker.prefix()));
        let passes = self.passes(view.data);
        let away = own.map(|rows| norm(&rows["ball_error"]));
        let distance = self.receiver(passes).map_or(0.0, |to| away[to]);
        terms.set("distance", "m", [-distance]);
        terms.set("passes", "", [passes as f64]);
        let reach = |k: usize, terms: &mut Rows| {
            terms.set("reach", "m", [-away[k] * own[k]["turn"][0].max(0.0)]);
        };
        self.pair.judge(passes >= self.args.passes, rows, terms, reach)
    }

    fn resting_rows(&self) -> Vec<String> {
        let turns = self.pair.walkers.iter().map(|walker| format!("{}turn", walker.prefix()));
        turns.chain(["passes".into()]).collect()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.pair.keep(keeper);
        keeper.count(&mut self.passed);
    }
}
