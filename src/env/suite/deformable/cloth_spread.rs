//! Spreading a cloth that lies folded, and letting go of it.
//!
//! Observation beside that of all tasks: `cloth`, the places of its points row by row \[m\]; `covered`, the area that it covers, seen from
//! above, as a share of its own; `reach`, the distance from the fingertips to the rod with the handle \[m\]; `touched`, whether the arm touches the
//! cloth or its rods; `held`, for how long the cloth has been spread and let go of \[s\]. Dense reward: the share that is covered, minus the
//! distance of the fingertips, a tenth less while the cloth is touched; one more while it is spread and free, 100 at the end. Sparse reward: 1
//! while it is. Solved: at least 90 % covered, and nothing touches the cloth, for 0.5 s. At the start one side lies over the other,
//! folded in the middle or a row of points beside it: it covers half or two thirds. Fold, place and turn are drawn.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use super::cloth::Cloth;
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::math::distance;
use robot::Keeper;
use serde::Deserialize;

/// Distance of the layers at the start \[m\].
const LAYERS: f64 = 0.0105;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Least share that counts as spread.
    covered: f64,
    /// For how long it is to stay so without being touched \[s\].
    hold: f64,
    /// Places of the cloth, from that in the scene \[m\], and its turn \[rad\].
    places: Ranges<3>,
}

/// The task.
#[derive(Clone)]
pub struct ClothSpread {
    bench: Bench,
    cloth: Cloth,
    covered: f64,
    places: Ranges<3>,
    spread: Hold,
}

impl ClothSpread {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles or the cloth are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(ClothSpread {
            bench: Bench::new(&args.arm, "spread a cloth", setup)?,
            cloth: Cloth::new(setup)?,
            covered: args.covered,
            places: args.places,
            spread: Hold::new(args.hold),
        })
    }

    fn is_spread(&self, covered: f64, touched: bool) -> bool {
        covered >= self.covered && !touched
    }
}

impl Task for ClothSpread {
    fn defaults(&self) -> Defaults {
        let weights = [("covered", 1.0), ("reach", -1.0), ("touched", -0.1), ("held", 1.0), ("bonus", 100.0)];
        let rows = ["arm_pos", "arm_vel", "tip", "cloth", "covered", "reach", "touched", "held"];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let place = self.places.draw(episode.rng)?;
        let row = (3.0 * episode.rng.uniform(0.0, 1.0)?).floor().min(2.0) - 1.0;
        let fold = row * self.cloth.spacing();
        self.cloth.lay(episode.start, place, |[along, across, _]| {
            let over = fold - along;
            // The fold itself is at half the height.
            let up = LAYERS * (over / self.cloth.spacing()).clamp(-0.5, 0.5) + LAYERS / 2.0;
            [fold + over.abs(), across, up]
        });
        self.spread.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let (m, data) = (&turn.scene.model, &turn.scene.data);
        let spread = self.is_spread(self.cloth.covered(data), self.cloth.is_touched(m, data));
        self.spread.leave(spread);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (covered, touched) =
            (self.cloth.covered(view.data), self.cloth.is_touched(view.model, view.data));
        self.bench.observe(view, rows);
        rows.set("cloth", "m", self.cloth.places(view.data).iter().flatten());
        rows.set("covered", "", [covered]);
        rows.set("reach", "m", [distance(self.cloth.rods(view.data)[0], self.bench.tip(view))]);
        rows.set("touched", "", [f64::from(touched)]);
        rows.set("held", "s", [self.spread.seconds(self.is_spread(covered, touched), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (covered, touched) = (rows["covered"][0], rows["touched"][0] > 0.0);
        terms.set("covered", "", [covered]);
        terms.set("reach", "m", [rows["reach"][0]]);
        terms.set("touched", "", [f64::from(touched)]);
        self.spread.judge(rows["held"][0], self.is_spread(covered, touched), false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["cloth", "covered", "touched", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.spread.keep(keeper);
    }
}
