//! Wrapping a rope, one end on a post, once round a peg, and letting go of it.
//!
//! Observation beside that of all tasks: `rope`, the places of its ends and of the joints between its links, from the post to the loose
//! end \[m\]; `peg`, the foot of the peg \[m\]; `winding`, the angle by which the rope goes round the peg from its first end to its last, seen
//! from above and counterclockwise \[rad\]; `grasp`, the distance from the fingertips to the loose end \[m\]; `touched`, whether the arm
//! touches the rope; `held`, for how long the rope has been wrapped and let go of \[s\]. Dense reward: the winding in turns, minus the
//! distance to the loose end, a tenth less while the rope is touched; one more while it is wrapped and free, 100 at the end. Sparse reward:
//! 1 while it is. Solved: a winding of a full turn, and nothing touches the rope, for 0.5 s. At the start the rope passes the peg, which
//! is 0.4 to 0.5 of a turn; where the peg stands and how the rope lies are drawn.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use super::rope::{Rope, Shapes};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rotation::shorter;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::BodyId;
use physics::math::{norm, ops, sub};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::TAU;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Turns of the rope round the peg that are wanted.
    turns: f64,
    /// For how long the rope is to stay so without being touched \[s\].
    hold: f64,
    shapes: Shapes,
    /// Places of the peg on the table \[m\].
    places: Ranges<2>,
}

/// The task.
#[derive(Clone)]
pub struct RopeWrap {
    bench: Bench,
    rope: Rope,
    peg: BodyId,
    turns: f64,
    places: Ranges<2>,
    wrapped: Hold,
}

impl RopeWrap {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles, the rope or the body `peg` are missing; shapes that no rope has.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(RopeWrap {
            bench: Bench::new(&args.arm, "wrap a rope round a peg", setup)?,
            rope: Rope::new(args.shapes, setup)?,
            peg: setup.scene.body("peg")?,
            turns: args.turns,
            places: args.places,
            wrapped: Hold::new(args.hold),
        })
    }

    /// Angle by which the rope goes round the peg, counterclockwise from above \[rad\].
    fn winding(&self, data: &Data) -> f64 {
        let peg = *data.body(self.peg).xpos();
        let mut before: Option<f64> = None;
        let turns = self.rope.places(data).map(|place| {
            let [x, y, _] = sub(place, peg);
            let angle = ops::atan2(y, x);
            let turn = before.map_or(0.0, |before| angle - before);
            before = Some(angle);
            // The shorter way from one place to the next.
            shorter(turn)
        });
        turns.sum()
    }

    /// Whether anything that moves, and is not the rope, touches it.
    fn is_touched(&self, m: &Model, data: &Data) -> bool {
        let (first, count) = (self.rope.links[0].index(), self.rope.links.len());
        let body = |geom: i32| usize::try_from(geom).ok().map(|geom| m.geom_bodyid[geom] as usize);
        data.con.contact.iter().any(|contact| {
            let [a, b] = contact.geom.map(body);
            let roped = [a, b].map(|body| body.is_some_and(|body| (first..first + count).contains(&body)));
            let other = if roped[0] { b } else { a };
            roped[0] != roped[1] && other.is_none_or(|body| m.body_weldid[body] != 0)
        })
    }

    fn is_wrapped(&self, winding: f64, touched: bool) -> bool {
        winding >= TAU * self.turns && !touched
    }
}

impl Task for RopeWrap {
    fn defaults(&self) -> Defaults {
        let weights = [("winding", 1.0), ("grasp", -1.0), ("touched", -0.1), ("held", 1.0), ("bonus", 100.0)];
        let rows = ["arm_pos", "arm_vel", "tip", "rope", "peg", "winding", "grasp", "touched", "held"];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let (place, body) = (self.places.draw(episode.rng)?, self.peg.index());
        episode.scene.model.edit(|m| m.body_pos[body][..2].copy_from_slice(&place))?;
        self.rope.lay(episode.rng, episode.start)?;
        self.wrapped.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let (m, data) = (&turn.scene.model, &turn.scene.data);
        let wrapped = self.is_wrapped(self.winding(data), self.is_touched(m, data));
        self.wrapped.leave(wrapped);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (winding, touched) = (self.winding(view.data), self.is_touched(view.model, view.data));
        let grasp = norm(sub(self.rope.end(view.data), self.bench.tip(view)));
        self.bench.observe(view, rows);
        rows.set("rope", "m", self.rope.places(view.data).flatten());
        rows.set("peg", "m", view.data.body(self.peg).xpos());
        rows.set("winding", "rad", [winding]);
        rows.set("grasp", "m", [grasp]);
        rows.set("touched", "", [f64::from(touched)]);
        rows.set("held", "s", [self.wrapped.seconds(self.is_wrapped(winding, touched), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (winding, touched) = (rows["winding"][0], rows["touched"][0] > 0.0);
        terms.set("winding", "", [winding / TAU]);
        terms.set("grasp", "m", [rows["grasp"][0]]);
        terms.set("touched", "", [f64::from(touched)]);
        self.wrapped.judge(rows["held"][0], self.is_wrapped(winding, touched), false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["rope", "winding", "touched", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.wrapped.keep(keeper);
    }
}
