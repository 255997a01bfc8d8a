//! Two bodies that push a box to a place that is marked on the ground; it is too heavy for one of them.
//!
//! Each observes where box and mark are (`box_error`, `target_error` \[m\]) and the direction of the box's y axis (`box_turn`), in the frame
//! of its heading: forward, left.

use super::pair::{Bodies, Pair};
use super::part::{Part, STEPS, defaults};
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::locomotion::walker::Disturbance;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use crate::team::{Stakes, Team};
use physics::elements::{BodyId, SiteId};
use physics::math::ops;
use robot::Keeper;
use serde::Deserialize;
use std::ops::Range;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// The roles of both bodies.
    roles: String,
    #[serde(default)]
    disturbance: Disturbance,
    /// Distance of the box from the middle between the bodies at the start \[m\].
    box_distance_range: [f64; 2],
    /// Distance that the box is to be pushed \[m\].
    target_distance: f64,
    /// Direction of the place from the box, from where the bodies look at the start \[rad\].
    target_angle_range: [f64; 2],
    /// Distance of the box from the place that solves the task \[m\].
    radius: f64,
}

/// The task.
#[derive(Clone)]
pub struct PushBox {
    pair: Pair,
    load: BodyId,
    /// Where `qpos` has the free joint of the box.
    pose: Range<usize>,
    target: SiteId,
    near: [f64; 2],
    far: f64,
    angle: [f64; 2],
    radius: f64,
}

impl PushBox {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model does not fill the roles of `left` and `right`, or has no site `target` or no body `box` with a free joint.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let part = |name| Part {
            name,
            rows: &["box_error", "box_turn", "target_error"],
            own: &[("reach", 0.5), ("upright", 0.5), ("bonus", 2.0), ("fallen", 10.0)],
            shared: &[("distance", 1.0)],
        };
        let bodies = Bodies { roles: &args.roles, disturbance: &args.disturbance };
        let parts = [part("left"), part("right")];
        let pair = Pair::new(&bodies, "push a box together", parts, Stakes::Shared, setup)?;
        let (load, pose) = setup.loose_body("box")?;
        Ok(PushBox {
            load,
            pose,
            target: setup.scene.site("target")?,
            near: args.box_distance_range,
            far: args.target_distance,
            angle: args.target_angle_range,
            radius: args.radius,
            pair,
        })
    }
}

impl Task for PushBox {
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
        let [x, y] = self.pair.walkers[0].ahead_at_start();
        let near = episode.rng.uniform(self.near[0], self.near[1])?;
        let (sine, cosine) = ops::sincos(episode.rng.uniform(self.angle[0], self.angle[1])?);
        let here = [near * x, near * y];
        let there =
            [here[0] + self.far * (cosine * x - sine * y), here[1] + self.far * (cosine * y + sine * x)];
        episode.start.qpos[self.pose.start..self.pose.start + 2].copy_from_slice(&here);
        episode.scene.overwrite(|m| m.site_pos[self.target.index()] = [there[0], there[1], 0.0])
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.pair.act(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (place, axes) = (view.data.body(self.load).xpos(), view.data.kin.xmat[self.load.index()]);
        let target = view.data.site(self.target).xpos();
        self.pair.observe(view, rows, |_, posture, rows| {
            rows.set("box_error", "m", posture.towards(place));
            let ahead = [posture.place[0] + axes[1], posture.place[1] + axes[4], 0.0];
            rows.set("box_turn", "", posture.towards(&ahead));
            rows.set("target_error", "m", posture.towards(target));
        });
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let own = self.pair.walkers.each_ref().map(|walker| rows.of(walker.prefix()));
        let (load, place) = (&own[0]["box_error"], &own[0]["target_error"]);
        let distance = norm(&[place[0] - load[0], place[1] - load[1]]);
        terms.set("distance", "m", [-distance]);
        let reach = |k: usize, terms: &mut Rows| terms.set("reach", "m", [-norm(&own[k]["box_error"])]);
        self.pair.judge(distance < self.radius, rows, terms, reach)
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.pair.keep(keeper);
    }
}
