//! Straightening a rope that lies in a bend on the table, one end on a post.
//!
//! Observation beside that of all tasks: `rope`, the places of its ends and of the joints between its links, from the post to the loose
//! end \[m\]; `stretch`, the distance of its ends as a share of its length; `bend`, the largest distance of these places from the
//! line through the ends \[m\]; `grasp`, the distance from the fingertips to the loose end \[m\]; `held`, for how long it has been straight
//! \[s\]. Dense reward: the stretch, minus ten times the bend, minus the distance to the loose end; one more while it is straight, 100
//! at the end. Sparse reward: 1 while it is straight. Solved: the ends 95 % of the length apart and every place within 2 cm of
//! the line for 0.5 s. At the start the rope is an arc with a wave on it, which spans two thirds to 93 % of its length.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use super::rope::{Rope, Shapes};
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::Data;
use physics::math::{cross, norm, scale, sub};
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Distance of the ends that counts as straight, as a share of the length.
    stretch: f64,
    /// Distance from the line that counts as straight \[m\].
    bend: f64,
    /// For how long it is to be straight \[s\].
    hold: f64,
    shapes: Shapes,
}

/// The task.
#[derive(Clone)]
pub struct RopeStraighten {
    bench: Bench,
    rope: Rope,
    stretch: f64,
    bend: f64,
    straight: Hold,
}

impl RopeStraighten {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles or the rope are missing; shapes that no rope has.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(RopeStraighten {
            bench: Bench::new(&args.arm, "straighten a rope", setup)?,
            rope: Rope::new(args.shapes, setup)?,
            stretch: args.stretch,
            bend: args.bend,
            straight: Hold::new(args.hold),
        })
    }

    /// Distance of the ends as a share of the length, and the largest distance from the line through them \[m\].
    fn shape(&self, data: &Data) -> [f64; 2] {
        let (first, last) = (*data.body(self.rope.links[0]).xpos(), self.rope.end(data));
        let way = sub(last, first);
        let span = norm(way).max(f64::MIN_POSITIVE);
        let along = scale(way, 1.0 / span);
        let bend =
            self.rope.places(data).map(|place| norm(cross(along, sub(place, first)))).fold(0.0, f64::max);
        [span / self.rope.length, bend]
    }

    fn is_straight(&self, [stretch, bend]: [f64; 2]) -> bool {
        stretch >= self.stretch && bend <= self.bend
    }
}

impl Task for RopeStraighten {
    fn defaults(&self) -> Defaults {
        let weights = [("stretch", 1.0), ("bend", -10.0), ("grasp", -1.0), ("held", 1.0), ("bonus", 100.0)];
        let rows = ["arm_pos", "arm_vel", "tip", "rope", "stretch", "bend", "grasp", "held"];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.rope.lay(episode.rng, episode.start)?;
        self.straight.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let straight = self.is_straight(self.shape(&turn.scene.data));
        self.straight.leave(straight);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let shape = self.shape(view.data);
        let grasp = norm(sub(self.rope.end(view.data), self.bench.tip(view)));
        self.bench.observe(view, rows);
        rows.set("rope", "m", self.rope.places(view.data).flatten());
        rows.set("stretch", "", [shape[0]]);
        rows.set("bend", "m", [shape[1]]);
        rows.set("grasp", "m", [grasp]);
        rows.set("held", "s", [self.straight.seconds(self.is_straight(shape), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let shape = [rows["stretch"][0], rows["bend"][0]];
        terms.set("stretch", "", [shape[0]]);
        terms.set("bend", "m", [shape[1]]);
        terms.set("grasp", "m", [rows["grasp"][0]]);
        self.straight.judge(rows["held"][0], self.is_straight(shape), false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["rope", "stretch", "bend", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.straight.keep(keeper);
    }
}
