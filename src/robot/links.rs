//! The robot's connections to its devices.

use crate::binding::{Binding, Group};
use crate::config::{Config, DeviceConfig, HardwareId};
use crate::device::{Device, Fault, Registry, Simulated, Units};
use crate::error::RobotError;
use crate::options::Options;
use crate::reading::Readings;
use physics::model::Suggestions;

/// One device for each of the config's, connected; `None` for those without sensors and actuators.
pub(crate) struct Links {
    devices: Vec<Option<Link>>,
    hardware: bool,
    /// Commands or sensor values of one device, in its units.
    buffer: Vec<f64>,
    fault: Option<RobotError>,
}

/// A device, and which entries of its group it has: all in simulation, on hardware those that exist there.
struct Link {
    device: Box<dyn Device>,
    sensors: Vec<usize>,
    actuators: Vec<usize>,
}

impl Link {
    fn whole(device: Box<dyn Device>, group: &Group) -> Link {
        Link {
            device,
            sensors: (0..group.sensors.len()).collect(),
            actuators: (0..group.actuators.len()).collect(),
        }
    }

    /// `None` where the hardware has nothing of the device.
    fn driven(config: &DeviceConfig, registry: &Registry) -> Result<Option<Link>, RobotError> {
        let there = |ids: Vec<&HardwareId>| -> Vec<usize> {
            (0..ids.len()).filter(|place| config.has(ids[*place])).collect()
        };
        let sensors = there(config.sensors.iter().map(|sensor| &sensor.hardware).collect());
        let actuators = there(config.actuators.iter().map(|actuator| &actuator.hardware).collect());
        if sensors.is_empty() && actuators.is_empty() {
            return Ok(None);
        }
        Ok(Some(Link { device: driven(&config.on_hardware(), registry)?, sensors, actuators }))
    }
}

impl Links {
    /// Makes and connects the devices of `binding`, which together read `width` values.
    pub(crate) fn new(
        binding: &Binding,
        width: usize,
        config: Option<&Config>,
        options: &Options,
        registry: &Registry,
    ) -> Result<Links, RobotError> {
        let buffer = vec![0.0; width.max(binding.actuators.len())];
        // Devices that are connected are closed should a later one fail.
        let mut links = Links { devices: Vec::new(), hardware: options.hardware, buffer, fault: None };
        for (place, group) in binding.devices.iter().enumerate() {
            let used = !(group.sensors.is_empty() && group.actuators.is_empty());
            let mut link = match (config, options.hardware) {
                _ if !used => None,
                (_, false) => Some(Link::whole(Box::new(Simulated::new(group.sensors.len())), group)),
                (Some(config), true) => Link::driven(&config.devices[place], registry)?,
                (None, true) => return Err(undriven(&group.name, None, registry)),
            };
            if let Some(link) = &mut link {
                link.device.connect().map_err(|fault| failed(group, fault))?;
            }
            links.devices.push(link);
        }
        Ok(links)
    }

    /// Simulated devices for all of `binding`, which together read `width` values.
    pub(crate) fn simulated(binding: &Binding, width: usize) -> Links {
        let device = |group: &Group| -> Option<Link> {
            let used = !(group.sensors.is_empty() && group.actuators.is_empty());
            let mut device = Simulated::new(group.sensors.len());
            (used && device.connect().is_ok()).then(|| Link::whole(Box::new(device), group))
        };
        let buffer = vec![0.0; width.max(binding.actuators.len())];
        Links { devices: binding.devices.iter().map(device).collect(), hardware: false, buffer, fault: None }
    }

    /// Tells simulated devices what `readings` holds, then reads all devices into it. A device that fails keeps what it
    /// has.
    pub(crate) fn read(&mut self, binding: &Binding, time: f64, readings: &mut Readings) {
        readings.time = f64::NEG_INFINITY;
        for (place, group) in binding.devices.iter().enumerate() {
            let Some(Link { device, sensors, .. }) = &mut self.devices[place] else {
                continue;
            };
            let values = &mut readings.values[group.sensors.clone()];
            if !self.hardware {
                device.observe_simulation(time, values);
            }
            let read = &mut self.buffer[..sensors.len()];
            let outcome =
                device.read(read).and_then(|stamp| match read.iter().position(|v| !v.is_finite()) {
                    Some(bad) if self.hardware => Err(Fault::BadValue(bad)),
                    _ => Ok(stamp),
                });
            match outcome {
                Ok(stamp) => {
                    readings.stamps[place] = stamp;
                    let hardware = device.units() == Units::Hardware;
                    for (place, value) in sensors.iter().zip(&*read) {
                        // A robot without config has readings and no sensors.
                        values[*place] = match binding.sensors.get(group.sensors.start + place) {
                            Some(sensor) if hardware => *value * sensor.config.scale + sensor.config.offset,
                            _ => *value,
                        };
                    }
                }
                Err(fault) => {
                    self.fault.get_or_insert_with(|| failed(group, fault));
                }
            }
            readings.time = readings.time.max(readings.stamps[place]);
        }
        if readings.time == f64::NEG_INFINITY {
            readings.time = time;
        }
    }

