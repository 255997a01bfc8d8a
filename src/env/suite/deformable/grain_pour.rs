//! Pouring grains from a cup, which is welded to the hand, into a bowl on the table.
//!
//! Observation beside that of all tasks: `grains`, the places of all grains \[m\]; `bowl`, the middle of the bowl \[m\]; `cup`, the way
//! from the cup to it \[m\], and `cup_up`, the cup's axis in the world's frame; `poured` and `spilled`, the shares of the grains that are in the
//! bowl, and that are neither there nor above its rim; `held`, for how long that has been as wanted \[s\]. Dense reward: the share
//! in the bowl, minus twice the share spilled, minus the horizontal distance from cup to bowl; one more while it is as wanted, 100 at
//! the end. Sparse reward: 1 while it is. Solved: 90 % of the grains in the bowl and at most 5 % spilled for 0.5 s. The place of the bowl and
//! a fraction of a millimetre of every grain are drawn.

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
use physics::math::sub;
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Least share of the grains in the bowl.
    poured: f64,
    /// Largest share of the grains beside it.
    spilled: f64,
    /// For how long both are to be as wanted \[s\].
    hold: f64,
    /// Places of the bowl on the table \[m\].
    places: Ranges<2>,
}

/// The task.
#[derive(Clone)]
pub struct GrainPour {
    bench: Bench,
    cup: BodyId,
    bowl: Vessel,
    grains: Grains,
    poured: f64,
    spilled: f64,
    places: Ranges<2>,
    done: Hold,
}

impl GrainPour {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles, cup, bowl or grains, free bodies whose names begin with `grain`, are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(GrainPour {
            bench: Bench::new(&args.arm, "pour grains", setup)?,
            cup: setup.scene.body("cup")?,
            bowl: Vessel::new("bowl", setup)?,
            grains: Grains::new(setup)?,
            poured: args.poured,
            spilled: args.spilled,
            places: args.places,
            done: Hold::new(args.hold),
        })
    }

    /// Shares of the grains in the bowl, and neither there nor above its rim.
    fn shares(&self, m: &Model, data: &Data) -> [f64; 2] {
        // Where grains are heaped, those over the rim count for nothing yet.
        [Whereabouts::Inside, Whereabouts::Beside]
            .map(|wanted| self.grains.share(data, |grain| self.bowl.whereabouts(grain, m, data) == wanted))
    }

    fn is_done(&self, [poured, spilled]: [f64; 2]) -> bool {
        poured >= self.poured && spilled <= self.spilled
    }
}

impl Task for GrainPour {
    fn defaults(&self) -> Defaults {
        let weights = [("poured", 1.0), ("spilled", -2.0), ("reach", -1.0), ("held", 1.0), ("bonus", 100.0)];
        let rows =
            ["arm_pos", "arm_vel", "tip", "grains", "bowl", "cup", "cup_up", "poured", "spilled", "held"];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let place = self.places.draw(episode.rng)?;
        self.bowl.put(place, episode)?;
        self.grains.jitter(episode.rng, episode.start)?;
        self.done.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let done = self.is_done(self.shares(&turn.scene.model, &turn.scene.data));
        self.done.leave(done);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let shares = self.shares(view.model, view.data);
        let (cup, bowl) = (view.data.body(self.cup), self.bowl.middle(view.data));
        let axes = cup.xmat();
        self.bench.observe(view, rows);
        self.grains.observe(view, rows);
        rows.set("bowl", "m", bowl);
        rows.set("cup", "m", sub(bowl, *cup.xpos()));
        rows.set("cup_up", "", [axes[2], axes[5], axes[8]]);
        rows.set("poured", "", [shares[0]]);
        rows.set("spilled", "", [shares[1]]);
        rows.set("held", "s", [self.done.seconds(self.is_done(shares), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let shares = [rows["poured"][0], rows["spilled"][0]];
        terms.set("poured", "", [shares[0]]);
        terms.set("spilled", "", [shares[1]]);
        terms.set("reach", "m", [norm(&rows["cup"][..2])]);
        self.done.judge(rows["held"][0], self.is_done(shares), false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["poured", "spilled", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.done.keep(keeper);
    }
}
