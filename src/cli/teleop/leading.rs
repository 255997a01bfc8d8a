//! What leads joints: gloves by their calibration, leader arms by their config and their servos.

use super::arguments::Teleop;
use super::device::DeviceChoice;
use crate::failure::Failure;
use crate::terminal::note;
use ::teleop::{Calibration, Gravity, GravitySettings, LeaderArm, LeaderConfig, Leading};
use robot::Config;
use std::path::Path;

/// What the device leads, where it does.
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
            Err(Failure::usage("a glove needs --calibration FILE, which says what its sensors mean"))
        }
        (_, Some(_)) => Err(Failure::usage("--calibration is about gloves: add --device glove:PORT")),
        (DeviceChoice::Leader(path), None) => {
            let (text, named) = read(path)?;
            Ok(Some(Leading::Arm(LeaderConfig::from_toml(&text, &named)?)))
        }
        (_, None) => Ok(None),
    }
}

fn read(path: &Path) -> Result<(String, String), Failure> {
    let named = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|error| Failure::usage(format!("{named}: {error}")))?;
    Ok((text, named))
}

/// Connects the servos of a leader arm, whose config is at `path`. They carry it where the config says how and --arm lets them.
///
/// # Errors
/// Files that are missing or wrong, and devices that cannot be reached.
pub fn connect(a: &Teleop, config: &LeaderConfig, path: &Path) -> Result<LeaderArm, Failure> {
    let beside = |name: &str| path.with_file_name(name);
    let devices = Config::read(beside(&config.devices)).map_err(Failure::usage)?;
    let armed = a.live.arming.arm;
    if config.gravity.is_some() && !armed {
        note("the leader's servos are read alone: --arm lets them carry its weight");
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
