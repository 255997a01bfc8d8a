//! Scooping grains from a tray with a scoop under the hand, and carrying them up.
//!
//! Observation beside that of all tasks: `grains`, the places of all grains \[m\]; `tray`, the middle of the tray \[m\]; `scoop`, the
//! middle of the scoop's inside \[m\], and `scoop_up`, its upward axis; `scooped` and `spilled`, the shares of the grains that are in the
//! scoop, and that are in neither nor above the tray's rim; `height`, of the middle of the scoop over that rim \[m\]; `held`, for how
//! long all that has been as wanted \[s\]. Dense reward: the share in the scoop, at most as much as is wanted, over that; minus twice the
//! share spilled, minus the distance from scoop to tray, until enough grains are in the scoop, and the height that is wanting then; one
//! more while all is as wanted, 100 at the end. Sparse reward: 1 while it is. Solved: an eighth of the grains in the scoop, 50 mm over
//! the rim of the tray, and at most 5 % spilled for 0.5 s. The place of the tray and a fraction of a millimetre of every grain are drawn.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use super::grain::{Grains, Vessel, Whereabouts};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::math::distance;
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Least share of the grains in the scoop.
    scooped: f64,
    /// Largest share of the grains beside scoop and tray.
    spilled: f64,
    /// Least height of the scoop over the rim of the tray \[m\].
    height: f64,
    /// For how long all is to be as wanted \[s\].
    hold: f64,
    /// Places of the tray on the table \[m\].
    places: Ranges<2>,
}

/// How far the task has come.
#[derive(Clone, Copy)]
struct Progress {
    scooped: f64,
    spilled: f64,
    height: f64,
}

/// The task.
#[derive(Clone)]
pub struct GrainScoop {
    bench: Bench,
    scoop: Vessel,
    tray: Vessel,
    grains: Grains,
    wanted: Progress,
    places: Ranges<2>,
    done: Hold,
}

impl GrainScoop {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles, scoop, tray or grains are missing; a share that is none.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        if !(args.scooped > 0.0 && args.scooped <= 1.0) {
            return Err(setup.wrong("scooped is a share of the grains, above 0 and at most 1"));
        }
        Ok(GrainScoop {
            bench: Bench::new(&args.arm, "scoop grains", setup)?,
            scoop: Vessel::new("scoop", setup)?,
            tray: Vessel::new("tray", setup)?,
            grains: Grains::new(setup)?,
            wanted: Progress { scooped: args.scooped, spilled: args.spilled, height: args.height },
            places: args.places,
            done: Hold::new(args.hold),
        })
    }

    fn progress(&self, m: &Model, data: &Data) -> Progress {
        let is_in = |grain| self.scoop.whereabouts(grain, m, data) == Whereabouts::Inside;
        let is_beside = |grain| self.tray.whereabouts(grain, m, data) == Whereabouts::Beside;
        Progress {
            scooped: self.grains.share(data, is_in),
            spilled: self.grains.share(data, |grain| is_beside(grain) && !is_in(grain)),
            height: self.scoop.middle(data)[2] - self.tray.rim(m, data),
        }
    }

    fn is_done(&self, now: Progress) -> bool {
        let wanted = self.wanted;
        now.scooped >= wanted.scooped && now.spilled <= wanted.spilled && now.height >= wanted.height
    }
}

impl Task for GrainScoop {
    fn defaults(&self) -> Defaults {
        let weights = [
            ("scooped", 1.0),
            ("spilled", -2.0),
            ("reach", -1.0),
            ("low", -1.0),
            ("held", 1.0),
            ("bonus", 100.0),
        ];
        let rows = [
            "arm_pos", "arm_vel", "tip", "grains", "tray", "scoop", "scoop_up", "scooped", "spilled",
            "height", "held",
        ];
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
        let data = view.data;
        let now = self.progress(view.model, data);
        self.bench.observe(view, rows);
        self.grains.observe(view, rows);
        rows.set("tray", "m", self.tray.middle(data));
        rows.set("scoop", "m", self.scoop.middle(data));
        rows.set("scoop_up", "", self.scoop.up(data));
        rows.set("scooped", "", [now.scooped]);
        rows.set("spilled", "", [now.spilled]);
        rows.set("height", "m", [now.height]);
        rows.set("held", "s", [self.done.seconds(self.is_done(now), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let [scooped, spilled, height] = ["scooped", "spilled", "height"].map(|row| rows[row][0]);
        let place = |row: &str| std::array::from_fn(|i| rows[row][i]);
        let enough = scooped >= self.wanted.scooped;
        terms.set("scooped", "", [(scooped / self.wanted.scooped).min(1.0)]);
        terms.set("spilled", "", [spilled]);
        terms.set("reach", "m", [if enough { 0.0 } else { distance(place("scoop"), place("tray")) }]);
        terms.set("low", "m", [if enough { (self.wanted.height - height).max(0.0) } else { 0.0 }]);
        let done = self.is_done(Progress { scooped, spilled, height });
        self.done.judge(rows["held"][0], done, false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["scooped", "spilled", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.done.keep(keeper);
    }
}
