//! Folding a cloth in half, and letting go of it.
//!
//! Observation beside that of all tasks: `cloth`, the places of its points row by row \[m\]; `apart`, the mean distance of the corners that are
//! to lie on each other: the first on the third and the second on the fourth \[m\]; `reach`, the distance from the fingertips to the
//! rod with the handle \[m\]; `touched`, whether the arm touches the cloth or its rods; `held`, for how long the cloth
//! has been folded and let go of \[s\]. Dense reward: minus ten times the distance of the corners, minus that of the fingertips, a tenth
//! less while the cloth is touched; one more while it is folded and free, 100 at the end. Sparse reward: 1 while it is. Solved: the
//! corners less than 2 cm apart on average, and nothing touches the cloth, for 0.5 s. Where it lies and how it is turned are drawn.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use super::cloth::Cloth;
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::Data;
use physics::math::distance;
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Mean distance of the corners that counts as folded \[m\].
    apart: f64,
    /// For how long it is to stay so without being touched \[s\].
    hold: f64,
    /// Places of the cloth, from that in the scene \[m\], and its turn \[rad\].
    places: Ranges<3>,
}

/// The task.
#[derive(Clone)]
pub struct ClothFold {
    bench: Bench,
    cloth: Cloth,
    apart: f64,
    places: Ranges<3>,
    folded: Hold,
}

impl ClothFold {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles or the cloth are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        Ok(ClothFold {
            bench: Bench::new(&args.arm, "fold a cloth", setup)?,
            cloth: Cloth::new(setup)?,
            apart: args.apart,
            places: args.places,
            folded: Hold::new(args.hold),
        })
    }

    /// Distances of the corners that are to lie on each other \[m\].
    fn apart(&self, data: &Data) -> [f64; 2] {
        let (places, [a, b, c, d]) = (self.cloth.places(data), self.cloth.corners());
        [distance(places[a], places[c]), distance(places[b], places[d])]
    }

    fn is_folded(&self, apart: [f64; 2], touched: bool) -> bool {
        (apart[0] + apart[1]) / 2.0 < self.apart && !touched
    }
}

impl Task for ClothFold {
    fn defaults(&self) -> Defaults {
        let weights = [("apart", -10.0), ("reach", -1.0), ("touched", -0.1), ("held", 1.0), ("bonus", 100.0)];
        let rows = ["arm_pos", "arm_vel", "tip", "cloth", "apart", "reach", "touched", "held"];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let place = self.places.draw(episode.rng)?;
        self.cloth.lay(episode.start, place, |flat| flat);
        self.folded.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let (m, data) = (&turn.scene.model, &turn.scene.data);
        let folded = self.is_folded(self.apart(data), self.cloth.is_touched(m, data));
        self.folded.leave(folded);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (apart, touched) = (self.apart(view.data), self.cloth.is_touched(view.model, view.data));
        let reach = distance(self.cloth.rods(view.data)[0], self.bench.tip(view));
        self.bench.observe(view, rows);
        rows.set("cloth", "m", self.cloth.places(view.data).iter().flatten());
        rows.set("apart", "m", [(apart[0] + apart[1]) / 2.0]);
        rows.set("reach", "m", [reach]);
        rows.set("touched", "", [f64::from(touched)]);
        rows.set("held", "s", [self.folded.seconds(self.is_folded(apart, touched), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (apart, touched) = (rows["apart"][0], rows["touched"][0] > 0.0);
        terms.set("apart", "m", [apart]);
        terms.set("reach", "m", [rows["reach"][0]]);
        terms.set("touched", "", [f64::from(touched)]);
        self.folded.judge(rows["held"][0], self.is_folded([apart; 2], touched), false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["cloth", "apart", "touched", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.folded.keep(keeper);
    }
}
