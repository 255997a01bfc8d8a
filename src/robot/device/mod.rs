//! What a robot talks to: one trait for simulated devices, recorded ones and hardware.

mod registry;
mod replay;
mod simulated;

pub use registry::Registry;
pub use replay::{Record, Replay};
pub use simulated::Simulated;

use std::fmt;

/// Why a device did not do what it was asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fault {
    /// It was not connected, or was closed.
    NotConnected,
    /// It cannot be reached.
    Unreachable(String),
    /// It did not answer in time; the newest reading is this old \[ms\].
    Stale(u64),
    /// It gave another number of values than the config says.
    Length {
        /// Values given.
        given: usize,
        /// Values expected.
        expected: usize,
    },
    /// A value that is no finite number, by its place among the device's values.
    BadValue(usize),
    /// A recorded device has nothing more to say.
    Exhausted,
    /// It refused a command, or does not support its config.
    Refused(String),
    /// Its hardware reports an error: an overload, a reflex, a pressed stop button.
    Hardware(String),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::NotConnected => f.write_str("it is not connected"),
            Fault::Unreachable(why) => write!(f, "it cannot be reached: {why}"),
            Fault::Stale(age) => write!(f, "its newest reading is {age} ms old"),
            Fault::Length { given, expected } => write!(f, "it gave {given} values instead of {expected}"),
            Fault::BadValue(index) => write!(f, "its value {index} is no finite number"),
            Fault::Exhausted => f.write_str("its record has ended"),
            Fault::Refused(why) => write!(f, "it refused: {why}"),
            Fault::Hardware(what) => write!(f, "it reports: {what}"),
        }
    }
}

impl std::error::Error for Fault {}

impl Fault {
    /// The kind of fault, for programs: `connection`, `silence`, `values`, `end`, `refusal` or `hardware`.
    pub fn kind(&self) -> &'static str {
        match self {
            Fault::NotConnected | Fault::Unreachable(_) => "connection",
            Fault::Stale(_) => "silence",
            Fault::Length { .. } | Fault::BadValue(_) => "values",
            Fault::Exhausted => "end",
            Fault::Refused(_) => "refusal",
            Fault::Hardware(_) => "hardware",
        }
    }
}

/// Units that a device's numbers have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Units {
    /// The hardware's own, which the config's `scale` and `offset` convert.
    #[default]
    Hardware,
    /// The model's.
    Model,
}

/// A device: it has the sensors and actuators of one [`DeviceConfig`](crate::DeviceConfig), in the order of that config.
///
/// Calls return at once, but for [`Device::reset`]; a device that measures on its own gives its newest reading. Times are seconds since [`Device::connect`], of simulated devices the simulation's.
pub trait Device: Send {
    /// Opens the connection; the first call.
    ///
    /// # Errors
    /// Devices that cannot be reached.
    fn connect(&mut self) -> Result<(), Fault>;

    /// Writes the newest value of every sensor; returns when they were measured \[s\].
    ///
    /// # Errors
    /// Devices that do not answer.
    fn read(&mut self, values: &mut [f64]) -> Result<f64, Fault>;

    /// Sends a command to every actuator, to be held until the next.
    ///
    /// # Errors
    /// Devices that do not answer or refuse.
    fn apply(&mut self, time: f64, commands: &[f64]) -> Result<(), Fault>;

    /// Moves the actuators to where an episode begins, and returns when they are there.
    ///
    /// # Errors
    /// Devices that do not answer or refuse.
    fn reset(&mut self, targets: &[f64]) -> Result<(), Fault>;

    /// The measured object was moved by hand: returns when there is a new measurement. Devices that accept every reading
    /// do nothing.
    ///
    /// # Errors
    /// Devices that do not answer.
    fn moved(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    /// Ends the connection; the actuators are left safe.
    ///
    /// # Errors
    /// Devices that do not answer.
    fn close(&mut self) -> Result<(), Fault>;

    /// Units of readings and commands.
    fn units(&self) -> Units {
        Units::Hardware
    }

    /// What the simulation's sensors say \[model units\]; only simulated devices listen.
    fn observe_simulation(&mut self, _time: f64, _values: &[f64]) {}
}
