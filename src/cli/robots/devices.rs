//! Devices of a robot's config, one by one.

use crate::failure::Failure;
use crate::input::library::Making;
use crate::robots::rehearsal::{rehearsal, simulated};
use ::hardware::camera::{Cameras, is_camera};
use ::hardware::{Setup, device};
use clap::{Args, ValueHint};
use library::Rehearsal;
use robot::{Clock, Config, Device, DeviceConfig, Fault, WallClock};
use std::path::{Path, PathBuf};

/// Devices, and how they are reached.
#[derive(Args)]
pub struct Devices {
    /// Robot config that names the devices: TOML, or RoboHive's form
    #[arg(value_name = "CONFIG", value_hint = ValueHint::FilePath)]
    pub config: PathBuf,
    /// Only the device of this name
    #[arg(long, value_name = "NAME")]
    pub device: Option<String>,
    /// Reach simulated devices that move the model of this environment, instead of real ones
    #[arg(long, value_name = "ID")]
    pub rehearse: Option<String>,
    /// How the environment is made
    #[command(flatten)]
    pub making: Making,
}

/// A device that is connected.
pub struct Connected {
    /// What the config says of it.
    pub config: DeviceConfig,
    /// The device, with all that makes it safe.
    pub device: Box<dyn Device>,
    /// Its newest values, in its own units.
    pub values: Vec<f64>,
}

/// Connected devices, and the time that they live in.
pub struct Reached {
    /// Those of the config that have an interface and a sensor or an actuator.
    pub devices: Vec<Connected>,
    /// Their time.
    pub clock: Box<dyn Clock + Send>,
    /// Simulated devices.
    pub rehearsal: Option<Rehearsal>,
    /// The cameras of the config, which are not opened yet.
    cameras: Config,
    setup: Setup,
}

impl Reached {
    /// Opens the cameras.
    pub fn cameras(&self) -> Result<Cameras, Failure> {
        Cameras::connect(&self.cameras, &self.setup).map_err(Failure::new)
    }
}

impl Devices {
    /// Connects them.
    pub fn reach(&self, setup: Setup) -> Result<Reached, Failure> {
        self.reach_mounted(setup, None)
    }

    /// Connects them; simulated ones are as the config at `mounted` says, if there is any.
    pub fn reach_mounted(&self, setup: Setup, mounted: Option<&Path>) -> Result<Reached, Failure> {
        let config = Config::read(&self.config).map_err(Failure::usage)?;
        let mounted = mounted.map(Config::read).transpose().map_err(Failure::usage)?;
        let rehearsal = match &self.rehearse {
            Some(id) => {
                Some(rehearsal(mounted.as_ref().unwrap_or(&config), &mut simulated(id, &self.making)?)?)
            }
            None => None,
        };
        let setup = match &rehearsal {
            Some(rehearsal) => rehearsal.setup(setup),
            None => setup,
        };
        let chosen: Vec<_> = config.devices.iter().filter(|device| self.chosen(device)).collect();
        let (cameras, chosen): (Vec<_>, Vec<_>) = chosen.into_iter().partition(|device| is_camera(device));
        if cameras.is_empty() && chosen.is_empty() {
            let names: Vec<_> = config.devices.iter().map(|device| device.name.as_str()).collect();
            return Err(Failure::usage(format!(
                "{} has no such device with an interface and a sensor, an actuator or a camera; it has {}",
                self.config.display(),
                names.join(", ")
            )));
        }
        let cameras = Config { devices: cameras.into_iter().cloned().collect() };
        let devices = chosen.into_iter().map(|device| connect(device, &setup)).collect::<Result<_, _>>()?;
        let clock = match &rehearsal {
            Some(rehearsal) => rehearsal.clock(),
            None => Box::new(WallClock::default()),
        };
        Ok(Reached { devices, clock, rehearsal, cameras, setup })
    }

    fn chosen(&self, device: &DeviceConfig) -> bool {
        device.interface.kind.is_some()
            && !(device.sensors.is_empty() && device.actuators.is_empty() && !is_camera(device))
            && self.device.as_ref().is_none_or(|name| *name == device.name)
    }
}

/// A failure of a device.
pub fn failed(name: &str, fault: &Fault) -> Failure {
    Failure::new(format!("device '{name}': {fault}"))
}

fn connect(config: &DeviceConfig, setup: &Setup) -> Result<Connected, Failure> {
    let config = &config.on_hardware();
    let mut device = device(config, setup).map_err(|fault| failed(&config.name, &fault))?;
    device.connect().map_err(|fault| failed(&config.name, &fault))?;
    Ok(Connected { config: config.clone(), device, values: vec![0.0; config.sensors.len()] })
}

impl Connected {
    /// Reads the device; returns when its values were measured [s].
    pub fn read(&mut self) -> Result<f64, Fault> {
        self.device.read(&mut self.values)
    }

    /// The newest value of a sensor in the units of the model.
    pub fn value(&self, sensor: usize) -> f64 {
        let config = &self.config.sensors[sensor];
        self.values[sensor] * config.scale + config.offset
    }
}
