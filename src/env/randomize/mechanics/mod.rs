//! Domain randomisation of physics: masses, friction, joints, actuators, delays, gravity, sizes and places that differ from
//! episode to episode.
//!
//! A draw is written by an edit of the model ([`physics::Model::edit`]), so that all derived quantities are those of a model
//! compiled with the new numbers. What belongs to the state, where free bodies start, is written into the pose that a reset
//! begins with.

mod choice;
mod config;
mod given;
mod place;
mod size;
mod target;

pub use config::{
    ActuatorRange, FrictionRange, JointRange, Keeps, LayoutRange, MassRange, PhysicsRandomization,
    SensorRange, SizeRange,
};

pub(crate) use given::Given;

use super::drawn::Drawn;
use crate::error::EnvError;
use crate::scene::Scene;
use physics::Model;
use target::Quantity;

/// What changes in the physics of an environment, and how it is now.
pub(crate) type Mechanics = Drawn<Quantity>;

impl Mechanics {
    /// Finds what a configuration names.
    ///
    /// # Errors
    /// A name or range that is wrong.
    pub(crate) fn new(config: &PhysicsRandomization, model: &Model, seed: u64) -> Result<Self, String> {
        Ok(Drawn::of(choice::dials(config, model)?, model, seed))
    }

    /// Draws what an episode of the environment `id` has, which the task lets start at the positions `start`.
    ///
    /// # Errors
    /// No place is far enough from others; the model refuses what was drawn.
    pub(crate) fn begin(&mut self, id: &str, scene: &mut Scene, start: &mut [f64]) -> Result<(), EnvError> {
        // With what the task drew itself.
        (*self.base).clone_from(&scene.model);
        self.draw(id, scene)?;
        for body in self.dials.iter().filter_map(|dial| dial.target.grown(&self.base)) {
            let deeper = body.depth(&scene.model, start) - body.depth(&self.base, start);
            body.raise(deeper, start);
        }
        self.turned().for_each(|(target, values)| target.place(values, &scene.model, start));
        Ok(())
    }

    /// Age of the robot's readings that was drawn \[time steps\].
    pub(crate) fn reading_age(&self) -> Option<usize> {
        self.turned().find(|(target, _)| **target == Quantity::Readings).map(|(_, values)| values[0] as usize)
    }
}

impl PhysicsRandomization {
    /// The greatest age of the robot's readings \[time steps\].
    pub(crate) fn oldest_reading(&self) -> usize {
        self.readings.map_or(0, |ages| ages.high[0].clamp(0.0, choice::OLDEST as f64) as usize)
    }
}
