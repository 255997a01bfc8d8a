//! What a config says of servos.

use crate::parameters::Parameters;
use protocol::dynamixel::Mode;
use robot::{ActuatorConfig, DeviceConfig, Fault, HardwareId, SensorConfig};

/// What servos do when they are to be safe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Safe {
    /// They stay where they are, with torque.
    Hold,
    /// They have no torque.
    Off,
}

/// What a sensor reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Position,
    Velocity,
    Current,
}

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
        let mut ids: Vec<_> = settings.motors.iter().map(|motor| motor.id).collect();
        ids.sort_unstable();
        if let Some(twice) = ids.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(refused(format!("two of its actuators have the servo {}", twice[0])));
        }
        Ok(settings)
    }

    /// Ids of all servos, each once, in the order in which the config first names them.
    pub(super) fn ids(&self) -> Vec<u8> {
        let mut ids = Vec::new();
        let all = self.motors.iter().map(|motor| motor.id).chain(self.sensors.iter().map(|(id, _)| *id));
        for id in all {
            if !ids.contains(&id) {
                ids.push(id);
            }
        }
        ids
    }
}

fn id(name: &str, number: i64) -> Result<u8, Fault> {
    u8::try_from(number).ok().filter(|id| *id <= 252).ok_or_else(|| {
        refused(format!("hdr_id {number} of '{name}' is no id of a servo; ids are from 0 to 252"))
    })
}

fn motor(config: &ActuatorConfig) -> Result<Motor, Fault> {
    let HardwareId::Number(number) = &config.hardware else {
        return Err(refused(format!(
            "hdr_id of '{}' is a text; an actuator has the id of its servo",
            config.name
        )));
    };
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
    let ends = config.position_range.map(|end| end * config.scale + config.offset);
    Ok(Motor { id: id(&config.name, *number)?, mode, range: [ends[0].min(ends[1]), ends[0].max(ends[1])] })
}

fn sensors(configs: &[SensorConfig]) -> Result<Vec<(u8, Quantity)>, Fault> {
    let mut sensors: Vec<(u8, Quantity)> = Vec::new();
    for config in configs {
        let sensor = match &config.hardware {
            HardwareId::Number(number) => {
                let id = id(&config.name, *number)?;
                let again = sensors.contains(&(id, Quantity::Position));
                (id, if again { Quantity::Velocity } else { Quantity::Position })
            }
            HardwareId::Name(name) => {
                let wrong = || {
                    refused(format!(
                        "hdr_id '{name}' of '{}' is not of the form id:quantity, as '12:velocity'",
                        config.name
                    ))
                };
                let (number, quantity) = name.split_once(':').ok_or_else(wrong)?;
                let quantity = match quantity {
                    "position" => Quantity::Position,
                    "velocity" => Quantity::Velocity,
                    "current" => Quantity::Current,
                    _ => return Err(wrong()),
                };
                (id(&config.name, number.parse().map_err(|_| wrong())?)?, quantity)
            }
        };
        sensors.push(sensor);
    }
    Ok(sensors)
}
