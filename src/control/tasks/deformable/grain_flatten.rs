//! Flattening grains: the blade is led to and fro over the tray at three heights, the lowest a little over one layer of grains, and lifted.

use super::held::{Held, Work};
use crate::error::ControlError;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::moves::Move;
use env::Env;
use physics::elements::{BodyId, SiteId};
use physics::math::{add, quat_rotate, scale};

/// Height of the blade's lower edge over the floor of the tray on each way, in diameters of a grain.
const HEIGHTS: [f64; 4] = [2.4, 1.7, 1.15, 1.15];
/// Distance of the blade from the walls, in diameters of a grain.
const WALL: f64 = 1.3;
/// How far over the floor the blade is carried \[m\].
const CARRY: f64 = 0.1;
/// Speeds over and in the grains, as shares of full speed.
const SPEED: [f64; 2] = [0.6, 0.4];
/// How long the blade is kept up before it is said whether the grains are flat \[s\].
const PAUSE: f64 = 0.3;

pub struct GrainFlatten {
    blade: BodyId,
    tray: SiteId,
    /// Diameter of a grain \[m\].
    grain: f64,
}

impl GrainFlatten {
    /// The script for an arm whose hand holds a blade across the y axis of its frame, which begins at its lower edge.
    ///
    /// # Errors
    /// The environment has no blade, no tray or no grains.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let m = &scene.model;
        let geom = m.body_names().find(|(_, name)| name.starts_with("grain"));
        let geom = geom.and_then(|(id, _)| usize::try_from(m.body_geomadr[id.index()]).ok());
        let geom = geom.ok_or_else(|| ControlError::unfit(env, "the scene has no grains"))?;
        let (blade, tray) = (scene.body("blade")?, scene.site("tray")?);
        Ok(GrainFlatten { blade, tray, grain: 2.0 * m.geom_size[geom][0] })
    }
}

impl Work for GrainFlatten {
    fn body(&self) -> BodyId {
        self.blade
    }

    fn plan(&self, held: &Held, env: &Env) -> Vec<Move> {
        let half = env.scene().model.site_size[self.tray.index()];
        let tray = Frame::of_site(&env.scene().data, self.tray);
        let ahead = quat_rotate(held.frame.turn, [0.0, 1.0, 0.0]);
        let at = |before: f64, height: f64| {
            let place = add(tray.point([0.0, 0.0, height - half[2]]), scale(ahead, before));
            held.tool(Frame { place, turn: held.frame.turn })
        };
        let end = half[1] - WALL * self.grain;
        let over = |to, pause| Move::precise(to, 0.0, SPEED[0], pause);
        let within = |to| Move::precise(to, 0.0, SPEED[1], 0.0);
        let mut plan = vec![over(at(-end, CARRY), 0.0)];
        let mut side = -end;
        for height in HEIGHTS.map(|height| height * self.grain) {
            plan.extend([side, -side].map(|before| within(at(before, height))));
            side = -side;
        }
        plan.extend([0.0, PAUSE].map(|pause| over(at(side, CARRY), pause)));
        plan
    }
}
