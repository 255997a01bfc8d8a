//! Turning a pen in the hand until it points where another one does.

use super::adroit::{set_stiffness, start_at_zero};
use crate::error::EnvError;
use crate::rotation::{cosine, norm, quat_of_euler};
use crate::rows::Rows;
use crate::scene::Scene;
use crate::task::{Defaults, Episode, Pose, Setup, Task, Verdict, View};
use physics::elements::{BodyId, SiteId};
use physics::math::{distance, sub};
use serde::Deserialize;

/// The tilt of the target about x and about y is drawn from this range \[rad\].
const TILTS: [f64; 2] = [-1.0, 1.0];
/// A pen whose centre is below this height \[m\] has fallen.
const FALLEN: f64 = 0.075;
/// A pen closer than this to its place \[m\] is held.
const HELD: f64 = 0.075;
/// The pen points as the target does when the cosine of the angle between them is above this.
const ALIGNED: f64 = 0.95;
/// Positions of the pen, behind the hand's.
const PEN: usize = 6;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {}

/// A pen by its ends.
#[derive(Clone)]
struct Ends {
    top: SiteId,
    bottom: SiteId,
    /// Their distance \[m\].
    length: f64,
}

#[derive(Clone)]
pub struct Pen {
    pen: BodyId,
    place: SiteId,
    target: BodyId,
    pen_ends: Ends,
    target_ends: Ends,
}

impl Pen {
    /// The task with these settings.
    ///
    /// # Errors
    /// A setting is given, but the task has none; or the model lacks the hand or the pens.
    pub fn new(_: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let scene = &mut *setup.scene;
        set_stiffness(scene)?;
        Ok(Pen {
            pen: scene.body("Object")?,
            place: scene.site("eps_ball")?,
            target: scene.body("target")?,
            pen_ends: Ends::find(scene, "object_top", "object_bottom")?,
            target_ends: Ends::find(scene, "target_top", "target_bottom")?,
        })
    }
}

impl Ends {
    fn find(scene: &Scene, top: &str, bottom: &str) -> Result<Self, EnvError> {
        let (top, bottom) = (scene.site(top)?, scene.site(bottom)?);
        let places = &scene.model.site_pos;
        Ok(Ends { top, bottom, length: distance(places[top.index()], places[bottom.index()]) })
    }

    /// The direction from bottom to top, of length one.
    fn direction(&self, view: &View<'_>) -> [f64; 3] {
        let place = |site| *view.data.site(site).xpos();
        sub(place(self.top), place(self.bottom)).map(|component| component / self.length)
    }
}

impl Task for Pen {
    fn defaults(&self) -> Defaults {
        let rows = ["hand_jnt", "obj_pos", "obj_vel", "obj_rot", "obj_des_rot", "obj_err_pos", "obj_err_rot"];
        let weights = ["pos_align", "rot_align", "drop", "bonus"].map(|term| (term, 1.0));
        Defaults::new(&rows, &weights, 5)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        start_at_zero(pose);
        Ok(())
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let mut tilt = [0.0; 2];
        episode.rng.fill_uniform(TILTS[0], TILTS[1], &mut tilt)?;
        let target = quat_of_euler([tilt[0], tilt[1], 0.0]);
        episode.scene.overwrite(|m| m.body_quat[self.target.index()] = target)?;
        Ok(episode.scene.forward()?)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (qpos, qvel) = (&view.data.state.qpos, &view.data.state.qvel);
        let pen = *view.data.body(self.pen).xpos();
        let place = *view.data.site(self.place).xpos();
        let direction = self.pen_ends.direction(view);
        let wanted = self.target_ends.direction(view);
        rows.set("hand_jnt", "rad", &qpos[..qpos.len() - PEN]);
        rows.set("obj_pos", "m", pen);
        rows.set("obj_des_pos", "m", place);
        rows.set("obj_vel", "m/s, rad/s", &qvel[qvel.len() - PEN..]);
        rows.set("obj_rot", "", direction);
        rows.set("obj_des_rot", "", wanted);
        rows.set("obj_err_pos", "m", sub(pen, place));
        rows.set("obj_err_rot", "", sub(direction, wanted));
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        let away = norm(&rows["obj_err_pos"]);
        judge(away, cosine(&rows["obj_rot"], &rows["obj_des_rot"]), rows["obj_pos"][2], terms)
    }
}

/// Rewards a pen that is `away` from its place \[m\], at an angle of this cosine to the target, at a height \[m\].
fn judge(away: f64, cosine: f64, height: f64, terms: &mut Rows) -> Verdict {
    let fallen = height < FALLEN;
    let beyond = |least: f64| f64::from(cosine > least && away < HELD);
    terms.set("pos_align", "m", [-away]);
    terms.set("rot_align", "", [cosine]);
    terms.set("drop", "", [-5.0 * f64::from(fallen)]);
    terms.set("bonus", "", [10.0 * beyond(0.9) + 50.0 * beyond(ALIGNED)]);
    Verdict { sparse: cosine - away, solved: cosine > ALIGNED && !fallen, done: fallen }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pen_must_be_held_and_aligned() {
        let judged = |away, cosine, height| {
            let mut terms = Rows::default();
            let verdict = judge(away, cosine, height, &mut terms);
            (terms["bonus"][0], terms["drop"][0], verdict.solved, verdict.done)
        };
        assert_eq!(judged(0.01, 0.92, 0.25), (10.0, 0.0, false, false));
        assert_eq!(judged(0.01, 0.96, 0.25), (60.0, 0.0, true, false));
        // Out of place there is no bonus, but pointing the right way counts as solved.
        assert_eq!(judged(0.1, 0.96, 0.25), (0.0, 0.0, true, false));
        assert_eq!(judged(0.2, 0.96, 0.05), (0.0, -5.0, false, true));
    }
}
