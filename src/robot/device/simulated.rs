//! A device that exists in simulation.

use super::{Device, Fault, Units};

/// Reads what the simulation's sensors last said. Its commands reach the simulation as the controls that
/// [`Robot::control`](crate::Robot::control) returns.
#[derive(Clone, Debug, Default)]
pub struct Simulated {
    time: f64,
    values: Vec<f64>,
    connected: bool,
}

impl Simulated {
    /// A device with this many sensors.
    pub fn new(sensors: usize) -> Self {
        Simulated { time: 0.0, values: vec![0.0; sensors], connected: false }
    }

    fn connected(&self) -> Result<(), Fault> {
        if self.connected { Ok(()) } else { Err(Fault::NotConnected) }
    }
}

impl Device for Simulated {
    fn connect(&mut self) -> Result<(), Fault> {
        self.connected = true;
        Ok(())
    }

    fn read(&mut self, values: &mut [f64]) -> Result<f64, Fault> {
        self.connected()?;
        if values.len() != self.values.len() {
            return Err(Fault::Length { given: self.values.len(), expected: values.len() });
        }
        values.copy_from_slice(&self.values);
        Ok(self.time)
    }

    fn apply(&mut self, _time: f64, _commands: &[f64]) -> Result<(), Fault> {
        self.connected()
    }

    fn reset(&mut self, _targets: &[f64]) -> Result<(), Fault> {
        self.connected()
    }

    fn close(&mut self) -> Result<(), Fault> {
        self.connected = false;
        Ok(())
    }

    fn units(&self) -> Units {
        Units::Model
    }

    fn observe_simulation(&mut self, time: f64, values: &[f64]) {
        self.time = time;
        self.values.copy_from_slice(values);
    }
}
