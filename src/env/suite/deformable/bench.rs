//! The arm at its bench, by its roles: how an episode starts, and what all tasks observe of it.

use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Pose, Setup, View};
use physics::elements::SiteId;
use physics::math::Vec3;
use serde::Deserialize;

/// Settings that every task has.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arm {
    /// The file with the roles of the arm.
    roles: String,
    /// The pose of these roles in which episodes start.
    pose: String,
}

/// An arm whose actuators servo joints.
#[derive(Clone)]
pub struct Bench {
    start: Vec<f64>,
    /// Where `qpos` and `qvel` have each actuated joint.
    places: Vec<[usize; 2]>,
    tip: SiteId,
}

impl Bench {
    /// Finds the arm for the task called `task`.
    ///
    /// # Errors
    /// The roles cannot be read, or the model does not fill them.
    pub fn new(arm: &Arm, task: &str, setup: &Setup<'_>) -> Result<Self, EnvError> {
        let (roles, m) = (setup.roles(&arm.roles)?, &setup.scene.model);
        let cast = roles.cast(m, "", task);
        let mut start = m.qpos0.to_vec();
        cast.pose(&arm.pose, &mut start)?;
        let place = |k: usize| -> Result<[usize; 2], EnvError> {
            let joint = m.actuator_trnid[k][0] as usize;
            let mut known = m.joints().filter(|id| id.index() == joint).map(|id| m.joint(id));
            let view = known.next().ok_or_else(|| setup.wrong(format!("actuator {k} moves no joint")))?;
            Ok([view.qpos_range().start, view.dof_range().start])
        };
        let places = (0..m.nu).map(place).collect::<Result<_, _>>()?;
        Ok(Bench { start, places, tip: cast.tool()? })
    }

    /// The pose in which episodes start.
    pub fn initial_pose(&self, pose: &mut Pose) {
        pose.qpos.copy_from_slice(&self.start);
    }

    /// The place between the fingertips \[m\].
    pub fn tip(&self, view: &View<'_>) -> Vec3 {
        *view.data.site(self.tip).xpos()
    }

    /// Writes the rows of the arm.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        rows.set("arm_pos", "rad, m", self.places.iter().map(|place| state.qpos[place[0]]));
        rows.set("arm_vel", "rad/s, m/s", self.places.iter().map(|place| state.qvel[place[1]]));
        rows.set("tip", "m", self.tip(view));
    }
}
