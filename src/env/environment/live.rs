//! What differs where the robot is hardware.

use super::env::{Env, Past};
use crate::error::EnvError;

impl Env {
    /// Whether its robot is hardware: time is not ours to choose, and no state can be returned to.
    pub fn is_live(&self) -> bool {
        self.live.is_some()
    }

    /// Lets a control period pass on hardware without a step of the episode: the last command of the episode is repeated, so
    /// that the watchdogs of devices hear one, and the observation shows what the devices read now. Before the first command
    /// the devices rest where the reset left them. In simulation time stands still, and this does nothing.
    ///
    /// # Errors
    /// A device that fails, or refuses the command.
    pub fn hold(&mut self) -> Result<(), EnvError> {
        let dt = self.dt();
        let Some(live) = &mut self.live else { return Ok(()) };
        if live.commanded {
            self.robot.repeat(self.scene.data.state.time)?;
        } else if let Some(fault) = self.robot.fault() {
            return Err(fault.clone().into());
        }
        live.pacer.finish(dt);
        self.perceive(Past::Unknown)?;
        self.judge();
        self.gather();
        Ok(())
    }
}
