//! Two poles of 1 m and 0.1 m side by side on one cart are to be balanced (Wieland, Evolving neural network controllers for unstable
//! systems, IJCNN 1991; masses, track and bounds as in Gomez and Miikkulainen, 2-D pole balancing with recurrent evolutionary
//! networks, ICANN 1998). A short pole falls faster than a long one, which is all that tells them apart.
//!
//! Action: force on the cart, -1 to 1 for -10 to 10 N. Observation: position of the cart \[m\], angles of the poles from upright
//! \[rad\], their velocities. Dense reward: 1 a step, less the square of each angle over 0.63 rad and of the position over 2.4 m; -100 where a
//! pole falls. Sparse reward: 1 a step. Solved: no pole leaves 36 degrees and the cart stays within 2.4 m for 1000 steps of 0.02 s.
//! Episodes start with the cart within 1 m, the long pole within 4 degrees and the short one within 1 degree, all at rest.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Defaults, Episode, Setup, Success, Task, Verdict, View};
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    /// Largest distance of the cart from the middle \[m\].
    track: f64,
    /// Largest angle of a pole \[rad\].
    angle: f64,
    /// Steps to survive.
    steps: usize,
    /// Largest position of the cart and angles of the poles at the start \[m, rad, rad\].
    start: [f64; 3],
}

#[derive(Clone)]
pub struct DoublePole {
    bounds: [f64; 3],
    steps: usize,
    start: [f64; 3],
}

impl DoublePole {
    /// The task with these settings.
    ///
    /// # Errors
    /// The model is no cart with two poles.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let m = &setup.scene.model;
        if m.nq != 3 || m.nv != 3 {
            return Err(setup.wrong("the model has three joints: the cart's, and those of two poles"));
        }
        Ok(DoublePole { bounds: [args.track, args.angle, args.angle], steps: args.steps, start: args.start })
    }
}

impl Task for DoublePole {
    fn defaults(&self) -> Defaults {
        let weights = [("alive", 1.0), ("away", -1.0), ("penalty", -100.0)];
        let defaults = Defaults::new(&["positions", "velocities"], &weights, 4);
        Defaults { success: Success::MoreThan(0), ..defaults }.proprio(&["positions", "velocities"])
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        for (place, most) in episode.start.qpos.iter_mut().zip(self.start) {
            *place = most * episode.rng.uniform(-1.0, 1.0)?;
        }
        Ok(())
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        rows.set("positions", "m, rad", &view.data.state.qpos);
        rows.set("velocities", "m/s, rad/s", &view.data.state.qvel);
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let shares = [0, 1, 2].map(|i| rows["positions"][i] / self.bounds[i]);
        let fallen = shares.iter().any(|share| share.abs() > 1.0);
        terms.set("alive", "", [f64::from(!fallen)]);
        terms.set("away", "", [shares.iter().map(|share| share * share).sum::<f64>() / 3.0]);
        terms.set("penalty", "", [f64::from(fallen)]);
        Verdict { sparse: f64::from(!fallen), solved: !fallen && view.steps >= self.steps, done: fallen }
    }

    fn rewards_paths(&self) -> bool {
        false
    }
}
