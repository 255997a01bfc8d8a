//! Scales and offsets of joints, from readings in poses that are known.
//!
//! A joint at the position q reads `q × scale + offset` on its device. How large the scale is says the device's own unit; which
//! way it counts, and where its zero is, depends on how it was mounted. One pose tells the offset; two tell the way as well,
//! and what is left over tells how well the poses were held.
//!
//! ```
//! use robohive_hardware::calibration::{Measured, fit};
//!
//! // A servo that counts backwards, from its middle on.
//! let held = [Measured { position: -0.5, reading: 3.64 }, Measured { position: 0.5, reading: 2.64 }];
//! let fit = fit(1.0, &held)?;
//! assert_eq!((fit.scale, fit.offset), (-1.0, 3.14));
//! # Ok::<(), robohive_hardware::calibration::CalibrationError>(())
//! ```

use robot::{ActuatorConfig, DeviceConfig, HardwareId, SensorConfig};
use std::fmt;

/// Between two poses a joint must move by this share of what they ask for, or it was not moved.
const MOVED: f64 = 0.25;

/// A joint of a device that is commanded by position, and whose position is read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Joint {
    /// Its actuator in the config.
    pub actuator: usize,
    /// The sensor that reads its position.
    pub sensor: usize,
    /// Sensors that read something else of the same motor.
    pub others: Vec<usize>,
}

/// A joint held in a known pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Where it was held, in the units of the model.
    pub position: f64,
    /// What its device read there.
    pub reading: f64,
}

/// What poses tell of a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Model to device.
    pub scale: f64,
    /// Reading at the joint's zero.
    pub offset: f64,
    /// Of each pose, how far the joint was from where it should have been, in the units of the model.
    pub residuals: Vec<f64>,
    /// How far it moved between the poses beside what the scale says: 1 where both agree. `None` with a single pose.
    pub moved: Option<f64>,
}

/// Why poses tell nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CalibrationError {
    /// No pose was held.
    NoPose,
    /// The config's scale is 0 or no number.
    NoScale(f64),
    /// It moved by less than a quarter of what the poses ask for.
    NotMoved(f64),
}

impl fmt::Display for CalibrationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CalibrationError::NoPose => f.write_str("it was held in no pose"),
            CalibrationError::NoScale(scale) => {
                write!(f, "its config has the scale {scale}, whose size must be the device's unit")
            }
            CalibrationError::NotMoved(share) => write!(
                f,
                "it moved by {:.0} % of what the poses ask for; was it moved, and is it without torque?",
                share * 100.0
            ),
        }
    }
}

impl std::error::Error for CalibrationError {}

/// Interfaces whose `hdr_id` is a servo, mounted as somebody has mounted it. Arms know where their joints are.
pub const SERVOS: [&str; 2] = ["dynamixel", "feetech"];

/// Joints of a device of servos whose actuator is commanded by position and has a sensor of position on the same servo.
pub fn joints(device: &DeviceConfig) -> Vec<Joint> {
    if !device.interface.kind.as_deref().is_some_and(|kind| SERVOS.contains(&kind)) {
        return Vec::new();
    }
    let joint = |(actuator, config): (usize, &ActuatorConfig)| {
        let mode = config.mode.as_deref().map(str::to_ascii_lowercase);
        if !matches!(mode.as_deref(), None | Some("position" | "extended")) {
            return None;
        }
        let same = |(_, sensor): &(usize, &SensorConfig)| motor(&sensor.hardware) == motor(&config.hardware);
        let on_it: Vec<_> = device.sensors.iter().enumerate().filter(same).collect();
        let (sensor, _) = *on_it.iter().find(|(_, sensor)| reads_position(&sensor.hardware))?;
        let others = on_it.iter().map(|(other, _)| *other).filter(|other| *other != sensor).collect();
        Some(Joint { actuator, sensor, others })
    };
    device.actuators.iter().enumerate().filter_map(joint).collect()
}

/// The motor of an entry: what stands before the colon of `12:velocity`.
fn motor(hardware: &HardwareId) -> String {
    match hardware {
        HardwareId::Number(number) => number.to_string(),
        HardwareId::Name(name) => name.split(':').next().unwrap_or(name).to_owned(),
    }
}

/// A number alone reads the position, as it stands first.
fn reads_position(hardware: &HardwareId) -> bool {
    match hardware {
        HardwareId::Number(_) => true,
        HardwareId::Name(name) => name.split_once(':').is_none_or(|(_, quantity)| quantity == "position"),
    }
}

