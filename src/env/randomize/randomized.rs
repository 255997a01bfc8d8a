//! All that an environment draws of its scene: physics, then the look.

use super::drawn::DrawnState;
use super::mechanics::{Given, Mechanics};
use super::visual::Look;
use super::{PhysicsRandomization, VisualRandomization};
use crate::error::EnvError;
use crate::scene::Scene;
use physics::Model;
use robot::Keeper;

/// What changes in the scene of an environment from episode to episode, where anything does.
#[derive(Clone)]
pub(crate) struct Randomized {
    pub(crate) look: Option<Look>,
    pub(crate) mechanics: Option<Mechanics>,
    /// The model as it was made, and the statistics that its file gives, where physics changes.
    made: Option<Box<(Model, Given)>>,
}

/// What was drawn, and where the sequences of draws stand.
#[derive(Clone)]
pub(crate) struct RandomizedState {
    look: Option<DrawnState>,
    mechanics: Option<DrawnState>,
}

impl Randomized {
    /// Finds what the settings name in a model.
    ///
    /// # Errors
    /// A name or range that is wrong.
    pub(crate) fn new(
        visual: Option<&VisualRandomization>,
        physics: Option<&PhysicsRandomization>,
        model: &Model,
        seed: u64,
    ) -> Result<Self, String> {
        Ok(Randomized {
            look: visual.map(|config| Look::new(config, model, seed)).transpose()?,
            mechanics: physics.map(|config| Mechanics::new(config, model, seed)).transpose()?,
            made: match physics {
                Some(_) => {
                    Some(Box::new((model.clone(), Given::of(model).map_err(|error| error.to_string())?)))
                }
                None => None,
            },
        })
    }

    /// Restarts the draws.
    pub(crate) fn seed(&mut self, seed: u64) {
        self.look.iter_mut().for_each(|look| look.seed(seed));
        self.mechanics.iter_mut().for_each(|mechanics| mechanics.seed(seed));
    }

    /// Makes the model what it was, so that no episode depends on those before it: what is derived of a draw would keep their poses.
    pub(crate) fn undo(&self, scene: &mut Scene) {
        if let Some(made) = &self.made {
            scene.model = made.0.clone();
        }
    }

    /// Draws what an episode of the environment `id` has, which the task lets start at the positions `start`.
    ///
    /// # Errors
    /// There is no such draw; the model refuses it.
    pub(crate) fn draw(&mut self, id: &str, scene: &mut Scene, start: &mut [f64]) -> Result<(), EnvError> {
        self.settle(scene)?;
        if let Some(mechanics) = &mut self.mechanics {
            mechanics.begin(id, scene, start)?;
        }
        if let Some(look) = &mut self.look {
            look.draw(id, scene)?;
        }
        Ok(())
    }

    /// Lets statistics of the model follow from what a task wrote, before physics is drawn or shown.
    ///
    /// # Errors
    /// The model cannot be what its numbers say.
    pub(crate) fn settle(&self, scene: &mut Scene) -> Result<(), EnvError> {
        self.made.as_ref().map_or(Ok(()), |made| made.1.settle(scene))
    }

    /// Age of the robot's readings that was drawn \[time steps\].
    pub(crate) fn reading_age(&self) -> Option<usize> {
        self.mechanics.as_ref()?.reading_age()
    }

    /// Writes what was drawn and where the sequences of draws stand, or reads it; the model is kept elsewhere.
    pub(crate) fn keep(&mut self, keeper: &mut Keeper) {
        self.look.iter_mut().for_each(|look| look.keep(keeper));
        self.mechanics.iter_mut().for_each(|mechanics| mechanics.keep(keeper));
    }

    pub(crate) fn state(&self) -> RandomizedState {
        RandomizedState {
            look: self.look.as_ref().map(Look::state),
            mechanics: self.mechanics.as_ref().map(Mechanics::state),
        }
    }

    /// Takes over a state whose model has been taken over already.
    pub(crate) fn restore(&mut self, state: &RandomizedState) {
        if let (Some(look), Some(state)) = (&mut self.look, &state.look) {
            look.restore(state);
        }
        if let (Some(mechanics), Some(state)) = (&mut self.mechanics, &state.mechanics) {
            mechanics.restore(state);
        }
    }
}
