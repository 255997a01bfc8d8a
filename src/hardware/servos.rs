//! What configs say of servos of any kind.

use robot::{ActuatorConfig, Fault, HardwareId, SensorConfig};

fn refused(why: String) -> Fault {
    Fault::Refused(why)
}

/// What servos do when they are to be safe.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Safe {
    /// They stay where they are, with torque.
    Hold,
    /// They have no torque.
    Off,
}

/// What a sensor reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Position,
    Velocity,
    Current,
}

fn checked(name: &str, number: i64) -> Result<u8, Fault> {
    u8::try_from(number).ok().filter(|id| *id <= 252).ok_or_else(|| {
        refused(format!("hdr_id {number} of '{name}' is no id of a servo; ids are from 0 to 252"))
    })
}

/// The id of the servo of an actuator.
pub(crate) fn id(config: &ActuatorConfig) -> Result<u8, Fault> {
    let HardwareId::Number(number) = &config.hardware else {
        return Err(refused(format!(
            "hdr_id of '{}' is a text; an actuator has the id of its servo",
            config.name
        )));
    };
    checked(&config.name, *number)
}

/// Commands that an actuator's range of positions gives, in the servo's units \[rad\].
pub(crate) fn range(config: &ActuatorConfig) -> [f64; 2] {
    let ends = config.position_range.map(|end| end * config.scale + config.offset);
    [ends[0].min(ends[1]), ends[0].max(ends[1])]
}

/// What each sensor reads: of a number the position, of the same number again the velocity.
pub(crate) fn sensors(configs: &[SensorConfig]) -> Result<Vec<(u8, Quantity)>, Fault> {
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
pub(crate) fn unique(ids: impl Iterator<Item = u8>) -> Result<(), Fault> {
    let mut ids: Vec<_> = ids.collect();
    ids.sort_unstable();
    match ids.windows(2).find(|pair| pair[0] == pair[1]) {
        Some(twice) => Err(refused(format!("two of its actuators have the servo {}", twice[0]))),
        None => Ok(()),
    }
}

/// Ids of all servos, each once, in the order in which the config first names them.
pub(crate) fn all(motors: impl Iterator<Item = u8>, sensors: &[(u8, Quantity)]) -> Vec<u8> {
    let mut ids = Vec::new();
    for id in motors.chain(sensors.iter().map(|(id, _)| *id)) {
        if !ids.contains(&id) {
            ids.push(id);
        }
    }
    ids
}
