//! Opening a door: the hand turns the latch and pulls.

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

/// Where the frame of the door may stand \[m\].
const PLACES: Ranges = Ranges { low: [-0.3, 0.25, 0.252], high: [-0.2, 0.35, 0.35] };
/// The angle \[rad\] to which the door is to be opened, as the original rounds it.
const WIDE_OPEN: f64 = 1.57;
/// The door is open beyond this angle \[rad\].
const OPEN: f64 = 1.35;
/// A hand farther than this from the handle \[m\] has given up.
const FAR: f64 = 1.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Args {}

#[derive(Clone)]
pub struct Door {
    palm: SiteId,
    handle: SiteId,
    frame: BodyId,
    /// Where the angle of the hinge stands among the positions.
    hinge: usize,
}

impl Door {
    /// The task with these settings.
    ///
    /// # Errors
    /// There is a setting, and the task has none; the model lacks the hand or the door.
    pub fn new(_: Args, setup: &mut Setup<'_>) -> Result<Self, EnvError> {
        let scene = &mut *setup.scene;
        set_stiffness(scene)?;
        let hinge = scene.joint("door_hinge")?;
        Ok(Door {
            palm: scene.site("S_grasp")?,
            handle: scene.site("S_handle")?,
            frame: scene.body("frame")?,
            hinge: scene.model.jnt_qposadr[hinge.index()] as usize,
        })
    }
}

impl Task for Door {
    fn defaults(&self) -> Defaults {
        let rows = ["hand_jnt", "latch_pos", "door_pos", "palm_pos", "handle_pos", "reach_err"];
        Defaults::new(&rows, &[("reach", 1.0), ("open", 1.0), ("bonus", 1.0)], 5)
    }

    fn initial_pose(&self, _: &Scene, pose: &mut Pose) -> Result<(), EnvError> {
        start_at_zero(pose);
        Ok(())
    }

    fn begin(&mut self, episode: &mut Episode<'_>) -> Result<(), EnvError> {
        let place = PLACES.draw(episode.rng)?;
        episode.scene.overwrite(|m| m.body_pos[self.frame.index()] = place)?;
        Ok(episode.scene.forward()?)
    }

    fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let (qpos, qvel) = (&view.data.state.qpos, &view.data.state.qvel);
        let door = qpos[self.hinge];
        let palm = *view.data.site(self.palm).xpos();
        let handle = *view.data.site(self.handle).xpos();
        // How far the arm is out is missing: the place of the door is drawn, and the palm's says more.
        rows.set("hand_jnt", "rad", &qpos[1..qpos.len() - 2]);
        rows.set("hand_vel", "m/s, rad/s", &qvel[..qvel.len() - 2]);
        rows.set("handle_pos", "m", handle);
        rows.set("palm_pos", "m", palm);
        rows.set("reach_err", "m", sub(palm, handle));
        rows.set("door_pos", "rad", [door]);
        rows.set("latch_pos", "rad", [qpos[qpos.len() - 1]]);
        rows.set("door_open", "", [if door > 1.0 { 1.0 } else { -1.0 }]);
    }

    fn reward(&self, _: &View<'_>, rows: &Rows, terms: &mut Rows) -> Verdict {
        judge(norm(&rows["reach_err"]), rows["door_pos"][0], terms)
    }
}

/// Rewards a door at an angle \[rad\] with the palm at a distance from its handle \[m\].
fn judge(distance: f64, door: f64, terms: &mut Rows) -> Verdict {
    let beyond = |angle: f64| f64::from(door > angle);
    terms.set("reach", "m", [-0.1 * distance]);
    terms.set("open", "rad²", [-0.1 * (door - WIDE_OPEN) * (door - WIDE_OPEN)]);
    terms.set("bonus", "", [2.0 * beyond(0.2) + 8.0 * beyond(1.0) + 10.0 * beyond(OPEN)]);
    Verdict { sparse: door, solved: door > OPEN, done: distance > FAR }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bonuses_add_up_until_the_door_is_open() {
        for (door, bonus, solved) in
            [(0.2, 0.0, false), (0.9, 2.0, false), (1.2, 10.0, false), (1.4, 20.0, true)]
        {
            let mut terms = Rows::default();
            let verdict = judge(0.5, door, &mut terms);
            assert_eq!((terms["bonus"][0], verdict.solved, verdict.done), (bonus, solved, false));
            assert_eq!(verdict.sparse, door);
        }
        let mut terms = Rows::default();
        assert!(judge(1.01, WIDE_OPEN, &mut terms).done);
        assert_eq!((terms["open"][0], terms["reach"][0]), (-0.0, -0.101));
    }
}
