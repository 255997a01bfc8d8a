//! Flattening a heap of grains in a tray with a blade under the hand.
//!
//! Observation beside that of all tasks: `grains`, the places of all grains \[m\]; `tray`, the middle of the tray \[m\]; `blade`, the
//! middle of the blade's lower edge \[m\]; `spread`, the standard deviation of the grains' heights \[m\]; `inside`, the share of the
//! grains that are in the tray or higher than its rim; `clear`, the height of the blade over the highest grain \[m\]; `held`, for how
//! long all that has been as wanted \[s\]. Dense reward: minus a hundred times the spread, minus twice the share outside, minus the
//! horizontal distance from blade to tray; one more while all is as wanted, 100 at the end. Sparse reward: 1 while it is. Solved: a
//! spread of at most 2.5 mm, where one of ten grains on a second layer is too many, at least 95 % of the grains inside, and the blade 20
//! mm clear of them for 0.5 s. The place of the tray and a fraction of a millimetre of every grain are drawn.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use super::grain::{Grains, Vessel, Whereabouts};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::BodyId;
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Largest standard deviation of the grains' heights \[m\].
    spread: f64,
    /// Least share of the grains in the tray.
    inside: f64,
    /// Least height of the blade over the highest grain \[m\].
    clear: f64,
    /// For how long all is to be as wanted \[s\].
    hold: f64,
    /// Places of the tray on the table \[m\].
    places: Ranges<2>,
}

/// How far the task has come.
#[derive(Clone, Copy)]
struct Progress {
    spread: f64,
    inside: f64,
    clear: f64,
}

/// The task.
#[derive(Clone)]
pub struct GrainFlatten {
    bench: Bench,
    blade: BodyId,
    tray: Vessel,
    grains: Grains,
    wanted: Progress,
    places: Ranges<2>,
    done: Hold,
}

impl GrainFlatten {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles, blade, tray or grains are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(GrainFlatten {
            bench: Bench::new(&args.arm, "flatten grains", setup)?,
            blade: setup.scene.body("blade")?,
            tray: Vessel::new("tray", setup)?,
            grains: Grains::new(setup)?,
            wanted: Progress { spread: args.spread, inside: args.inside, clear: args.clear },
            places: args.places,
            done: Hold::new(args.hold),
        })
    }

    fn progress(&self, m: &Model, data: &Data) -> Progress {
        let heights = || self.grains.places(data).map(|place| place[2]);
        let count = heights().count() as f64;
        let mean = heights().sum::<f64>() / count;
        let variance = heights().map(|height| (height - mean) * (height - mean)).sum::<f64>() / count;
        let top = heights().fold(f64::NEG_INFINITY, f64::max) + self.grains.radius;
        let is_in = |grain| self.tray.whereabouts(grain, m, data) != Whereabouts::Beside;
        Progress {
            spread: variance.sqrt(),
            inside: self.grains.share(data, is_in),
            clear: data.body(self.blade).xpos()[2] - top,
        }
    }

    fn is_done(&self, now: Progress) -> bool {
        let wanted = self.wanted;
        now.spread <= wanted.spread && now.inside >= wanted.inside && now.clear >= wanted.clear
    }
}

impl Task for GrainFlatten {
    fn defaults(&self) -> Defaults {
        let weights =
            [("spread", -100.0), ("outside", -2.0), ("reach", -1.0), ("held", 1.0), ("bonus", 100.0)];
        let rows =
            ["arm_pos", "arm_vel", "tip", "grains", "tray", "blade", "spread", "inside", "clear", "held"];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let place = self.places.draw(episode.rng)?;
        self.grains.put(&self.tray, place, episode)?;
        self.done.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let done = self.is_done(self.progress(&turn.scene.model, &turn.scene.data));
        self.done.leave(done);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let now = self.progress(view.model, view.data);
        self.bench.observe(view, rows);
        self.grains.observe(view, rows);
        rows.set("tray", "m", self.tray.middle(view.data));
        rows.set("blade", "m", *view.data.body(self.blade).xpos());
        rows.set("spread", "m", [now.spread]);
        rows.set("inside", "", [now.inside]);
        rows.set("clear", "m", [now.clear]);
        rows.set("held", "s", [self.done.seconds(self.is_done(now), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let [spread, inside, clear] = ["spread", "inside", "clear"].map(|row| rows[row][0]);
        let way: [f64; 2] = std::array::from_fn(|i| rows["blade"][i] - rows["tray"][i]);
        terms.set("spread", "m", [spread]);
        terms.set("outside", "", [1.0 - inside]);
        terms.set("reach", "m", [norm(&way)]);
        self.done.judge(rows["held"][0], self.is_done(Progress { spread, inside, clear }), false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["inside", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.done.keep(keeper);
    }
}
