//! The servos of a leader arm: read, and commanded if they compensate its weight.

use super::config::LeaderConfig;
use super::gravity::Gravity;
use crate::error::TeleopError;
use crate::event::Event;
use robot::{Config, DeviceConfig, Fault};

/// Time between two readings \[s\].
const PERIOD: f64 = 0.01;

/// A bus of servos.
struct Bus {
    device: Box<dyn robot::Device>,
    config: DeviceConfig,
    raw: Vec<f64>,
}

/// A leader arm that is connected.
pub struct LeaderArm {
    buses: Vec<Bus>,
    /// Newest positions and velocities of all sensors, in the model's units.
    readings: Vec<f64>,
    /// Indices of the sensors of the joints that lead.
    joints: Vec<usize>,
    gravity: Option<Gravity>,
    due: f64,
}

impl LeaderArm {
    /// Connects the devices of `devices`, which `open` creates. With `gravity` their actuators compensate the arm's weight from now on;
    /// otherwise nothing is commanded.
    ///
    /// # Errors
    /// A joint without its sensor; a device that cannot be connected or armed.
    pub fn connect(
        config: &LeaderConfig,
        devices: &Config,
        gravity: Option<Gravity>,
        mut open: impl FnMut(&DeviceConfig) -> Result<Box<dyn robot::Device>, Fault>,
    ) -> Result<Self, TeleopError> {
        let names: Vec<&str> = devices
            .devices
            .iter()
            .flat_map(|device| &device.sensors)
            .map(|sensor| &sensor.name[..])
            .collect();
        let place = |sensor: &str| {
            names.iter().position(|name| *name == sensor).ok_or_else(|| TeleopError::Control {
                message: format!(
                    "the leader has no sensor '{sensor}'; its devices have {}",
                    names.join(", ")
                ),
            })
        };
        let joints = config.joints.iter().map(|joint| place(&joint.sensor)).collect::<Result<_, _>>()?;
        let mut arm =
            LeaderArm { buses: Vec::new(), readings: vec![0.0; names.len()], joints, gravity, due: 0.0 };
        for config in &devices.devices {
            let mut config = config.clone();
            if arm.gravity.is_none() {
                config.actuators.clear();
            }
            let fail = |fault: Fault| refused(&config.name, &fault);
            let mut device = open(&config).map_err(fail)?;
            device.connect().map_err(fail)?;
            if !config.actuators.is_empty() {
                device.reset(&vec![0.0; config.actuators.len()]).map_err(fail)?;
            }
            let raw = vec![0.0; config.sensors.len()];
            arm.buses.push(Bus { device, config, raw });
        }
        Ok(arm)
    }

    /// Time of the next call of [`LeaderArm::tend`] \[s\].
    pub fn due(&self) -> f64 {
        self.due
    }

    /// Reads the joints at `now` \[s\], and commands the currents that compensate the weight there.
    ///
    /// # Errors
    /// A device that failed.
    pub fn tend(&mut self, now: f64, events: &mut Vec<Event>) -> Result<(), TeleopError> {
        self.due = now + PERIOD;
        let mut place = 0;
        for Bus { device, config, raw } in &mut self.buses {
            device.read(raw).map_err(|fault| refused(&config.name, &fault))?;
            for (value, sensor) in raw.iter().zip(&config.sensors) {
                self.readings[place] = value * sensor.scale + sensor.offset;
                place += 1;
            }
        }
        let lead = |(k, sensor): (u16, &usize)| Event::Lead(k, self.readings[*sensor]);
        events.extend((0..).zip(&self.joints).map(lead));
        let Some(gravity) = &mut self.gravity else { return Ok(()) };
        let currents = gravity.currents(self.readings.iter().copied())?;
        let mut rest = &currents[..];
        for Bus { device, config, .. } in &mut self.buses {
            let (own, others) = rest.split_at(config.actuators.len());
            rest = others;
            if !own.is_empty() {
                device.apply(now, own).map_err(|fault| refused(&config.name, &fault))?;
            }
        }
        Ok(())
    }

    /// Closes the devices; servos that compensated the weight lose their torque.
    ///
    /// # Errors
    /// The first device that fails.
    pub fn close(mut self) -> Result<(), TeleopError> {
        let close = |bus: &mut Bus| bus.device.close().map_err(|fault| refused(&bus.config.name, &fault));
        let outcomes: Vec<_> = self.buses.iter_mut().map(close).collect();
        outcomes.into_iter().collect()
    }
}

fn refused(name: &str, fault: &Fault) -> TeleopError {
    TeleopError::Device {
        device: format!("leader arm, {name}"),
        path: None,
        message: fault.to_string(),
        fix: "check its devices with `robohive hardware check`; finished episodes are kept".to_owned(),
    }
}
