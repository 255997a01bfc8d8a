//! What a config says of servos.

use crate::parameters::Parameters;
use crate::servos::{Quantity, Safe, all, id, range, sensors, unique};
use protocol::dynamixel::Mode;
use robot::{ActuatorConfig, DeviceConfig, Fault};

/// A servo that is commanded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motor {
    pub(super) id: u8,
    pub(super) mode: Mode,
    /// Commands that the config's range of positions gives, in the servo's units \[rad\].
    pub(super) range: [f64; 2],
}

/// Parameters of a bus, and what is on it.
#[derive(Clone, Debug)]
pub(super) struct Settings {
    pub(super) port: String,
    pub(super) baud: u32,
    pub(super) safe: Safe,
    /// \[rad/s\]; `None` for the servo's own limit.
    pub(super) profile_velocity: Option<f64>,
    /// \[rad/s²\].
    pub(super) profile_acceleration: f64,
    pub(super) watchdog: f64,
    pub(super) reset_time: f64,
    /// \[µs\].
    pub(super) return_delay: f64,
    pub(super) motors: Vec<Motor>,
    pub(super) sensors: Vec<(u8, Quantity)>,
}

fn refused(why: String) -> Fault {
    Fault::Refused(why)
}

impl Settings {
    /// Those of a device.
    ///
    /// # Errors
    /// What the config lacks or says wrongly.
    pub(super) fn new(config: &DeviceConfig) -> Result<Settings, Fault> {
        let mut parameters = Parameters::new(config);
        let port = parameters.text("name")?.ok_or_else(|| {
            refused("its interface has no 'name', the path of the serial port, as '/dev/ttyUSB0'".to_owned())
        })?;
        let safe = match parameters.text("safe")?.as_deref() {
            None | Some("hold") => Safe::Hold,
            Some("off") => Safe::Off,
            Some(other) => {
                return Err(refused(format!("its interface has safe = '{other}'; there are hold, off")));
            }
        };
        let velocity = parameters.number("profile_velocity", -1.0, [0.0, 100.0])?;
        let settings = Settings {
            port,
            safe,
            baud: parameters.number("baud", 1e6, [9600.0, 4.5e6])? as u32,
            profile_velocity: (velocity >= 0.0).then_some(velocity),
            profile_acceleration: parameters.number("profile_acceleration", 0.0, [0.0, 1e4])?,
            watchdog: parameters.number("watchdog", 0.25, [0.02, 10.0])?,
            reset_time: parameters.number("reset_time", 5.0, [0.1, 60.0])?,
            return_delay: parameters.number("return_delay", 0.0, [0.0, 508.0])?,
            motors: config.actuators.iter().map(motor).collect::<Result<_, _>>()?,
            sensors: sensors(&config.sensors)?,
        };
        parameters.skip(&["motor_type", "n"]);
        parameters.finish()?;
        unique(settings.motors.iter().map(|motor| motor.id))?;
        Ok(settings)
    }

    /// Ids of all servos, each once, in the order in which the config first names them.
    pub(super) fn ids(&self) -> Vec<u8> {
        all(self.motors.iter().map(|motor| motor.id), &self.sensors)
    }
}

fn motor(config: &ActuatorConfig) -> Result<Motor, Fault> {
    let mode = match config.mode.as_deref().map(str::to_ascii_lowercase).as_deref() {
        None | Some("position") => Mode::Position,
        Some("extended") => Mode::ExtendedPosition,
        Some("velocity") => Mode::Velocity,
        Some("current" | "torque") => Mode::Current,
        Some(other) => {
            return Err(refused(format!(
                "'{}' has mode '{other}'; there are position, extended, velocity, current",
                config.name
            )));
        }
    };
    Ok(Motor { id: id(config)?, mode, range: range(config) })
}