    /// Sends to every device the part of `controls` that its actuators have.
    pub(crate) fn apply(&mut self, binding: &Binding, time: f64, controls: &[f64]) -> Result<(), RobotError> {
        self.command(
            binding,
            |actuator| controls[actuator.control],
            |device, commands| device.apply(time, commands),
        )
    }

    /// Moves the actuators of every device to where `qpos` has them.
    pub(crate) fn reset(&mut self, binding: &Binding, qpos: &[f64]) -> Result<(), RobotError> {
        self.command(binding, |actuator| qpos[actuator.position], |device, targets| device.reset(targets))
    }

    /// Informs every device that objects were moved by hand.
    pub(crate) fn moved(&mut self, binding: &Binding) -> Result<(), RobotError> {
        let links = self.devices.iter_mut().zip(&binding.devices);
        links
            .filter_map(|(link, group)| Some((link.as_mut()?, group)))
            .try_for_each(|(link, group)| link.device.moved().map_err(|fault| failed(group, fault)))
    }

    fn command(
        &mut self,
        binding: &Binding,
        wanted: impl Fn(&crate::binding::Actuator) -> f64,
        send: impl Fn(&mut dyn Device, &[f64]) -> Result<(), Fault>,
    ) -> Result<(), RobotError> {
        for (device, group) in self.devices.iter_mut().zip(&binding.devices) {
            let Some(Link { device, actuators, .. }) = device else { continue };
            let commands = &mut self.buffer[..actuators.len()];
            let hardware = device.units() == Units::Hardware;
            for (command, place) in commands.iter_mut().zip(&*actuators) {
                let actuator = &binding.actuators[group.actuators.start + place];
                let value = wanted(actuator);
                let converted = value * actuator.config.scale + actuator.config.offset;
                *command = if hardware { converted } else { value };
            }
            send(device.as_mut(), commands).map_err(|fault| failed(group, fault))?;
        }
        Ok(())
    }

    /// Closes every device.
    pub(crate) fn close(&mut self, binding: &Binding) -> Result<(), RobotError> {
        let mut first = Ok(());
        for (device, group) in self.devices.iter_mut().zip(&binding.devices) {
            if let Some(mut link) = device.take() {
                first = first.and(link.device.close().map_err(|fault| failed(group, fault)));
            }
        }
        first
    }

    /// The first failure since the last reset.
    pub(crate) fn fault(&self) -> Option<&RobotError> {
        self.fault.as_ref()
    }

    /// The first failure since the last reset, as an error.
    pub(crate) fn last_fault(&self) -> Result<(), RobotError> {
        self.fault.clone().map_or(Ok(()), Err)
    }

    /// Drops the failure, before an episode begins.
    pub(crate) fn forget_fault(&mut self) {
        self.fault = None;
    }
}

impl Drop for Links {
    fn drop(&mut self) {
        for link in self.devices.iter_mut().flatten() {
            // Nobody is left to hear of a failure.
            link.device.close().unwrap_or_default();
        }
    }
}

/// The device that the registry makes for a config.
fn driven(config: &DeviceConfig, registry: &Registry) -> Result<Box<dyn Device>, RobotError> {
    let kind = config.interface.kind.as_deref();
    let made = kind.and_then(|kind| registry.device(kind, config));
    made.ok_or_else(|| undriven(&config.name, kind, registry))?
        .map_err(|fault| RobotError::Device { device: config.name.clone(), fault })
}

fn undriven(device: &str, kind: Option<&str>, registry: &Registry) -> RobotError {
    let nearest = kind.and_then(|kind| Suggestions::default().nearest(kind, registry.kinds()));
    RobotError::Interface {
        device: device.to_owned(),
        kind: kind.map(str::to_owned),
        known: registry.kinds().map(str::to_owned).collect(),
        nearest: nearest.map(str::to_owned),
    }
}

fn failed(group: &Group, fault: Fault) -> RobotError {
    RobotError::Device { device: group.name.clone(), fault }
}
