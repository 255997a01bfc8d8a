//! What configs say of servos of any make.

use crate::parameters::Parameters;
use protocol::servo::{Family, Mode};
use robot::{ActuatorConfig, DeviceConfig, Fault, HardwareId, SensorConfig};

fn refused(why: String) -> Fault {
    Fault::Refused(why)
}

/// What servos do when they are to be safe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Safe {
    /// They stay where they are, with torque.
    Hold,
    /// They have no torque.
    Off,
}

/// What a sensor reads: its place among what is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Position,
    Velocity,
    Current,
}

/// What the parameters of a make say beyond those that all have.
pub(crate) struct Make {
    /// Table and packets.
    pub(crate) family: &'static Family,
    /// The model that all servos must be of.
    pub(crate) model: Option<&'static str>,
    /// Limit of the velocity on the way to a goal \[rad/s\]; `None` for the servo's own limit, 0 for none.
    pub(crate) speed: Option<f64>,
    /// The same of the acceleration \[rad/s²\].
    pub(crate) acceleration: f64,
    /// Delay before an answer \[s\], of those that have one.
    pub(crate) return_delay: f64,
    /// Whether all are read by one packet, where they can.
    pub(crate) fast_sync_read: bool,
    /// Baud rates that there are.
    pub(crate) bauds: [f64; 2],
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
pub(super) struct Settings {
    pub(super) port: String,
    pub(super) baud: u32,
    pub(super) safe: Safe,
    pub(super) watchdog: f64,
    pub(super) reset_time: f64,
    pub(super) make: Make,
    pub(super) motors: Vec<Motor>,
    pub(super) sensors: Vec<(u8, Quantity)>,
}

impl Settings {
    /// Those of a device, whose make reads parameters of its own.
    pub(super) fn new(
        config: &DeviceConfig,
        make: impl FnOnce(&mut Parameters) -> Result<Make, Fault>,
    ) -> Result<Settings, Fault> {
        let mut parameters = Parameters::new(config);
        let port = parameters.text("name")?.ok_or_else(|| {
            refused("its interface has no 'name', the path of the serial port, as '/dev/ttyUSB0'".to_owned())
        })?;
        let safe = [Safe::Hold, Safe::Off][parameters.choice("safe", &["hold", "off"])?];
        let make = make(&mut parameters)?;
        let settings = Settings {
            port,
            safe,
            baud: parameters.number("baud", 1e6, make.bauds)? as u32,
            watchdog: parameters.number("watchdog", 0.25, [0.02, 10.0])?,
            reset_time: parameters.number("reset_time", 5.0, [0.1, 60.0])?,
            motors: config.actuators.iter().map(motor).collect::<Result<_, _>>()?,
            sensors: sensors(&config.sensors)?,
            make,
        };
        parameters.finish()?;
        unique(settings.motors.iter().map(|motor| motor.id))?;
        Ok(settings)
    }

    /// Ids of all servos, each once, in the order in which the config first names them.
    pub(super) fn ids(&self) -> Vec<u8> {
        let mut ids = Vec::new();
        for id in self.motors.iter().map(|motor| motor.id).chain(self.sensors.iter().map(|(id, _)| *id)) {
            if !ids.contains(&id) {
                ids.push(id);
            }
        }
        ids
    }
}

fn motor(config: &ActuatorConfig) -> Result<Motor, Fault> {
    let name = &config.name;
    let word = config.mode.as_deref().map(str::to_ascii_lowercase);
    let word = match word.as_deref() {
        None => Mode::Position.name(),
        Some("torque") => Mode::Current.name(),
        Some(word) => word,
    };
    let mode = Mode::ALL.into_iter().find(|mode| mode.name() == word).ok_or_else(|| {
        let known = Mode::ALL.map(Mode::name).join(", ");
        refused(format!("'{name}' has mode '{word}'; there are {known}"))
    })?;
    let HardwareId::Number(number) = &config.hardware else {
        return Err(refused(format!("hdr_id of '{name}' is a text; an actuator has the id of its servo")));
    };
    let ends = config.position_range.map(|end| end * config.scale + config.offset);
    let range = [ends[0].min(ends[1]), ends[0].max(ends[1])];
    Ok(Motor { id: checked(name, *number)?, mode, range })
}

fn checked(name: &str, number: i64) -> Result<u8, Fault> {
    u8::try_from(number).ok().filter(|id| *id <= 252).ok_or_else(|| {
        refused(format!("hdr_id {number} of '{name}' is no id of a servo; ids are from 0 to 252"))
    })
}

/// What each sensor reads: of a number the position, of the same number again the velocity.
fn sensors(configs: &[SensorConfig]) -> Result<Vec<(u8, Quantity)>, Fault> {
    let mut sensors: Vec<(u8, Quantity)> = Vec::new();
    for config in configs {
        let sensor = match &config.hardware {
            HardwareId::Number(number) => {
                let id = checked(&config.name, *number)?;
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
                (checked(&config.name, number.parse().map_err(|_| wrong())?)?, quantity)
            }
        };
        sensors.push(sensor);
    }
    Ok(sensors)
}

/// No two actuators may have one servo.
fn unique(ids: impl Iterator<Item = u8>) -> Result<(), Fault> {
    let mut ids: Vec<_> = ids.collect();
    ids.sort_unstable();
    match ids.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(twice) => Err(refused(format!("two of its actuators have the servo {}", twice[0]))),
        None => Ok(()),
    }
}
