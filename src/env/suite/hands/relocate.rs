//! Carrying a ball from the table to a place in the air.

use super::adroit::{set_stiffness, start_at_zero};
use crate::draws::Ranges;
use crate::error::EnvError;
use crate::rotation::norm;
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};
use physics::elements::{BodyId, SiteId};
use physics::math::sub;
use serde::Deserialize;

/// Where on the table the ball may lie \[m\].
const BALLS: Ranges<2> = Ranges { low: [-0.15, -0.15], high: [0.15, 0.3] };
/// Where in the air the target may be \[m\].
const TARGETS: Ranges = Ranges { low: [-0.2, -0.2, 0.15], high: [0.2, 0.2, 0.35] };
/// A ball above this height \[m\] is lifted.
const LIFTED: f64 = 0.04;
/// A ball closer than this to the target \[m\] is there.
const ARRIVED: f64 = 0.1;
/// A hand farther than this from the ball \[m\] has given up.
const FAR: f64 = 0.7;
/// Positions of the ball, behind the hand's.
const BALL: usize = 6;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {}

#[derive(Clone)]
pub struct Relocate {
    palm: SiteId,
    ball: BodyId,
    target: SiteId,
}

impl Relocate {
    /// The task with these settings.
    ///
    /// # Errors
    /// There is a setting, and the task has none; the model lacks the hand, the ball or the target.
    pub fn new(_: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let scene = &mut *setup.scene;
        set_stiffness(scene)?;
        Ok(Relocate {
            palm: scene.site("S_grasp")?,
            ball: scene.body("Object")?,
            target: scene.site("target")?,
        })
    }
}

impl Task for Relocate {
    fn defaults(&self) -> Defaults {
        let rows = ["hand_jnt", "palm_obj_err", "palm_tar_err", "obj_tar_err", "obj_pos"];
        let weights = ["palm_obj", "palm_tar", "obj_tar", "bonus"].map(|term| (term, 1.0));
        Defaults::new(&rows, &weights, 5)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        start_at_zero(pose);
        Ok(())
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let ball = BALLS.draw(episode.rng)?;
        let target = TARGETS.draw(episode.rng)?;
        episode.scene.overwrite(|m| {
            m.body_pos[self.ball.index()][..2].copy_from_slice(&ball);
            m.site_pos[self.target.index()] = target;
        })?;
        Ok(episode.scene.forward()?)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let qpos = &view.data.state.qpos;
        let palm = *view.data.site(self.palm).xpos();
        let ball = *view.data.body(self.ball).xpos();
        let target = *view.data.site(self.target).xpos();
        rows.set("hand_jnt", "m, rad", &qpos[..qpos.len() - BALL]);
        rows.set("palm_obj_err", "m", sub(palm, ball));
        rows.set("palm_tar_err", "m", sub(palm, target));
        rows.set("obj_tar_err", "m", sub(ball, target));
        rows.set("obj_pos", "m", ball);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let distances = ["palm_obj_err", "palm_tar_err", "obj_tar_err"].map(|row| norm(&rows[row]));
        judge(distances, rows["obj_pos"][2], terms)
    }
}

/// Rewards the distances from palm to ball, palm to target and ball to target \[m\], with the ball at a height \[m\].
fn judge([reach, carry, gap]: [f64; 3], height: f64, terms: &mut Rows) -> Verdict {
    let lifted = f64::from(height > LIFTED);
    let near = |distance: f64| f64::from(gap < distance);
    terms.set("palm_obj", "m", [-0.1 * reach]);
    terms.set("palm_tar", "m", [-0.5 * carry * lifted]);
    terms.set("obj_tar", "m", [-0.5 * gap * lifted]);
    terms.set("bonus", "", [lifted + 10.0 * near(ARRIVED) + 20.0 * near(0.5 * ARRIVED)]);
    Verdict { sparse: -gap, solved: gap < ARRIVED, done: reach > FAR }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_to_the_target_counts_once_the_ball_is_lifted() {
        let judged = |distances, height| {
            let mut terms = Rows::default();
            let verdict = judge(distances, height, &mut terms);
            let carry = (terms["palm_tar"][0], terms["obj_tar"][0]);
            (carry, terms["bonus"][0], verdict.solved, verdict.done)
        };
        assert_eq!(judged([0.1, 0.4, 0.3], 0.03), ((-0.0, -0.0), 0.0, false, false));
        assert_eq!(judged([0.1, 0.4, 0.3], 0.05), ((-0.2, -0.15), 1.0, false, false));
        assert_eq!(judged([0.1, 0.0, 0.08], 0.2), ((-0.0, -0.04), 11.0, true, false));
        assert_eq!(judged([0.71, 0.0, 0.04], 0.2), ((-0.0, -0.02), 31.0, true, true));
    }
}
