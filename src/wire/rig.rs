//! The devices of a robot's config, on one plant.

use crate::bench::{Bench, Carries, LinkId};
use crate::device::Device;
use crate::dynamixel::{self, Bus};
use crate::plant::{Plant, PlantError};
use robot::{Config, DeviceConfig};

/// A device of the config that is simulated, and its link.
#[derive(Clone, Debug, PartialEq)]
pub struct Rigged {
    /// Its name in the config.
    pub device: String,
    /// Type of its interface.
    pub kind: String,
    /// The key of the interface that says where it is: of a serial port `name`.
    pub key: &'static str,
    /// Where the config has it.
    pub address: String,
    /// Its link.
    pub link: LinkId,
}

/// What makes a device of a config on a plant, and the key of its interface that says where it is.
type Maker = fn(&DeviceConfig, &Plant) -> Result<Box<dyn Device>, PlantError>;

const MAKERS: [(&str, &str, Maker); 1] = [("dynamixel", "name", servos)];

/// Types of interface that can be simulated.
pub fn kinds() -> impl Iterator<Item = &'static str> {
    MAKERS.iter().map(|(kind, _, _)| *kind)
}

/// Puts the devices of `config` that can be simulated on a bench, each moving and measuring what the config says. Links take
/// no time when `at_once`, and as long as the real ones otherwise.
///
/// # Errors
/// Devices that name what the plant does not have; a config without any device that can be simulated.
pub fn rig(config: &Config, plant: Plant, at_once: bool) -> Result<(Bench, Vec<Rigged>), PlantError> {
    let mut devices = Vec::new();
    for device in &config.devices {
        let found = MAKERS.iter().find(|(kind, _, _)| device.interface.kind.as_deref() == Some(kind));
        let Some((kind, key, make)) = found else { continue };
        let address = match device.interface.parameters.get(*key) {
            Some(robot::Value::Text(address)) => address.clone(),
            _ => device.name.clone(),
        };
        let made = make(device, &plant)
            .map_err(|error| PlantError::new(format!("device '{}': {error}", device.name)))?;
        devices.push((device, *kind, *key, address, made));
    }
    if devices.is_empty() {
        let kinds: Vec<_> = kinds().collect();
        return Err(PlantError::new(format!(
            "no device of the config has an interface that can be simulated; those are {}",
            kinds.join(", ")
        )));
    }
    let mut bench = Bench::new(plant);
    let rigged = devices.into_iter().map(|(device, kind, key, address, made)| Rigged {
        device: device.name.clone(),
        kind: kind.to_owned(),
        key,
        address,
        link: bench.connect(made, if at_once { Carries::AT_ONCE } else { Carries::serial(baud(device)) }),
    });
    let rigged = rigged.collect();
    Ok((bench, rigged))
}

/// The baud rate that a config gives its bus.
fn baud(device: &DeviceConfig) -> f64 {
    match device.interface.parameters.get("baud") {
        Some(robot::Value::Integer(baud)) => *baud as f64,
        Some(robot::Value::Number(baud)) => *baud,
        _ => 1e6,
    }
}

fn servos(device: &DeviceConfig, plant: &Plant) -> Result<Box<dyn Device>, PlantError> {
    let servos = dynamixel::servos_of(device, plant)?;
    Ok(Box::new(Bus::new(servos).with_baud(baud(device))))
}
