//! Threading a rope, one end on a post, through an upright ring.
//!
//! Observation beside that of all tasks: `rope`, the places of its ends and of the joints between its links, from the post to the loose
//! end \[m\]; `ring`, the middle of the ring \[m\], and `axis`, the direction through it, away from the post; `threaded`, the length of rope beyond
//! the plane of the ring, if it goes through the hole, and 0 if not \[m\]; `gap`, the distance from the loose end to the middle of the ring
//! \[m\]; `grasp`, the distance from the fingertips to the loose end \[m\]; `held`, for how long the rope has been threaded \[s\]. Dense reward:
//! ten times the length that is threaded, minus both distances; one more while enough is threaded, 100 at the end. Sparse reward: 1 while
//! it is. Solved: 5 cm beyond the ring for 0.5 s, the hand open or not. Where the ring stands, how it is turned and how the rope lies are drawn.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use super::rope::{Rope, Shapes};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::{BodyId, SiteId};
use physics::math::{Vec3, add_scaled, column, distance, dot, quat_from_axis_angle, sub};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Length beyond the ring that is wanted \[m\].
    threaded: f64,
    /// For how long it is to be there \[s\].
    hold: f64,
    shapes: Shapes,
    /// Places of the ring on the table \[m\], and its turn \[rad\].
    places: Ranges<3>,
}

/// The task.
#[derive(Clone)]
pub struct RopeThread {
    bench: Bench,
    rope: Rope,
    ring: BodyId,
    /// The hole, whose axis is x.
    hole: SiteId,
    wanted: f64,
    places: Ranges<3>,
    threaded: Hold,
}

impl RopeThread {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles, the rope, or the body or the site `ring` are missing; shapes that no rope has.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(RopeThread {
            bench: Bench::new(&args.arm, "thread a rope through a ring", setup)?,
            rope: Rope::new(args.shapes, setup)?,
            ring: setup.scene.body("ring")?,
            hole: setup.scene.site("ring")?,
            wanted: args.threaded,
            places: args.places,
            threaded: Hold::new(args.hold),
        })
    }

    /// The middle of the ring \[m\], and the direction through it.
    fn through(&self, data: &Data) -> (Vec3, Vec3) {
        let hole = data.site(self.hole);
        (*hole.xpos(), column(hole.xmat(), 0))
    }

    /// Length beyond the ring \[m\]: from the loose end to where the rope crosses its plane, if that is in the hole.
    fn length(&self, m: &Model, data: &Data) -> f64 {
        let ((middle, axis), radius) = (self.through(data), m.site_size[self.hole.index()][0]);
        let (mut length, mut last) = (0.0, self.rope.end(data));
        for place in self.rope.places(data).rev().skip(1) {
            let [beyond, before] = [last, place].map(|place| dot(axis, sub(place, middle)));
            if beyond <= 0.0 {
                return 0.0;
            }
            let (link, way) = (distance(last, place), sub(place, last));
            if before <= 0.0 {
                let share = beyond / (beyond - before);
                let inside = distance(add_scaled(last, way, share), middle) < radius;
                return if inside { length + share * link } else { 0.0 };
            }
            (length, last) = (length + link, place);
        }
        0.0
    }
}

impl Task for RopeThread {
    fn defaults(&self) -> Defaults {
        let weights = [("threaded", 10.0), ("gap", -1.0), ("grasp", -1.0), ("held", 1.0), ("bonus", 100.0)];
        let rows = ["arm_pos", "arm_vel", "tip", "rope", "ring", "axis", "threaded", "gap", "grasp", "held"];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let ([x, y, turn], body) = (self.places.draw(episode.rng)?, self.ring.index());
        episode.scene.model.edit(|m| {
            m.body_pos[body][..2].copy_from_slice(&[x, y]);
            m.body_quat[body] = quat_from_axis_angle([0.0, 0.0, 1.0], turn);
        })?;
        self.rope.lay_aside(episode.rng, episode.start)?;
        self.threaded.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let threaded = self.length(&turn.scene.model, &turn.scene.data) >= self.wanted;
        self.threaded.leave(threaded);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (length, end) = (self.length(view.model, view.data), self.rope.end(view.data));
        let (middle, axis) = self.through(view.data);
        self.bench.observe(view, rows);
        rows.set("rope", "m", self.rope.places(view.data).flatten());
        rows.set("ring", "m", middle);
        rows.set("axis", "", axis);
        rows.set("threaded", "m", [length]);
        rows.set("gap", "m", [distance(end, middle)]);
        rows.set("grasp", "m", [distance(end, self.bench.tip(view))]);
        rows.set("held", "s", [self.threaded.seconds(length >= self.wanted, view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let length = rows["threaded"][0];
        terms.set("threaded", "m", [length]);
        terms.set("gap", "m", [rows["gap"][0]]);
        terms.set("grasp", "m", [rows["grasp"][0]]);
        self.threaded.judge(rows["held"][0], length >= self.wanted, false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["rope", "ring", "axis", "threaded", "gap", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.threaded.keep(keeper);
    }
}
