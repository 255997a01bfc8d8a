//! Scooping grains: nose first into the tray, level along its floor to the wall in front, nose up there, and straight up.

use super::held::{Held, Work};
use crate::error::ControlError;
use crate::tasks::arms::frame::Frame;
use crate::tasks::arms::moves::Move;
use env::Env;
use physics::elements::{BodyId, SiteId};
use physics::math::{add, ops, quat_mul, quat_rotate, scale, sub};

/// How far the nose points down where it goes in, half way to the wall and along it, and up in the end \[rad\].
const TURNS: [f64; 4] = [-0.5, -0.15, 0.0, 0.45];
/// Height of the nose over the floor of the tray \[m\].
const LOW: f64 = 0.004;
/// Distance of the nose from the wall in front \[m\].
const WALL: f64 = 0.02;
/// How far over the floor of the tray the scoop is carried \[m\].
const CARRY: f64 = 0.15;
/// Speeds over and in the grains, as shares of full speed.
const SPEED: [f64; 2] = [0.5, 0.3];
/// How long the scoop is kept up before it is said whether enough is in it \[s\].
const PAUSE: f64 = 0.3;

pub struct GrainScoop {
    body: BodyId,
    /// Insides of the scoop and of the tray.
    scoop: SiteId,
    tray: SiteId,
}

impl GrainScoop {
    /// The script for an arm whose hand holds a scoop that is open forwards, along the y axis of its frame.
    ///
    /// # Errors
    /// The environment has no scoop or no tray.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        let scene = env.scene();
        let (body, scoop, tray) = (scene.body("scoop")?, scene.site("scoop")?, scene.site("tray")?);
        Ok(GrainScoop { body, scoop, tray })
    }
}

impl Work for GrainScoop {
    fn body(&self) -> BodyId {
        self.body
    }

    fn plan(&self, held: &Held, env: &Env) -> Vec<Move> {
        let m = &env.scene().model;
        let [middle, half, wide] =
            [m.site_pos[self.scoop.index()], m.site_size[self.scoop.index()], m.site_size[self.tray.index()]];
        let tray = Frame::of_site(&env.scene().data, self.tray);
        let ahead = quat_rotate(held.frame.turn, [0.0, 1.0, 0.0]);
        // The tool, when the scoop has turned and an edge of its floor, in front or at the back, is somewhere before the middle of the
        // tray and over its floor.
        let at = |side: f64, before: f64, height: f64, turn: f64| {
            let (sine, cosine) = ops::sincos(turn / 2.0);
            let turn = quat_mul(held.frame.turn, [cosine, sine, 0.0, 0.0]);
            let edge = quat_rotate(turn, add(middle, [0.0, side * half[1], -half[2]]));
            let place = add(tray.point([0.0, 0.0, height - wide[2]]), scale(ahead, before));
            held.tool(Frame { place: sub(place, edge), turn })
        };
        let length = 2.0 * half[1];
        let [enter, end] = [0.9 * length - wide[1], wide[1] - WALL];
        let [down, less, level, up] = TURNS;
        let (nose, back) = (1.0, -1.0);
        let over = |to, pause| Move::precise(to, 0.0, SPEED[0], pause);
        let within = |to| Move::precise(to, 0.0, SPEED[1], 0.0);
        vec![
            over(at(nose, enter, CARRY, down), 0.0),
            within(at(nose, enter, LOW, down)),
            within(at(nose, f64::midpoint(enter, end), LOW, less)),
            within(at(nose, end, LOW, level)),
            within(at(back, end - length, LOW, up / 2.0)),
            within(at(back, end - length, LOW, up)),
            within(at(back, end - length, CARRY, up)),
            over(at(back, end - length, CARRY, up), PAUSE),
        ]
    }
}
