//! Drivers by the type of interface that a config names.

use crate::driver::Driver;
use crate::dynamixel::Dynamixel;
use crate::guard::Guarded;
use crate::setup::Setup;
use robot::{Device, DeviceConfig, Fault, Registry};

/// Makes the driver of a device.
type Maker = fn(&DeviceConfig, &Setup) -> Result<Box<dyn Driver>, Fault>;

const MAKERS: [(&str, Maker); 1] = [("dynamixel", dynamixel)];

/// All drivers of this crate, each with what makes it safe around it.
pub fn registry(setup: &Setup) -> Registry {
    let mut registry = Registry::default();
    for (kind, make) in MAKERS {
        let setup = setup.clone();
        registry.register(kind, move |config| {
            let driver = make(config, &setup)?;
            let (sensors, actuators) = (config.sensors.len(), config.actuators.len());
            let guarded = Guarded::new(&config.name, driver, sensors, actuators, &setup);
            Ok(Box::new(guarded) as Box<dyn Device>)
        });
    }
    registry
}

fn dynamixel(config: &DeviceConfig, setup: &Setup) -> Result<Box<dyn Driver>, Fault> {
    Ok(Box::new(Dynamixel::new(config, setup.serial.clone())?))
}
