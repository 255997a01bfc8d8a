//! Sessions that show what another program simulates.

use super::Session;
use physics::{Data, Model, StepError, forward};
use render::scene::Item;

impl Session {
    /// A session in a state: time goes by where it `runs`, else it follows another program, which has the time and all inputs.
    ///
    /// # Errors
    /// This state cannot be evaluated.
    pub fn in_state(model: Model, mut data: Data, runs: bool) -> Result<Self, StepError> {
        forward(&model, &mut data)?;
        let mut session = Session::at(model, data);
        session.follows = !runs;
        session.run(runs);
        Ok(session)
    }

    /// Whether another program has the time.
    pub fn is_following(&self) -> bool {
        self.follows
    }

    /// Takes over a state or changes of the model from the program that is followed, and evaluates what follows.
    ///
    /// # Errors
    /// Those of `write`.
    pub fn take_over<E>(
        &mut self,
        write: impl FnOnce(&mut Model, &mut Data) -> Result<(), E>,
    ) -> Result<(), E> {
        let written = write(&mut self.model, &mut self.data);
        self.settle();
        written
    }

    /// Items that a program adds to the scene.
    pub fn guests(&self) -> &[Item] {
        &self.guests
    }

    /// Adds items to the scene, in place of the former.
    pub fn set_guests(&mut self, guests: Vec<Item>) {
        self.guests = guests;
        self.revision += 1;
    }
}
