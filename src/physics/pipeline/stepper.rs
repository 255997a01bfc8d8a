//! The interface to engines, which advance a [`Data`] by one time step: this crate's own pipeline, or another one.
//!
//! With any engine, a `Data` has the same contents after a step as after [`step`]: the new state, and poses, forces and sensor
//! readings of the state from which the step began. So kinematics, sensors, pictures, robots and tasks do not depend on the
//! engine. Rows of contacts that another engine solved are an exception: they have a force, and no Jacobian
//! ([`push_applied`](crate::constraint::push_applied)).
//!
//! ```
//! use robohive_physics::{Data, Engine, step};
//!
//! let text = "<mujoco><worldbody><body><joint axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let mut mover = Engine::default().start(&model)?;
//! let (mut data, mut same) = (Data::new(&model), Data::new(&model));
//! for _ in 0..10 {
//!     mover.step(&model, &mut data)?;
//!     step(&model, &mut same)?;
//! }
//! assert_eq!(data.state.qpos, same.state.qpos);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::data::{Data, ForeignSnapshot};
use crate::model::{Model, NotSimulated};
use crate::pipeline::error::StepError;
use crate::pipeline::step::step;
use std::any::Any;
use std::fmt;
use std::sync::Arc;

/// An engine that replaces this crate's pipeline. It belongs to one model and one `Data`.
///
/// A stepper reads the state from the `Data` at every step, so a program may write it; its other state, such
/// as impulses for warm starts, is its [`Memory`].
pub trait Stepper: fmt::Debug + Send + Sync {
    /// Drops all state of earlier steps: the next step depends only on the `Data`.
    fn reset(&mut self);

    /// Advances by one time step, as [`step`] does.
    ///
    /// # Errors
    /// As for `step`, or `m` was changed to a model that this engine does not simulate. The `Data` keeps the state for
    /// inspection.
    fn step(&mut self, m: &Model, d: &mut Data) -> Result<(), StepError>;

    /// The state that the next step depends on besides the `Data`.
    fn save(&self) -> Memory;

    /// Restores the state that [`Stepper::save`] returned.
    ///
    /// # Errors
    /// The memory is of another engine or model; the stepper stays as it was.
    fn restore(&mut self, memory: &Memory) -> Result<(), ForeignSnapshot>;

    /// The same engine in the same state.
    fn duplicate(&self) -> Box<dyn Stepper>;
}

/// State that a stepper keeps between steps besides the `Data`. Belongs to the [`Snapshot`](crate::Snapshot) of the same time.
#[derive(Clone, Default)]
pub struct Memory(Option<Arc<dyn Any + Send + Sync>>);

impl Memory {
    /// Wraps the state of an engine.
    pub fn of(kept: impl Any + Send + Sync) -> Self {
        Memory(Some(Arc::new(kept)))
    }

    /// The wrapped state, if it has the type `T`.
    pub fn get<T: Any>(&self) -> Option<&T> {
        self.0.as_ref()?.downcast_ref()
    }
}

impl fmt::Debug for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "Memory(kept)" } else { "Memory(nothing)" })
    }
}

type Make = dyn Fn(&Model) -> Result<Box<dyn Stepper>, NotSimulated> + Send + Sync;

/// The choice of an engine: by default this crate's pipeline.
#[derive(Clone, Default)]
pub struct Engine(Option<(&'static str, Arc<Make>)>);

impl Engine {
    /// Name of this crate's pipeline.
    pub const OWN: &'static str = "own";

    /// Another engine; `make` prepares a model for it, or returns the first element that it does not simulate.
    pub fn new(
        name: &'static str,
        make: impl Fn(&Model) -> Result<Box<dyn Stepper>, NotSimulated> + Send + Sync + 'static,
    ) -> Self {
        Engine(Some((name, Arc::new(make))))
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        self.0.as_ref().map_or(Self::OWN, |(name, _)| name)
    }

    /// Prepares a model.
    ///
    /// # Errors
    /// The first element of the model that the engine does not simulate.
    pub fn start(&self, m: &Model) -> Result<Mover, NotSimulated> {
        Ok(Mover(self.0.as_ref().map(|(_, make)| make(m)).transpose()?))
    }
}

impl fmt::Debug for Engine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Engine({})", self.name())
    }
}

/// An engine for one `Data`. This crate's pipeline has no state of its own and is called directly.
#[derive(Debug, Default)]
pub struct Mover(Option<Box<dyn Stepper>>);

impl Mover {
    /// The stepper; `None` for this crate's pipeline.
    pub fn foreign(&mut self) -> Option<&mut dyn Stepper> {
        match &mut self.0 {
            Some(stepper) => Some(&mut **stepper),
            None => None,
        }
    }

    /// Advances by one time step.
    ///
    /// # Errors
    /// As [`step`] and [`Stepper::step`].
    pub fn step(&mut self, m: &Model, d: &mut Data) -> Result<(), StepError> {
        match &mut self.0 {
            None => step(m, d),
            Some(stepper) => stepper.step(m, d),
        }
    }

    /// Drops all state of earlier steps.
    pub fn reset(&mut self) {
        if let Some(stepper) = &mut self.0 {
            stepper.reset();
        }
    }

    /// The state that the next step depends on besides the `Data`.
    pub fn save(&self) -> Memory {
        self.0.as_ref().map_or_else(Memory::default, |stepper| stepper.save())
    }

    /// Restores the state that [`Mover::save`] returned.
    ///
    /// # Errors
    /// The memory is of another engine or model.
    pub fn restore(&mut self, memory: &Memory) -> Result<(), ForeignSnapshot> {
        match (&mut self.0, &memory.0) {
            (None, None) => Ok(()),
            (Some(stepper), Some(_)) => stepper.restore(memory),
            _ => Err(ForeignSnapshot),
        }
    }
}

impl Clone for Mover {
    fn clone(&self) -> Self {
        Mover(self.0.as_ref().map(|stepper| stepper.duplicate()))
    }
}
