//! A hopper on a boom: one leg with a spring, at the end of a boom that turns about the vertical and tilts, is to hop round in a circle
//! (Raibert, Legged robots that balance, MIT Press 1986, chapters 2 and 3: hopping in a plane). The boom keeps the body upright.
//!
//! Action: angle that the hip is told, -1 to 1 for -0.6 to 0.6 rad, and thrust along the leg, for 0 to 150 N. Observation: tilt of the boom
//! \[rad\], angle of the hip \[rad\] and shortening of the leg \[m\], velocities of boom, hip and leg, whether the foot stands. Dense
//! reward: turning of the boom \[rad/s\], 0.2 a step while it has not fallen, 100 at the end, -100 where it falls. Sparse reward: turning. Solved:
//! a whole turn forwards, which ends the episode; it has fallen where the boom tilts 0.1 rad below level. Episodes start in the air at any
//! place of the circle, and last 20 s.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Success, Task, Verdict, View};
use physics::elements::GeomId;
use robot::Keeper;
use serde::Deserialize;
use std::f64::consts::{PI, TAU};

/// Positions: turn and tilt of the boom, hip, leg.
const TURN: usize = 0;
const TILT: usize = 1;

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Turns to make.
    turns: f64,
    /// Tilt below which the hopper has fallen \[rad\].
    fallen: f64,
    /// Tilts at the start \[rad\].
    tilt: [f64; 2],
    /// Largest angle of the hip at the start \[rad\].
    hip: f64,
}

#[derive(Clone)]
pub struct HopperBoom {
    foot: GeomId,
    args: Args,
    /// Turn of the boom at the start \[rad\].
    began: f64,
}

impl HopperBoom {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model is no hopper on a boom.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let m = &setup.scene.model;
        if m.nq != 4 || m.nv != 4 {
            return Err(setup.wrong("the model has four joints: turn and tilt of the boom, hip, leg"));
        }
        Ok(HopperBoom { foot: setup.scene.geom("foot")?, args, began: 0.0 })
    }
}

impl Task for HopperBoom {
    fn defaults(&self) -> Defaults {
        let weights = [("speed", 1.0), ("alive", 0.2), ("bonus", 100.0), ("penalty", -100.0)];
        let rows = ["tilt", "leg", "velocities", "stance"];
        let defaults = Defaults::new(&rows, &weights, 10);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["tilt", "leg", "velocities"])
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.began = episode.rng.uniform(-PI, PI)?;
        let tilt = episode.rng.uniform(self.args.tilt[0], self.args.tilt[1])?;
        let hip = episode.rng.uniform(-self.args.hip, self.args.hip)?;
        episode.start.qpos.copy_from_slice(&[self.began, tilt, hip, 0.0]);
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        let stands = view.data.contacts().any(|contact| contact.touches(self.foot));
        rows.set("tilt", "rad", [state.qpos[TILT]]);
        rows.set("leg", "rad, m", &state.qpos[TILT + 1..]);
        rows.set("velocities", "rad/s, m/s", &state.qvel);
        rows.set("stance", "", [f64::from(stands)]);
        rows.set("turned", "rad", [state.qpos[TURN] - self.began]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let (speed, fallen) = (rows["velocities"][TURN], rows["tilt"][0] < self.args.fallen);
        let solved = rows["turned"][0] > self.args.turns * TAU && !fallen;
        terms.set("speed", "rad/s", [speed]);
        terms.set("alive", "", [f64::from(!fallen)]);
        terms.set("bonus", "", [f64::from(solved)]);
        terms.set("penalty", "", [f64::from(fallen)]);
        Verdict { sparse: speed, solved, done: solved || fallen }
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["stance".into()]
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        keeper.number(&mut self.began);
    }
}
