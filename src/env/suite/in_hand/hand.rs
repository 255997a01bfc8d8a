//! A hand on its back, by its roles: how an episode starts, and what all tasks observe of it.

use crate::draws::Rng;
use crate::error::EnvError;
use crate::rows::Rows;
use crate::task::{Setup, View};
use physics::Model;
use physics::elements::BodyId;
use physics::math::{Quat, Vec3, add, ops};
use physics::model::JointType;
use std::ops::Range;

/// The hand.
#[derive(Clone)]
pub struct Hand {
    /// Its joints: their places in `qpos` and `qvel`.
    joints: Vec<[usize; 2]>,
    /// Largest difference of a joint from the cradle at the start \[rad\].
    joint_noise: f64,
    /// The hand in its cradle, all else as the model has it (nq).
    pub home: Vec<f64>,
    /// Where the underside of a thing lies \[m\].
    pub cradle: Vec3,
}

impl Hand {
    /// Finds the hand of the roles in the file `roles` for the task called `task`. `joint_noise` is the largest difference of a joint from the
    /// cradle at the start \[rad\].
    ///
    /// # Errors
    /// The roles cannot be read, or the model does not fill them; it lacks the site `cradle`.
    pub fn new(roles: &str, joint_noise: f64, task: &str, setup: &Setup<'_>) -> Result<Self, EnvError> {
        let (roles, scene) = (setup.roles(roles)?, &setup.scene);
        let m = &scene.model;
        let mut home = m.qpos0.to_vec();
        roles.cast(m, "", task).pose("cradle", &mut home)?;
        let hinges = (0..m.njnt).filter(|joint| m.jnt_type[*joint] == JointType::Hinge as i32);
        let joints = hinges.map(|j| [m.jnt_qposadr[j] as usize, m.jnt_dofadr[j] as usize]).collect();
        let cradle = *scene.data.site(scene.site("cradle")?).xpos();
        Ok(Hand { joints, joint_noise, home, cradle })
    }

    /// Has `home` put a body, whose free joint stands at `place` in `qpos`, as far from the cradle as it is from the origin in the scene.
    pub fn put(&mut self, m: &Model, body: BodyId, place: &Range<usize>) {
        let lies = add(self.cradle, m.body_pos[body.index()]);
        self.home[place.start..place.start + 3].copy_from_slice(&lies);
    }

    /// Has a body float at the site `show`, to show the goal.
    ///
    /// # Errors
    /// The scene lacks the body or the site.
    pub fn show(&self, name: &str, setup: &mut Setup<'_>) -> Result<BodyId, EnvError> {
        let (scene, body) = (&setup.scene, setup.scene.body(name)?);
        let place = *scene.data.site(scene.site("show")?).xpos();
        setup.scene.overwrite(|m| m.body_pos[body.index()] = place)?;
        Ok(body)
    }

    /// Draws how far each joint starts from the cradle.
    ///
    /// # Errors
    /// A noise that cannot be drawn from.
    pub fn shake(&self, rng: &mut Rng, qpos: &mut [f64]) -> Result<(), EnvError> {
        for [place, _] in &self.joints {
            qpos[*place] += self.joint_noise * rng.uniform(-1.0, 1.0)?;
        }
        Ok(())
    }

    /// Writes the rows of the hand: `joint_pos`, `joint_vel` and `last_action`, the controls of its servos.
    pub fn observe(&self, view: &View<'_>, rows: &mut Rows) {
        let state = &view.data.state;
        rows.set("joint_pos", "rad", self.joints.iter().map(|[place, _]| state.qpos[*place]));
        rows.set("joint_vel", "rad/s", self.joints.iter().map(|[_, dof]| state.qvel[*dof]));
        rows.set("last_action", "", state.ctrl.iter().copied());
    }
}

/// A turn about the vertical \[rad\].
pub fn about_z(angle: f64) -> Quat {
    let (sine, cosine) = ops::sincos(angle / 2.0);
    [cosine, 0.0, 0.0, sine]
}

/// Draws an angle of a range, to the one side or to the other \[rad\].
///
/// # Errors
/// A range that cannot be drawn from.
pub fn either_way(range: [f64; 2], rng: &mut Rng) -> Result<f64, EnvError> {
    let angle = rng.uniform(range[0], range[1])?;
    let sense = if rng.uniform(0.0, 1.0)? < 0.5 { -1.0 } else { 1.0 };
    Ok(sense * angle)
}
