//! Standing: from a bent posture, the pelvis is to come to its place and stay there.

use super::terrain;
use crate::draws::Rng;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::suite::muscle::{Condition, Muscles, effort};
use crate::suite::myobase::tips::Tips;
use crate::suite::named::Named;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Turn, Verdict, View};
use physics::Model;
use physics::model::JointType;
use robot::{Compat, Keeper};
use serde::Deserialize;

/// Distance \[m\] of a site within which it has arrived.
const NEAR: f64 = 0.05;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {
    target_reach_range: Named<[[f64; 3]; 2]>,
    #[serde(default)]
    joint_random_range: [f64; 2],
    #[serde(default = "far_th")]
    far_th: f64,
    #[serde(default)]
    muscle_condition: Condition,
}

fn far_th() -> f64 {
    0.35
}

#[derive(Clone)]
pub struct LegStand {
    muscles: Muscles,
    tips: Tips,
    /// How far \[rad\] joints start from the initial pose.
    bend: [f64; 2],
    compat: Compat,
    /// Offsets drawn for every joint position (nq).
    offsets: Vec<f64>,
}

impl LegStand {
    /// The task with these settings.
    ///
    /// # Errors
    /// Settings do not fit, or elements are missing.
    pub fn new(args: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let muscles = Muscles::new(args.muscle_condition, setup)?;
        terrain::remove(setup.scene)?;
        let tips = Tips::new(setup.scene, &args.target_reach_range, NEAR, args.far_th)?;
        let offsets = vec![0.0; setup.scene.model.nq];
        Ok(LegStand { muscles, tips, bend: args.joint_random_range, compat: setup.compat, offsets })
    }

    /// Bends the joints of a pose within their ranges.
    fn bend(&mut self, model: &Model, qpos: &mut [f64], rng: &mut Rng) -> Result<(), EnvError> {
        rng.fill_uniform(self.bend[0], self.bend[1], &mut self.offsets)?;
        for joint in 0..model.njnt {
            let kind = model.jnt_type[joint];
            let turns = kind == JointType::Hinge as i32 || kind == JointType::Slide as i32;
            // The original takes the first coordinate of the pelvis for a joint with the range zero.
            if turns || self.compat == Compat::RoboHive07 {
                let place = model.jnt_qposadr[joint] as usize;
                let [low, high] = model.jnt_range[joint];
                qpos[place] = (qpos[place] + self.offsets[place]).max(low).min(high);
            }
        }
        Ok(())
    }
}

impl Task for LegStand {
    fn defaults(&self) -> Defaults {
        let weights = [("reach", 1.0), ("bonus", 4.0), ("penalty", 50.0), ("act_reg", 1.0)];
        self.muscles.defaults(&["qpos", "qvel", "tip_pos", "reach_err"], &weights)
    }

    fn initial_pose(&self, scene: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        terrain::key_pose(&scene.model, 0, pose)
    }

    fn reset(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        self.muscles.rest(episode.scene)?;
        let random = self.bend[0] < self.bend[1];
        if random {
            let mut qpos = episode.initial.qpos.clone();
            self.bend(&episode.scene.model, &mut qpos, episode.rng)?;
            episode.scene.data.state.qpos.copy_from_slice(&qpos);
        }
        episode.scene.forward()?;
        self.tips.draw_targets_nearby(episode.scene, episode.rng)?;
        if random {
            self.bend(&episode.scene.model, &mut episode.start.qpos, episode.rng)?;
        }
        Ok(())
    }

    fn act(&mut self, turn: &mut Turn<'_>) -> Result<(), EnvError> {
        self.muscles.drive(turn)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        self.tips.observe(view, rows);
    }

    fn reward(&self, view: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let approach = self.tips.approach(view, rows);
        let motion = norm(&rows["qvel"]);
        terms.set("reach", "", [10.0 - approach.distance - 10.0 * motion]);
        terms.set("bonus", "", [approach.bonus]);
        terms.set("act_reg", "", [-100.0 * effort(rows)]);
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
