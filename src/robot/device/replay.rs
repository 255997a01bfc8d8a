//! A device that says again what was recorded.

use super::{Device, Fault, Units};

/// One recorded reading of a device.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// When it was measured \[s\].
    pub time: f64,
    /// Value of every sensor, in the order of the config.
    pub values: Vec<f64>,
}

/// Gives recorded readings, one for each [`Device::read`], and accepts every command.
///
/// ```
/// use robohive_robot::{Device, Fault, Record, Replay, Units};
///
/// let log = (0..2).map(|k| Record { time: 0.1 * f64::from(k), values: vec![f64::from(k)] });
/// let mut device = Replay::new(log, Units::Model);
/// device.connect()?;
/// let mut values = [0.0];
/// assert_eq!((device.read(&mut values)?, values), (0.0, [0.0]));
/// assert_eq!((device.read(&mut values)?, values), (0.1, [1.0]));
/// assert_eq!(device.read(&mut values), Err(Fault::Exhausted));
/// # Ok::<(), Fault>(())
/// ```
pub struct Replay {
    log: Box<dyn Iterator<Item = Record> + Send>,
    units: Units,
    connected: bool,
}

impl Replay {
    /// A device that gives `log`, whose values have these units.
    pub fn new<L>(log: L, units: Units) -> Self
    where
        L: IntoIterator<Item = Record>,
        L::IntoIter: Send + 'static,
    {
        Replay { log: Box::new(log.into_iter()), units, connected: false }
    }

    fn connected(&self) -> Result<(), Fault> {
        if self.connected { Ok(()) } else { Err(Fault::NotConnected) }
    }
}

impl Device for Replay {
    fn connect(&mut self) -> Result<(), Fault> {
        self.connected = true;
        Ok(())
    }

    fn read(&mut self, values: &mut [f64]) -> Result<f64, Fault> {
        self.connected()?;
        let record = self.log.next().ok_or(Fault::Exhausted)?;
        if record.values.len() != values.len() {
            return Err(Fault::Length { given: record.values.len(), expected: values.len() });
        }
        values.copy_from_slice(&record.values);
        Ok(record.time)
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
        self.units
    }
}