/// Finds scale and offset of a joint whose config has this scale, of which the size is kept.
///
/// # Errors
/// Nothing was held, or the joint did not move between poses.
pub fn fit(scale: f64, held: &[Measured]) -> Result<Fit, CalibrationError> {
    if scale == 0.0 || !scale.is_finite() {
        return Err(CalibrationError::NoScale(scale));
    }
    if held.is_empty() {
        return Err(CalibrationError::NoPose);
    }
    let count = held.len() as f64;
    let position = held.iter().map(|pose| pose.position).sum::<f64>() / count;
    let reading = held.iter().map(|pose| pose.reading).sum::<f64>() / count;
    let spread: f64 = held.iter().map(|pose| (pose.position - position).powi(2)).sum();
    let together: f64 = held.iter().map(|pose| (pose.position - position) * (pose.reading - reading)).sum();
    // One pose, also if it was held several times, says nothing of the way.
    let slope = (spread > 0.0).then(|| together / spread);
    let moved = slope.map(|slope| (slope / scale).abs());
    if let Some(share) = moved.filter(|share| *share < MOVED) {
        return Err(CalibrationError::NotMoved(share));
    }
    let scale = slope.map_or(scale, |slope| scale.abs().copysign(slope));
    let offset = reading - position * scale;
    let residuals = held.iter().map(|pose| (pose.reading - offset) / scale - pose.position).collect();
    Ok(Fit { scale, offset, residuals, moved })
}

/// Writes what was found into a config: actuator, sensor of position, and which way the other sensors of the motor count.
pub fn adopt(device: &mut DeviceConfig, joint: &Joint, fit: &Fit) {
    let turned = device.actuators[joint.actuator].scale.signum() != fit.scale.signum();
    let actuator = &mut device.actuators[joint.actuator];
    (actuator.scale, actuator.offset) = (fit.scale, fit.offset);
    let sensor = &mut device.sensors[joint.sensor];
    (sensor.scale, sensor.offset) = (1.0 / fit.scale, -fit.offset / fit.scale);
    if turned {
        joint.others.iter().for_each(|other| device.sensors[*other].scale *= -1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use robot::Config;

    fn held(scale: f64, offset: f64, positions: &[f64]) -> Vec<Measured> {
        positions.iter().map(|&position| Measured { position, reading: position * scale + offset }).collect()
    }

    #[test]
    fn two_poses_tell_the_way_and_one_the_offset_alone() {
        let two = fit(50.0, &held(-50.0, 3.0, &[0.0, 0.04])).unwrap();
        assert_eq!((two.scale, two.offset, two.moved), (-50.0, 3.0, Some(1.0)));
        let one = fit(50.0, &held(-50.0, 3.0, &[0.04])).unwrap();
        assert_eq!((one.scale, one.offset, one.moved), (50.0, -1.0, None));
        assert_eq!(one.residuals, [0.0]);
    }

    #[test]
    fn a_pose_that_was_missed_shows_in_the_residuals_of_all() {
        let mut poses = held(1.0, 2.0, &[-1.0, 1.0]);
        poses[1].reading += 0.2;
        let fit = fit(-1.0, &poses).unwrap();
        assert!((fit.offset - 2.1).abs() < 1e-12 && fit.scale == 1.0);
        assert!((fit.residuals[0] + 0.1).abs() < 1e-12 && (fit.residuals[1] - 0.1).abs() < 1e-12);
        assert!((fit.moved.unwrap() - 1.1).abs() < 1e-12);
    }

    #[test]
    fn what_was_not_moved_is_refused() {
        let still = [-1.0, 1.0].map(|position| Measured { position, reading: 2.0 });
        assert_eq!(fit(1.0, &still), Err(CalibrationError::NotMoved(0.0)));
        assert_eq!(fit(1.0, &[]), Err(CalibrationError::NoPose));
        assert_eq!(fit(0.0, &still), Err(CalibrationError::NoScale(0.0)));
    }

    #[test]
    fn velocity_turns_with_its_position_and_motors_without_one_are_left_out() {
        let text = "[[device]]
            name = 'arm'
            interface = { type = 'feetech' }
            sensor = [{ name = 'speed', range = [-9, 9], hdr_id = '7:velocity', scale = 2 },
                      { name = 'angle', range = [-2, 2], hdr_id = '7:position' },
                      { name = 'else', range = [-2, 2], hdr_id = '8:current' }]
            actuator = [{ name = 'wheel', pos_range = [-1, 1], vel_range = [-2, 2], hdr_id = 6, mode = 'velocity' },
                        { name = 'blind', pos_range = [-1, 1], vel_range = [-2, 2], hdr_id = 8 },
                        { name = 'joint', pos_range = [-1, 1], vel_range = [-2, 2], hdr_id = 7 }]";
        let mut device = Config::from_toml(text, "arm.toml").unwrap().devices.remove(0);
        let found = joints(&device);
        assert_eq!(found, [Joint { actuator: 2, sensor: 1, others: vec![0] }]);
        let fit = fit(1.0, &held(-1.0, 3.0, &[-1.0, 1.0])).unwrap();
        adopt(&mut device, &found[0], &fit);
        assert_eq!((device.actuators[2].scale, device.actuators[2].offset), (-1.0, 3.0));
        assert_eq!((device.sensors[1].scale, device.sensors[1].offset), (-1.0, 3.0));
        assert_eq!((device.sensors[0].scale, device.sensors[2].scale), (-2.0, 1.0));
        // Joint 7 of an arm is not what its sensor 7 reads.
        device.interface.kind = Some("franka".to_owned());
        assert_eq!(joints(&device), []);
    }
}
