//! What a robot is made of: devices, each with sensors, actuators and cameras, from a file.
//!
//! Two forms say the same. RoboHive's `.config` is a Python literal, read by a parser that evaluates no code; the form
//! of this crate is TOML, with the same keys:
//!
//! ```
//! use robohive_robot::Config;
//!
//! let literal = "{'arm': {'interface': {'type': 'dynamixel'},
//!   'sensor': [{'name': 'jp', 'range': (-1, 1), 'noise': 0.05, 'hdr_id': 10, 'scale': -1, 'offset': 3*np.pi/2}],
//!   'actuator': [{'name': 'jm', 'pos_range': (-1, 1), 'vel_range': (-2*np.pi/4, 2*np.pi/4), 'hdr_id': 10}]}}";
//! let config = Config::from_literal(literal, "arm.config")?;
//! assert_eq!(config.devices[0].sensors[0].offset, 3.0 * std::f64::consts::PI / 2.0);
//! assert_eq!(Config::from_toml(&config.to_toml(), "arm.toml")?, config);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | key | of | meaning | when missing |
//! |---|---|---|---|
//! | `name` | all | name in the model; of devices, name in messages; of a sensor also `name[k]`, a component of the pose (`framepos`, `framequat`) of a body with a free joint | error |
//! | `interface` | device | `type` names the driver of the hardware, the rest are its parameters | none |
//! | `sensor`, `actuator`, `cam` | device | lists | empty |
//! | `range` | sensor, camera | readings are clipped to it | error |
//! | `noise` | sensor, camera | largest uniform noise, or standard deviation of Gaussian noise | 0 |
//! | `pos_range`, `vel_range` | actuator | limits of the commanded position and of its rate \[rad or m, 1/s\] | error |
//! | `effort_range` | actuator | limits of the joint's force or torque \[N, N m\] | none |
//! | `mode` | actuator | operating mode of the motor, for the driver | none |
//! | `hdr_id` | sensor, actuator, camera | number or name on the hardware; a negative number: not there, its simulated value stays | place in the list |
//! | `scale`, `offset` | sensor, actuator, camera | hardware to model of sensors, model to hardware of actuators | 1, 0 |

mod devices;
mod error;
mod fields;
mod literal;
mod node;
mod roles;
mod schema;
mod text_literal;
mod toml_reader;
mod toml_writer;
mod value;

pub use devices::{ActuatorConfig, CameraConfig, Config, DeviceConfig, HardwareId, Interface, SensorConfig};
pub use error::ConfigError;
pub use roles::{Fallen, Named, NominalPose, Roles, Walk};
pub use value::Value;

use std::path::Path;

impl Config {
    /// Reads RoboHive's form, a Python literal: dictionaries, lists, tuples, texts, numbers, `True`, `False`, `None`, and
    /// `+ - * /` over numbers and `np.pi`. Nothing is evaluated beyond that. `file` names the text in errors.
    ///
    /// # Errors
    /// Texts that are no such literal or name no device, unknown, missing and repeated keys, values that are wrong: with
    /// line and column.
    pub fn from_literal(text: &str, file: &str) -> Result<Config, ConfigError> {
        let source = error::Source::new(text, file)?;
        let root = literal::parse(&source)?;
        schema::named_devices(&source, root)
    }

    /// Reads the TOML form. `file` names the text in errors.
    ///
    /// # Errors
    /// Texts that are no TOML or name no device, unknown, missing and repeated keys, values that are wrong: with line and
    /// column.
    pub fn from_toml(text: &str, file: &str) -> Result<Config, ConfigError> {
        let source = error::Source::new(text, file)?;
        let root = toml_reader::parse(&source)?;
        schema::listed_devices(&source, root)
    }

    /// Reads a file: `.toml` as TOML, every other as RoboHive's literal.
    ///
    /// # Errors
    /// Files that cannot be read or are no UTF-8, and what [`Config::from_literal`] and [`Config::from_toml`] refuse.
    pub fn read(path: impl AsRef<Path>) -> Result<Config, ConfigError> {
        let path = path.as_ref();
        let file = path.display().to_string();
        let unreadable = |message: String| ConfigError { file: file.clone(), position: None, message };
        let size = std::fs::metadata(path).map_err(|error| unreadable(error.to_string()))?.len();
        if size > error::MAX_TEXT as u64 {
            return Err(unreadable(error::too_long(size)));
        }
        let text = std::fs::read_to_string(path).map_err(|error| unreadable(error.to_string()))?;
        if path.extension().is_some_and(|extension| extension == "toml") {
            Config::from_toml(&text, &file)
        } else {
            Config::from_literal(&text, &file)
        }
    }

    /// The config as TOML, which [`Config::from_toml`] reads as an equal one if it has a device. Parameters that are `None`
    /// are left out, since TOML has no word for it.
    pub fn to_toml(&self) -> String {
        toml_writer::text(self)
    }
}
