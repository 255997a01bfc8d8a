//! Drivers by the type of interface that a config names.

use crate::driver::Driver;
use crate::franka::Franka;
use crate::guard::Guarded;
use crate::optitrack::OptiTrack;
use crate::robotiq::Robotiq;
use crate::setup::Setup;
use crate::{dynamixel, feetech};
use robot::{Device, DeviceConfig, Fault, Registry};

/// Makes the driver of a device.
type Maker = fn(&DeviceConfig, &Setup) -> Result<Box<dyn Driver>, Fault>;

const MAKERS: [(&str, Maker); 5] = [
    ("dynamixel", |config, setup| Ok(Box::new(dynamixel::driver(config, setup.serial.clone())?))),
    ("feetech", |config, setup| Ok(Box::new(feetech::driver(config, setup.serial.clone())?))),
    ("franka", franka),
    ("optitrack", optitrack),
    ("robotiq", robotiq),
];

/// Types of interface that there are drivers for.
pub fn kinds() -> impl Iterator<Item = &'static str> {
    MAKERS.iter().map(|(kind, _)| *kind)
}

/// All drivers of this crate, each with what makes it safe around it.
pub fn registry(setup: &Setup) -> Registry {
    let mut registry = Registry::default();
    for (kind, make) in MAKERS {
        let setup = setup.clone();
        registry.register(kind, move |config| guarded(config, make, &setup));
    }
    registry
}

/// One device of a config, without a robot around it; not yet connected.
///
/// # Errors
/// An interface that nothing drives; what the config says wrongly.
pub fn device(config: &DeviceConfig, setup: &Setup) -> Result<Box<dyn Device>, Fault> {
    let kind = config.interface.kind.as_deref().unwrap_or("none");
    let found = MAKERS.iter().find(|(known, _)| *known == kind);
    let (_, make) = found.ok_or_else(|| {
        let known: Vec<_> = kinds().collect();
        Fault::Refused(format!("nothing drives the interface '{kind}'; there are {}", known.join(", ")))
    })?;
    guarded(config, *make, setup)
}

fn guarded(config: &DeviceConfig, make: Maker, setup: &Setup) -> Result<Box<dyn Device>, Fault> {
    let driver = make(config, setup)?;
    let (sensors, actuators) = (config.sensors.len(), config.actuators.len());
    Ok(Box::new(Guarded::new(&config.name, driver, sensors, actuators, setup)))
}

fn franka(config: &DeviceConfig, setup: &Setup) -> Result<Box<dyn Driver>, Fault> {
    Ok(Box::new(Franka::new(config, setup.sockets.clone())?))
}

fn optitrack(config: &DeviceConfig, setup: &Setup) -> Result<Box<dyn Driver>, Fault> {
    Ok(Box::new(OptiTrack::new(config, setup.sockets.clone())?))
}

fn robotiq(config: &DeviceConfig, setup: &Setup) -> Result<Box<dyn Driver>, Fault> {
    Ok(Box::new(Robotiq::new(config, setup.serial.clone(), setup.sockets.clone())?))
}
