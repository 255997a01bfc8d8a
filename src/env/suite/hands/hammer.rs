//! Driving a nail: the hand takes a hammer from the table and strikes.

use super::adroit::{set_stiffness, start_at_zero};
use crate::error::EnvError;
use crate::rotation::{euler_of_quat, norm};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};
use physics::elements::{BodyId, SensorId, SiteId};
use physics::math::sub;
use serde::Deserialize;

/// Lowest and highest place of the board \[m\].
const HEIGHTS: [f64; 2] = [0.1, 0.25];
/// A hammer above this height \[m\] is lifted.
const LIFTED: f64 = 0.04;
/// The nail is in when this close to where it is to go \[m\].
const DRIVEN: f64 = 0.01;
/// A hand farther than this from the hammer \[m\] has given up.
const FAR: f64 = 1.0;
/// Positions of the hammer, behind the hand's.
const HAMMER: usize = 6;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {}

#[derive(Clone)]
pub struct Hammer {
    palm: SiteId,
    hammer: BodyId,
    head: SiteId,
    nail: SiteId,
    goal: SiteId,
    board: BodyId,
    impact: SensorId,
}

impl Hammer {
    /// The task with these settings.
    ///
    /// # Errors
    /// There is a setting, and the task has none; the model lacks the hand, the hammer or the nail.
    pub fn new(_: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let scene = &mut *setup.scene;
        set_stiffness(scene)?;
        Ok(Hammer {
            palm: scene.site("S_grasp")?,
            hammer: scene.body("object")?,
            head: scene.site("tool")?,
            nail: scene.site("S_target")?,
            goal: scene.site("nail_goal")?,
            board: scene.body("nail_board")?,
            impact: scene.sensor("S_nail")?,
        })
    }
}

impl Task for Hammer {
    fn defaults(&self) -> Defaults {
        let rows = [
            "hand_jnt",
            "obj_vel",
            "palm_pos",
            "obj_pos",
            "obj_rot",
            "target_pos",
            "nail_impact",
            "tool_pos",
            "goal_pos",
            "hand_vel",
        ];
        let weights = ["palm_obj", "tool_target", "target_goal", "smooth", "bonus"].map(|term| (term, 1.0));
        Defaults::new(&rows, &weights, 5)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        start_at_zero(pose);
        Ok(())
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let height = episode.rng.uniform(HEIGHTS[0], HEIGHTS[1])?;
        episode.scene.overwrite(|m| m.body_pos[self.board.index()][2] = height)?;
        Ok(episode.scene.forward()?)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (qpos, qvel) = (&view.data.state.qpos, &view.data.state.qvel);
        let (hand_vel, hammer_vel) = qvel.split_at(qvel.len() - HAMMER);
        let bounded = |velocity: &f64| velocity.clamp(-1.0, 1.0);
        let site = |id: SiteId| *view.data.site(id).xpos();
        let hammer = view.data.body(self.hammer);
        rows.set("hand_jnt", "rad", &qpos[..qpos.len() - HAMMER]);
        rows.set("obj_vel", "m/s, rad/s", hammer_vel.iter().map(bounded));
        rows.set("palm_pos", "m", site(self.palm));
        rows.set("obj_pos", "m", hammer.xpos());
        rows.set("obj_rot", "rad", euler_of_quat(*hammer.xquat()));
        rows.set("target_pos", "m", site(self.nail));
        rows.set("nail_impact", "N", [bounded(&view.data.sensor(self.impact).data()[0])]);
        rows.set("tool_pos", "m", site(self.head));
        rows.set("goal_pos", "m", site(self.goal));
        rows.set("hand_vel", "rad/s", hand_vel.iter().map(bounded));
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let place = |row: &str| [rows[row][0], rows[row][1], rows[row][2]];
        let between = |a: &str, b: &str| norm(&sub(place(a), place(b)));
        let reach = between("palm_pos", "obj_pos");
        let nail = between("target_pos", "goal_pos");
        terms.set("palm_obj", "m", [-0.1 * reach]);
        terms.set("tool_target", "m", [-between("tool_pos", "target_pos")]);
        terms.set("target_goal", "m", [-10.0 * nail]);
        terms.set("smooth", "rad/s, m/s", [-0.01 * (norm(&rows["hand_vel"]) + norm(&rows["obj_vel"]))]);
        terms.set("bonus", "", [bonus(rows["obj_pos"][2], nail)]);
        Verdict { sparse: -nail, solved: nail < DRIVEN, done: reach > FAR }
    }

    fn resting_rows(&self) -> Vec<String> {
        vec!["nail_impact".into()]
    }
}

/// The bonus for a hammer at a height, and a nail that has a way to go \[m\].
fn bonus(height: f64, nail: f64) -> f64 {
    2.0 * f64::from(height > LIFTED) + 25.0 * f64::from(nail < 2.0 * DRIVEN) + 75.0 * f64::from(nail < DRIVEN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bonuses_add_up_until_the_nail_is_in() {
        assert_eq!(bonus(0.03, 0.1), 0.0);
        assert_eq!(bonus(0.05, 0.1), 2.0);
        assert_eq!(bonus(0.05, 0.015), 27.0);
        assert_eq!(bonus(0.03, 0.005), 100.0);
    }
}
