//! Hanging a cloth over a bar, and letting go of it.
//!
//! Observation beside that of all tasks: `cloth`, the places of its points row by row \[m\]; `bar`, the middle of the bar \[m\]; `off`, the
//! distance from the middle of the cloth to the bar \[m\]; `reach`, the distance from the fingertips to the rod with the handle \[m\];
//! `over`, whether its rods are on either side of the bar and below it; `touched`, whether arm or table touches cloth or rods; `held`, for how long it has hung \[s\]. Dense reward: minus five
//! times the distance of the cloth's middle, minus that of the fingertips, a tenth less while arm or table touch the cloth; one more while
//! it hangs, 100 at the end. Sparse reward: 1 while it hangs. Solved: the middle within 3 cm of the bar, a rod on either
//! side below it, and neither arm nor table touches the cloth, for 0.5 s. Where the cloth and the bar are is drawn.

use super::FRAME_SKIP;
use super::bench::{Arm, Bench};
use super::cloth::Cloth;
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::hold::Hold;
use crate::task::{Defaults, Episode, Pose, Setup, Success, Task, Turn, Verdict, View};
use physics::elements::GeomId;
use physics::math::{Vec3, add, column, cross, distance, norm, sub};
use physics::{Data, Model};
use robot::Keeper;
use serde::Deserialize;

/// Settings of the task.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    arm: Arm,
    /// Distance of the cloth's middle from the bar that counts as hanging on it \[m\].
    off: f64,
    /// For how long it is to hang \[s\].
    hold: f64,
    /// Places of the cloth, from that in the scene \[m\].
    places: Ranges<2>,
    /// Places of the bar: its distance along x, and its height, from those in the scene \[m\].
    bars: Ranges<2>,
}

/// The task.
#[derive(Clone)]
pub struct ClothHang {
    bench: Bench,
    cloth: Cloth,
    /// The bar, and where its body is in the scene \[m\].
    bar: (GeomId, Vec3),
    off: f64,
    places: Ranges<2>,
    bars: Ranges<2>,
    hung: Hold,
}

impl ClothHang {
    /// The task with these settings.
    ///
    /// # Errors
    /// Roles, the cloth or the geom `bar` are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let bar = setup.scene.geom("bar")?;
        let body = setup.scene.model.geom_bodyid[bar.index()] as usize;
        Ok(ClothHang {
            bench: Bench::new(&args.arm, "hang a cloth", setup)?,
            cloth: Cloth::new(setup)?,
            bar: (bar, setup.scene.model.body_pos[body]),
            off: args.off,
            places: args.places,
            bars: args.bars,
            hung: Hold::new(args.hold),
        })
    }

    /// Distance from the middle of the cloth to the bar \[m\].
    fn off(&self, m: &Model, data: &Data) -> f64 {
        let bar = self.bar.0.index();
        let axis = column(&data.kin.geom_xmat[bar], 2);
        norm(cross(axis, sub(self.cloth.middle(data), data.kin.geom_xpos[bar]))) - m.geom_size[bar][0]
    }

    /// Whether its rods hang on either side of the bar and below it.
    fn is_over(&self, data: &Data) -> bool {
        let bar = data.kin.geom_xpos[self.bar.0.index()];
        let [a, b] = self.cloth.rods(data).map(|rod| sub(rod, bar));
        a[0] * b[0] < 0.0 && a[2] < 0.0 && b[2] < 0.0
    }

    /// Whether anything but the bar touches the cloth.
    fn is_touched(&self, m: &Model, data: &Data) -> bool {
        let bar = m.geom_bodyid[self.bar.0.index()];
        self.cloth.touched_by(m, data, |body| body != bar)
    }

    fn is_hung(&self, off: f64, over: bool, touched: bool) -> bool {
        off < self.off && over && !touched
    }
}

impl Task for ClothHang {
    fn defaults(&self) -> Defaults {
        let weights = [("off", -5.0), ("reach", -1.0), ("touched", -0.1), ("held", 1.0), ("bonus", 100.0)];
        let rows = ["arm_pos", "arm_vel", "tip", "cloth", "bar", "off", "over", "reach", "touched", "held"];
        let defaults = Defaults::new(&rows, &weights, FRAME_SKIP).proprio(&["arm_pos", "arm_vel"]);
        Defaults { success: Success::MoreThan(0), ..defaults }
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        self.bench.initial_pose(pose);
        Ok(())
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let [x, y] = self.places.draw(episode.rng)?;
        let [aside, up] = self.bars.draw(episode.rng)?;
        let body = episode.scene.model.geom_bodyid[self.bar.0.index()] as usize;
        let place = add(self.bar.1, [aside, 0.0, up]);
        episode.scene.model.edit(|m| m.body_pos[body] = place)?;
        self.cloth.lay(episode.start, [x, y, 0.0], |flat| flat);
        self.hung.begin();
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        let (m, data) = (&turn.scene.model, &turn.scene.data);
        let hung = self.is_hung(self.off(m, data), self.is_over(data), self.is_touched(m, data));
        self.hung.leave(hung);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (off, over) = (self.off(view.model, view.data), self.is_over(view.data));
        let touched = self.is_touched(view.model, view.data);
        self.bench.observe(view, rows);
        rows.set("cloth", "m", self.cloth.places(view.data).iter().flatten());
        rows.set("bar", "m", view.data.kin.geom_xpos[self.bar.0.index()]);
        rows.set("off", "m", [off]);
        rows.set("over", "", [f64::from(over)]);
        rows.set("reach", "m", [distance(self.cloth.rods(view.data)[0], self.bench.tip(view))]);
        rows.set("touched", "", [f64::from(touched)]);
        rows.set("held", "s", [self.hung.seconds(self.is_hung(off, over, touched), view.dt)]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (off, over, touched) = (rows["off"][0], rows["over"][0] > 0.0, rows["touched"][0] > 0.0);
        terms.set("off", "m", [off]);
        terms.set("reach", "m", [rows["reach"][0]]);
        terms.set("touched", "", [f64::from(touched)]);
        self.hung.judge(rows["held"][0], self.is_hung(off, over, touched), false, terms)
    }

    fn resting_rows(&self) -> Vec<String> {
        ["cloth", "off", "over", "touched", "held"].map(String::from).to_vec()
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.hung.keep(keeper);
    }
}
