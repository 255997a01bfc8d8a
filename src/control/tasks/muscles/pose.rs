//! A limb that is to take a pose.

use super::limb::Limb;
use crate::controller::Controller;
use crate::error::ControlError;
use env::Env;

pub struct MusclePose {
    limb: Limb,
}

impl MusclePose {
    /// The controller.
    ///
    /// # Errors
    /// A body that is no limb; an observation without what each joint lacks.
    pub fn new(env: &Env) -> Result<Self, ControlError> {
        match env.rows().get("pose_err") {
            Some(errors) if errors.len() == env.scene().model.nv => Ok(MusclePose { limb: Limb::new(env)? }),
            _ => Err(ControlError::unfit(env, "what each joint lacks is needed, the row pose_err")),
        }
    }
}

impl Controller for MusclePose {
    fn reset(&mut self, _: &Env, _: u64) -> Result<(), ControlError> {
        self.limb.restart();
        Ok(())
    }

    fn act(&mut self, env: &Env, action: &mut [f64]) -> Result<(), ControlError> {
        self.limb.act(env, &env.rows()["pose_err"], action)
    }
}
