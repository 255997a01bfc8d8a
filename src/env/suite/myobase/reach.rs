//! Reaching: tips of fingers are to come to their targets.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::suite::muscle::{Condition, Muscles, effort};
use crate::suite::myobase::tips::Tips;
use crate::suite::named::Named;
use crate::task::{Defaults, Episode, Setup, Task, Turn, Verdict, View};
use robot::Keeper;
use serde::Deserialize;

/// Distance \[m\] of a tip within which it has arrived.
const NEAR: f64 = 0.0125;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    target_reach_range: Named<[[f64; 3]; 2]>,
    #[serde(default = "far_th")]
    far_th: f64,
    #[serde(default)]
    muscle_condition: Condition,
}

fn far_th() -> f64 {
    0.35
}

#[derive(Clone)]
pub struct Reach {
    muscles: Muscles,
    tips: Tips,
}

impl Reach {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit, or sites are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(args.muscle_condition, setup)?;
        let tips = Tips::new(setup.scene, &args.target_reach_range, NEAR, args.far_th)?;
        Ok(Reach { muscles, tips })
    }
}

impl Task for Reach {
    fn defaults(&self) -> Defaults {
        let weights = [("reach", 1.0), ("bonus", 4.0), ("penalty", 50.0)];
        self.muscles.defaults(&["qpos", "qvel", "tip_pos", "reach_err"], &weights)
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        self.tips.draw_targets(episode.scene, episode.rng)
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.tips.observe(view, rows);
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let approach = self.tips.approach(view, rows);
        terms.set("reach", "m", [-approach.distance]);
        terms.set("bonus", "", [approach.bonus]);
        terms.set("act_reg", "", [-effort(rows)]);
        terms.set("penalty", "", [-f64::from(approach.verdict.done)]);
        approach.verdict
    }

    fn rewards_paths(&self) -> bool {
        false
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        self.muscles.keep(keeper);
    }
}
