//! A robot's devices: sensors, actuators and cameras, each with its limits, noise and place on the hardware.

use super::value::Value;
use std::collections::BTreeMap;

/// The devices of a robot, in the order of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Config {
    /// Devices.
    pub devices: Vec<DeviceConfig>,
}

/// Sensors and actuators behind one driver.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviceConfig {
    /// Name in messages and logs.
    pub name: String,
    /// How the hardware is reached.
    pub interface: Interface,
    /// Sensors.
    pub sensors: Vec<SensorConfig>,
    /// Actuators.
    pub actuators: Vec<ActuatorConfig>,
    /// Cameras.
    pub cameras: Vec<CameraConfig>,
}

impl DeviceConfig {
    /// Whether the hardware has one of its sensors or actuators: not those whose number is negative, and none of a device
    /// without interface that moves nothing, such as an object that only the simulation observes.
    pub fn has(&self, id: &HardwareId) -> bool {
        let exists = !matches!(id, HardwareId::Number(number) if *number < 0);
        exists && (self.interface.kind.is_some() || !self.actuators.is_empty())
    }

    /// The device with only the entries that the hardware has.
    pub fn on_hardware(&self) -> DeviceConfig {
        let mut present = self.clone();
        present.sensors.retain(|sensor| self.has(&sensor.hardware));
        present.actuators.retain(|actuator| self.has(&actuator.hardware));
        present
    }
}

/// How the hardware of a device is reached.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interface {
    /// The driver; `None` for what exists in simulation only.
    pub kind: Option<String>,
    /// Everything else, for the driver.
    pub parameters: BTreeMap<String, Value>,
}

/// What hardware calls a sensor, an actuator or a stream of a camera.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HardwareId {
    /// A number; negative where there is no hardware.
    Number(i64),
    /// A name.
    Name(String),
}

/// A sensor of the model that the robot reads.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorConfig {
    /// Name in the model, of a sensor of a joint's position or velocity.
    pub name: String,
    /// Readings are clipped to it \[rad, m, rad/s, m/s\].
    pub range: [f64; 2],
    /// Noise at `noise_scale` 1: largest of uniform noise, standard deviation of Gaussian noise.
    pub noise: f64,
    /// Number on the hardware.
    pub hardware: HardwareId,
    /// reading = hardware × scale + offset.
    pub scale: f64,
    /// See `scale`.
    pub offset: f64,
}

/// An actuator of the model that the robot commands.
#[derive(Clone, Debug, PartialEq)]
pub struct ActuatorConfig {
    /// Name in the model, of an actuator of a joint.
    pub name: String,
    /// Limits of the commanded position \[rad, m\].
    pub position_range: [f64; 2],
    /// Limits of the rate at which the command leaves the measured position \[rad/s, m/s\].
    pub velocity_range: [f64; 2],
    /// Limits of the joint's torque or force \[N m, N\]; `None` for the model's alone.
    pub effort_range: Option<[f64; 2]>,
    /// Operating mode of the motor, for the driver.
    pub mode: Option<String>,
    /// Number on the hardware.
    pub hardware: HardwareId,
    /// hardware = command × scale + offset.
    pub scale: f64,
    /// See `scale`.
    pub offset: f64,
}

/// A stream of a camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraConfig {
    /// Name of the stream.
    pub name: String,
    /// Range of its values.
    pub range: [f64; 2],
    /// Noise at `noise_scale` 1.
    pub noise: f64,
    /// `rgb` or `d`.
    pub hardware: HardwareId,
    /// value = hardware × scale + offset.
    pub scale: f64,
    /// See `scale`.
    pub offset: f64,
}
