//! What advances a [`Data`] by one time step: this crate's own pipeline, or another engine behind the same two nouns.
//!
//! Whatever moved it, a `Data` holds after a step what it holds after [`step`]: the new state, and poses, forces and sensor
//! readings of the state that the step began from. So kinematics, sensors, pictures, robots and tasks read it without knowing
//! what moved it.
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

/// An engine that moves models in place of this crate's pipeline. It belongs to one model and one `Data`.
///
/// A stepper takes the state from the `Data` at every step, so that a program may write there; what it keeps beside that, such
/// as impulses that start the next solution, is its [`Memory`].
pub trait Stepper: fmt::Debug + Send + Sync {
    /// Forgets all that earlier steps left: the next step follows from the `Data` alone.
    fn reset(&mut self);

    /// Advances by one time step, as [`step`] does.
    ///
    /// # Errors
    /// As `step`, and where `m` has been changed into a model that this engine does not simulate. The `Data` keep the state for
    /// inspection.
    fn step(&mut self, m: &Model, d: &mut Data) -> Result<(), StepError>;

    /// What decides the next step beside the `Data`.
    fn save(&self) -> Memory;

    /// Returns to what [`Stepper::save`] gave.
    ///
    /// # Errors
    /// The memory is of another engine or model; the stepper stays as it was.
    fn restore(&mut self, memory: &Memory) -> Result<(), ForeignSnapshot>;

    /// The same engine in the same state.
    fn duplicate(&self) -> Box<dyn Stepper>;
}

/// What a stepper keeps from step to step beside the `Data`. Goes with the [`Snapshot`](crate::Snapshot) of the same moment.
#[derive(Clone, Default)]
pub struct Memory(Option<Arc<dyn Any + Send + Sync>>);

impl Memory {
    /// Wraps what an engine keeps.
    pub fn of(kept: impl Any + Send + Sync) -> Self {
        Memory(Some(Arc::new(kept)))
    }

    /// What was wrapped, if it is of type `T`.
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

    /// Another engine; `make` prepares a model for it, or says what it does not simulate.
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

/// An engine at work on one `Data`. This crate's pipeline keeps nothing and is called directly.
#[derive(Debug, Default)]
pub struct Mover(Option<Box<dyn Stepper>>);

impl Mover {
    /// The stepper, unless this crate's pipeline moves the data.
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

    /// Forgets all that earlier steps left.
    pub fn reset(&mut self) {
        if let Some(stepper) = &mut self.0 {
            stepper.reset();
        }
    }

    /// What decides the next step beside the `Data`.
    pub fn save(&self) -> Memory {
        self.0.as_ref().map_or_else(Memory::default, |stepper| stepper.save())
    }

    /// Returns to what [`Mover::save`] gave.
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
