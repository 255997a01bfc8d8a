//! What resets draw of the look and of the physics of an environment's scene.

use super::env::Env;
use crate::error::EnvError;
use crate::rows::Rows;

impl Env {
    /// What the last reset drew of the look of the scene, a row for each thing that changes; `None` where nothing does. It
    /// has no rows before the first reset.
    ///
    /// The row of a texture holds the number of its pattern (colour, checker, gradient, noise), red, green and blue of both
    /// colours, the squares of a checker along a side, and the seed of a noise.
    pub fn look(&self) -> Option<&Rows> {
        Some(self.randomized.look.as_ref()?.rows())
    }

    /// What the last reset drew of the physics of the scene, a row for each quantity that changes (`body/NAME/mass`,
    /// `joint/NAME/damping`, `option/gravity` …); `None` where nothing does. It has no rows before the first reset.
    ///
    /// Rows of masses, friction, joints, gains and sizes hold factors, those of delays seconds, those of places metres and degrees.
    pub fn mechanics(&self) -> Option<&Rows> {
        Some(self.randomized.mechanics.as_ref()?.rows())
    }

    /// Gives the scene a look that was drawn before, by the same settings; the state stays.
    ///
    /// # Errors
    /// The look has other rows than this environment draws.
    pub fn set_look(&mut self, drawn: &Rows) -> Result<(), EnvError> {
        let Some(look) = &mut self.randomized.look else {
            let message = "this environment has no visual_randomization".into();
            return Err(EnvError::ForeignState { message });
        };
        look.show(drawn, &mut self.scene)?;
        self.see_drawn()
    }

    /// Gives the scene physics that was drawn before, by the same settings. The state stays, and with it where bodies with a free
    /// joint are.
    ///
    /// # Errors
    /// It has other rows than this environment draws.
    pub fn set_mechanics(&mut self, drawn: &Rows) -> Result<(), EnvError> {
        self.randomized.settle(&mut self.scene)?;
        let Some(mechanics) = &mut self.randomized.mechanics else {
            let message = "this environment has no physics_randomization".into();
            return Err(EnvError::ForeignState { message });
        };
        mechanics.show(drawn, &mut self.scene)?;
        if let Some(age) = mechanics.reading_age() {
            self.robot.set_delay_steps(age);
        }
        if let Some(look) = &self.randomized.look {
            // The edit of the physics has recomputed where cameras and lights are that follow a body, without what was drawn for them.
            look.write(&mut self.scene)?;
        }
        self.see_drawn()?;
        self.write_rows();
        self.judge();
        self.gather();
        Ok(())
    }

    /// Draws physics and look of the episode that begins.
    pub(super) fn randomize(&mut self) -> Result<(), EnvError> {
        self.randomized.draw(&self.spec.id, &mut self.scene, &mut self.start.qpos)?;
        if let Some(age) = self.randomized.reading_age() {
            self.robot.set_delay_steps(age);
        }
        Ok(())
    }

    fn see_drawn(&mut self) -> Result<(), EnvError> {
        self.scene.forward()?;
        self.observe_readings()?;
        self.eyes.close();
        Ok(())
    }
}
