//! What can be wrong with a robot.

use crate::device::Fault;
use crate::options::ActionMode;
use std::fmt;

/// Kind of an entry of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// A sensor.
    Sensor,
    /// An actuator.
    Actuator,
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Part::Sensor => "sensor",
            Part::Actuator => "actuator",
        })
    }
}

/// Why a robot cannot be made or does not act.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RobotError {
    /// A name of the config that the model does not have.
    UnknownName {
        /// Device.
        device: String,
        /// Sensor or actuator.
        part: Part,
        /// The first such name.
        name: String,
        /// The nearest name of the model.
        nearest: Option<String>,
        /// How many names of the config the model does not have.
        missing: usize,
        /// How many names the config has.
        total: usize,
    },
    /// A sensor or actuator of the model that a robot cannot use.
    Unsupported {
        /// Device.
        device: String,
        /// Sensor or actuator.
        part: Part,
        /// Its name.
        name: String,
        /// What it is, and what it should be.
        reason: String,
    },
    /// An action mode for which the config or the model does not say enough.
    Mode {
        /// The mode.
        mode: ActionMode,
        /// What is missing.
        reason: String,
    },
    /// An option that makes no sense.
    Option {
        /// Its name.
        name: &'static str,
        /// What it should be.
        reason: String,
    },
    /// Not one number for each actuator, sensor or entry.
    Length {
        /// Of what.
        what: &'static str,
        /// Numbers given.
        given: usize,
        /// Numbers expected.
        expected: usize,
    },
    /// An action that is no finite number.
    BadAction {
        /// Which number, from 0.
        index: usize,
        /// Its actuator.
        actuator: String,
        /// Its value.
        value: f64,
    },
    /// A control period that is no positive number \[s\].
    BadDuration(f64),
    /// A vector to be moved from a space into the same one.
    SameSpace,
    /// A `hdr_id` that is no place in a vector, for [`Compat::RoboHive07`](crate::Compat::RoboHive07).
    HardwareIndex {
        /// The entry.
        name: String,
        /// Length of the vector.
        length: usize,
    },
    /// Hardware was asked for, and nothing drives an interface.
    Interface {
        /// Device.
        device: String,
        /// Its interface; `None` where the config names none.
        kind: Option<String>,
        /// Interfaces that there are drivers for.
        known: Vec<String>,
        /// The nearest of them.
        nearest: Option<String>,
    },
    /// A device failed.
    Device {
        /// Device.
        device: String,
        /// How.
        fault: Fault,
    },
}

impl fmt::Display for RobotError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RobotError::UnknownName { device, part, name, nearest, missing, total } => {
                write!(f, "device '{device}': the model has no {part} '{name}'")?;
                if let Some(nearest) = nearest {
                    write!(f, "; did you mean '{nearest}'?")?;
                }
                if *missing > 1 {
                    write!(f, " ({missing} of the config's {total} names are not in the model")?;
                    f.write_str(if missing == total { ": a config of another robot?)" } else { ")" })?;
                }
                Ok(())
            }
            RobotError::Unsupported { device, part, name, reason } => {
                write!(f, "device '{device}': {part} '{name}' {reason}")
            }
            RobotError::Mode { mode, reason } => write!(f, "actions in mode '{mode}': {reason}"),
            RobotError::Option { name, reason } => write!(f, "option `{name}`: {reason}"),
            RobotError::Length { what, given, expected } => {
                write!(f, "{given} numbers where {what} has {expected}")
            }
            RobotError::BadAction { index, actuator, value } => {
                write!(f, "action {index}, of actuator '{actuator}', is {value}; it must be finite")
            }
            RobotError::BadDuration(duration) => {
                write!(f, "a control period of {duration} s; it must be positive and finite")
            }
            RobotError::SameSpace => {
                f.write_str("a vector is remapped between two spaces, both given are one")
            }
            RobotError::HardwareIndex { name, length } => {
                write!(f, "the hdr_id of '{name}' is no place in a vector of {length} numbers")
            }
            RobotError::Interface { device, kind, known, nearest } => {
                match kind {
                    Some(kind) => {
                        write!(f, "device '{device}': nothing drives an interface of type '{kind}'")?
                    }
                    None => write!(f, "device '{device}': its config names no type of interface")?,
                }
                match nearest {
                    Some(nearest) => write!(f, "; did you mean '{nearest}'?"),
                    None if known.is_empty() => f.write_str("; no driver is registered"),
                    None => write!(f, "; there are drivers of {}", known.join(", ")),
                }
            }
            RobotError::Device { device, fault } => write!(f, "device '{device}': {fault}"),
        }
    }
}

impl std::error::Error for RobotError {}
