//! The robot's connections to its devices.

use crate::binding::{Binding, Group};
use crate::config::{Config, DeviceConfig};
use crate::device::{Device, Fault, Registry, Simulated, Units};
use crate::error::RobotError;
use crate::options::Options;
use crate::reading::Readings;
use physics::model::Suggestions;

/// One device for each of the config's, connected; `None` for those without sensors and actuators.
pub(crate) struct Links {
    devices: Vec<Option<Box<dyn Device>>>,
    hardware: bool,
    /// Commands or sensor values of one device, in its units.
    buffer: Vec<f64>,
    fault: Option<RobotError>,
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
            let mut device: Box<dyn Device> = match (config, options.hardware) {
                _ if !used => {
                    links.devices.push(None);
                    continue;
                }
                (_, false) => Box::new(Simulated::new(group.sensors.len())),
                (Some(config), true) => driven(&config.devices[place], registry)?,
                (None, true) => return Err(undriven(&group.name, None, registry)),
            };
            device.connect().map_err(|fault| failed(group, fault))?;
            links.devices.push(Some(device));
        }
        Ok(links)
    }

    /// Simulated devices for all of `binding`, which together read `width` values.
    pub(crate) fn simulated(binding: &Binding, width: usize) -> Links {
        let device = |group: &Group| -> Option<Box<dyn Device>> {
            let used = !(group.sensors.is_empty() && group.actuators.is_empty());
            let mut device = Simulated::new(group.sensors.len());
            (used && device.connect().is_ok()).then(|| Box::new(device) as Box<dyn Device>)
        };
        let buffer = vec![0.0; width.max(binding.actuators.len())];
        Links { devices: binding.devices.iter().map(device).collect(), hardware: false, buffer, fault: None }
    }

    /// Tells simulated devices what `readings` holds, then reads all devices into it. A device that fails keeps what it
    /// has.
    pub(crate) fn read(&mut self, binding: &Binding, time: f64, readings: &mut Readings) {
        readings.time = f64::NEG_INFINITY;
        for (place, group) in binding.devices.iter().enumerate() {
            let Some(device) = &mut self.devices[place] else {
                continue;
            };
            let values = &mut readings.values[group.sensors.clone()];
            if !self.hardware {
                device.observe_simulation(time, values);
            }
            let read = &mut self.buffer[..values.len()];
            let outcome =
                device.read(read).and_then(|stamp| match read.iter().position(|v| !v.is_finite()) {
                    Some(bad) if self.hardware => Err(Fault::BadValue(bad)),
                    _ => Ok(stamp),
                });
            match outcome {
                Ok(stamp) => {
                    readings.stamps[place] = stamp;
                    values.copy_from_slice(read);
                    if device.units() == Units::Hardware {
                        for (value, sensor) in values.iter_mut().zip(&binding.sensors[group.sensors.clone()])
                        {
                            *value = *value * sensor.config.scale + sensor.config.offset;
                        }
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

    fn command(
        &mut self,
        binding: &Binding,
        wanted: impl Fn(&crate::binding::Actuator) -> f64,
        send: impl Fn(&mut dyn Device, &[f64]) -> Result<(), Fault>,
    ) -> Result<(), RobotError> {
        for (device, group) in self.devices.iter_mut().zip(&binding.devices) {
            let Some(device) = device else { continue };
            let commands = &mut self.buffer[..group.actuators.len()];
            let hardware = device.units() == Units::Hardware;
            for (command, actuator) in commands.iter_mut().zip(&binding.actuators[group.actuators.clone()]) {
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
            if let Some(mut device) = device.take() {
                first = first.and(device.close().map_err(|fault| failed(group, fault)));
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
        for device in self.devices.iter_mut().flatten() {
            // Nobody is left to hear of a failure.
            device.close().unwrap_or_default();
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
