//! Devices that lead joints: gloves with their calibration, leader arms with their config and their servos.

use super::arguments::Teleop;
use super::device::DeviceChoice;
use crate::failure::Failure;
use crate::terminal::note;
use ::teleop::{Calibration, Gravity, GravitySettings, LeaderArm, LeaderConfig, Leading};
use robot::Config;
use std::path::Path;

/// The controls that the device leads; `None` for devices that do not lead joints.
///
/// # Errors
/// A file that is missing or wrong.
pub fn leading(a: &Teleop) -> Result<Option<Leading>, Failure> {
    match (&a.device, &a.calibration) {
        (DeviceChoice::Glove(_), Some(path)) => {
            let (text, named) = read(path)?;
            Ok(Some(Leading::Glove(Calibration::from_toml(&text, &named)?)))
        }
        (DeviceChoice::Glove(_), None) => {
            Err(Failure::usage("a glove needs --calibration FILE, which maps its sensors to joints"))
        }
        (_, Some(_)) => Err(Failure::usage("--calibration applies only to gloves: add --device glove:PORT")),
        (DeviceChoice::Leader(path), None) => {
            let (text, named) = read(path)?;
            Ok(Some(Leading::Arm(LeaderConfig::from_toml(&text, &named)?)))
        }
        (_, None) => Ok(None),
    }
}

/// The text of a file, and its name for errors.
///
/// # Errors
/// It cannot be read.
pub fn read(path: &Path) -> Result<(String, String), Failure> {
    let named = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|error| Failure::usage(format!("{named}: {error}")))?;
    Ok((text, named))
}

/// Connects the servos of a leader arm, whose config is at `path`. They compensate its weight if the config has a section
/// `[gravity]` and `--arm` is given.
///
/// # Errors
/// Files that are missing or wrong, and devices that cannot be reached.
pub fn connect(a: &Teleop, config: &LeaderConfig, path: &Path) -> Result<LeaderArm, Failure> {
    let beside = |name: &str| path.with_file_name(name);
    let devices = Config::read(beside(&config.devices)).map_err(Failure::usage)?;
    let armed = a.live.arming.arm;
    if config.gravity.is_some() && !armed {
        note("the leader's servos are only read: add --arm to let them compensate its weight");
    }
    let gravity = config.gravity.as_ref().filter(|_| armed);
    let gravity = gravity.map(|settings| weight(&beside(&settings.model), &devices, settings)).transpose()?;
    let setup = a.live.arming.setup();
    Ok(LeaderArm::connect(config, &devices, gravity, |device| ::hardware::device(device, &setup))?)
}

fn weight(path: &Path, devices: &Config, settings: &GravitySettings) -> Result<Gravity, Failure> {
    let loaded = mjcf::Loader::default().load(path).map_err(Failure::usage)?;
    Ok(Gravity::new(loaded.model, devices, settings)?)
}
