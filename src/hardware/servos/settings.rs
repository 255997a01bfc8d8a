//! Settings of servos of any make, from a config.

use crate::parameters::Parameters;
use protocol::servo::{Family, Mode};
use robot::{ActuatorConfig, DeviceConfig, Fault, HardwareId, SensorConfig};

fn refused(why: String) -> Fault {
    Fault::Refused(why)
}

/// The safe state of servos.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Safe {
    /// They stay where they are, with torque.
    Hold,
    /// They have no torque.
    Off,
}

/// The quantity that a sensor reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Position,
    Velocity,
    Current,
}

/// Parameters that differ between makes.
pub(crate) struct Make {
    /// Control table and packets.
    pub(crate) family: &'static Family,
    /// The model that all servos must be of.
    pub(crate) model: Option<&'static str>,
    /// Velocity limit of a motion to a goal \[rad/s\]; `None` for the servo's own limit, 0 for no limit.
    pub(crate) speed: Option<f64>,
    /// Acceleration limit of a motion to a goal \[rad/s²\]; 0 for no limit.
    pub(crate) acceleration: f64,
    /// Delay before an answer \[s\], for servos with a register for it.
    pub(crate) return_delay: f64,
    /// Whether all servos are read by one packet, if they support it.
    pub(crate) fast_sync_read: bool,
    /// Smallest and largest baud rate.
    pub(crate) bauds: [f64; 2],
}

/// A servo that is commanded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motor {
    pub(super) id: u8,
    pub(super) mode: Mode,
    /// Range of commands from the config's range of positions \[rad\], as the servo counts.
    pub(super) range: [f64; 2],
}

/// Parameters of a bus, and its servos.
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
    /// The settings of a device; `make` reads the parameters of its make.
    ///
    /// # Errors
    /// A parameter that is missing or wrong.
    pub(super) fn new(
        config: &DeviceConfig,
        make: impl FnOnce(&mut Parameters) -> Result<Make, Fault>,
    ) -> Result<Settings, Fault> {
        let mut parameters = Parameters::new(config);
        let port = parameters.text("name")?.ok_or_else(|| {
            refused(
                "its interface needs a 'name', the path of the serial port, such as '/dev/ttyUSB0'"
                    .to_owned(),
            )
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
        refused(format!("'{name}' has the unknown mode '{word}'; the modes are {known}"))
    })?;
    let HardwareId::Number(number) = &config.hardware else {
        return Err(refused(format!(
            "the hdr_id of '{name}' is a string; it must be the id of its servo, a number"
        )));
    };
    let ends = config.position_range.map(|end| end * config.scale + config.offset);
    let range = [ends[0].min(ends[1]), ends[0].max(ends[1])];
    Ok(Motor { id: checked(name, *number)?, mode, range })
}

fn checked(name: &str, number: i64) -> Result<u8, Fault> {
    u8::try_from(number).ok().filter(|id| *id <= 252).ok_or_else(|| {
        refused(format!("the hdr_id {number} of '{name}' is not the id of a servo; ids are from 0 to 252"))
    })
}

/// Servo and quantity of each sensor: the first sensor with a number reads the position, the next with the same number the velocity.
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
                        "the hdr_id '{name}' of '{}' is not of the form id:quantity, such as '12:velocity'; quantities are position, velocity, current",
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

/// Refuses two actuators with the same servo.
fn unique(ids: impl Iterator<Item = u8>) -> Result<(), Fault> {
    let mut ids: Vec<_> = ids.collect();
    ids.sort_unstable();
    match ids.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(twice) => Err(refused(format!(
            "two of its actuators have the hdr_id {}; each needs a servo of its own",
            twice[0]
        ))),
        None => Ok(()),
    }
}
