//! The look of an environment's scene, as it was drawn.

use super::env::Env;
use crate::error::EnvError;
use crate::randomize::Look;
use crate::rows::Rows;

impl Env {
    /// What the last reset drew of the look of the scene, a row for each thing that changes; `None` where nothing does. It
    /// has no rows before the first reset.
    ///
    /// The row of a texture holds the number of its pattern (colour, checker, gradient, noise), red, green and blue of both
    /// colours, the squares of a checker along a side, and the seed of a noise.
    pub fn look(&self) -> Option<&Rows> {
        self.look.as_ref().map(Look::drawn)
    }

    /// Gives the scene a look that was drawn before, by the same settings; the state stays.
    ///
    /// # Errors
    /// The look has other rows than this environment draws.
    pub fn set_look(&mut self, drawn: &Rows) -> Result<(), EnvError> {
        let Some(look) = &mut self.look else {
            let message = "this environment has no visual_randomization".into();
            return Err(EnvError::ForeignState { message });
        };
        look.show(drawn, &mut self.scene)?;
        self.scene.forward()?;
        self.observe_readings()?;
        self.eyes.close();
        Ok(())
    }
}
