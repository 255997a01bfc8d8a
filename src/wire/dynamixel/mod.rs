//! Dynamixel servos on a bus, protocol 2.0.

mod bus;
mod memory;
mod servo;

pub use bus::Bus;
pub use servo::Servo;

use crate::plant::{Plant, PlantError};
use protocol::dynamixel::MODELS;
use robot::{DeviceConfig, HardwareId};

/// A servo for every actuator of a device, on the motor that it names, with the angle that its scale and offset make.
///
/// # Errors
/// Actuators that the plant does not have, and ids that no servo can have.
pub fn servos_of(device: &DeviceConfig, plant: &Plant) -> Result<Vec<Servo>, PlantError> {
    let servo = |actuator: &robot::ActuatorConfig| {
        let id = match actuator.hardware {
            HardwareId::Number(number) => u8::try_from(number).ok().filter(|id| *id <= 252),
            HardwareId::Name(_) => None,
        };
        let id = id.ok_or_else(|| {
            PlantError::new(format!("the hdr_id of '{}' is no id of a servo: 0 to 252", actuator.name))
        })?;
        let mut servo = Servo::new(&MODELS[0], id);
        servo.mount(plant.motor(&actuator.name)?, actuator.scale, actuator.offset);
        Ok(servo)
    };
    device.actuators.iter().map(servo).collect()
}
