//! Spreading a cloth that lies folded, and letting go of it.
//!
//! Observation beside that of all tasks: `cloth`, the places of its points row by row \[m\]; `covered`, the area that it covers, seen from
//! above, as a share of its own; `moved`, how far the side that lies flat is from where it lay at the start \[m\]; `reach`, the distance from the
//! fingertips to the rod with the handle \[m\]; `touched`, whether the arm touches the cloth or its rods; `held`, for how long the cloth has been
//! spread and let go of \[s\]. Dense reward: the share that is covered, minus how far the flat side has moved and the distance of the
//! fingertips, a tenth less while the cloth is touched; one more while it is spread and free, 100 at the end. Sparse reward: 1
//! while it is. Solved: at least 90 % covered, the flat side moved by at most 5 cm, and nothing touches the cloth, for 0.5 s: an arm that
//! sweeps over the table drags a cloth open as well, but takes all of it along. At the start one side lies over the other,
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
use physics::math::{Vec3, distance};
use physics::{Data, Model};
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
    /// How far the side that lies flat may have moved \[m\].
    moved: f64,
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
    moved: f64,
    places: Ranges<3>,
    /// Where the middle of the flat side's seam lay at the start \[m\].
    flat: Vec3,
    spread: Hold,
}

/// What decides whether the cloth is spread, as in the rows of these names.
#[derive(Clone, Copy)]
struct State {
    covered: f64,
    moved: f64,
    touched: bool,
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
            moved: args.moved,
            places: args.places,
            flat: [0.0; 3],
            spread: Hold::new(args.hold),
        })
    }

    fn state(&self, m: &Model, data: &Data) -> State {
        let [_, seam] = self.cloth.rods(data);
        State {
            covered: self.cloth.covered(data),
            moved: distance(seam, self.flat),
            touched: self.cloth.is_touched(m, data),
        }
    }

    fn is_spread(&self, state: State) -> bool {
        state.covered >= self.covered && state.moved <= self.moved && !state.touched
    }
}

impl Task for ClothSpread {
    fn defaults(&self) -> Defaults {
        let weights = [
            ("covered", 1.0),
            ("moved", -1.0),
            ("reach", -1.0),
            ("touched", -0.1),
            ("held", 1.0),
            ("bonus", 100.0),
        ];
        let rows = ["arm_pos", "arm_vel", "tip", "cloth", "covered", "moved", "reach", "touched", "held"];
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
        [_, self.flat] = self.cloth.lay(episode.start, place, |[along, across, _]| {
            let over = fold - along;
            // The fold itself is at half the height.
            let up = LAYERS * (over / self.cloth.spacing()).clamp(-0.5, 0.5) + LAYERS / 2.0;
            [fold + over.abs(), across, up]
        });
        self.spread.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let state = self.state(&turn.scene.model, &turn.scene.data);
        self.spread.leave(self.is_spread(state));
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = self.state(view.model, view.data);
        self.bench.observe(view, rows);
        rows.set("cloth", "m", self.cloth.places(view.data).iter().flatten());
        rows.set("covered", "", [state.covered]);
        rows.set("moved", "m", [state.moved]);
        rows.set("reach", "m", [distance(self.cloth.rods(view.data)[0], self.bench.tip(view))]);
        rows.set("touched", "", [f64::from(state.touched)]);
        rows.set("held", "s", [self.spread.seconds(self.is_spread(state), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let [covered, moved, reach, touched] =
            ["covered", "moved", "reach", "touched"].map(|row| rows[row][0]);
        let spread = self.is_spread(State { covered, moved, touched: touched > 0.0 });
        terms.set("covered", "", [covered]);
        terms.set("moved", "m", [moved]);
        terms.set("reach", "m", [reach]);
        terms.set("touched", "", [touched]);
        self.spread.judge(rows["held"][0], spread, false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["cloth", "covered", "moved", "touched", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        keeper.numbers(&mut self.flat);
        self.spread.keep(keeper);
    }
}
