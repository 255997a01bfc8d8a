//! What a robot read: values with the time of measurement, and the last few of them.

use crate::keeper::Keeper;

/// Values of all sensors of all devices.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Readings {
    /// When they were measured \[s\]; of several devices, the latest.
    pub time: f64,
    /// Values in the order of the config; of a robot without config `qpos`, `qvel` and `act`.
    pub values: Vec<f64>,
    /// When each device measured, in the order of the config \[s\].
    pub stamps: Vec<f64>,
}

impl Readings {
    pub(crate) fn new(values: usize, devices: usize) -> Self {
        Readings { time: 0.0, values: vec![0.0; values], stamps: vec![0.0; devices] }
    }

    fn keep(&mut self, keeper: &mut Keeper) {
        keeper.number(&mut self.time);
        keeper.numbers(&mut self.values);
        keeper.numbers(&mut self.stamps);
    }

    /// Takes the numbers of another reading of the same robot.
    pub(crate) fn copy_from(&mut self, other: &Readings) {
        self.time = other.time;
        self.values.copy_from_slice(&other.values);
        self.stamps.copy_from_slice(&other.stamps);
    }
}

/// The last readings, in memory that is allocated once.
#[derive(Clone, Debug)]
pub(crate) struct History {
    ring: Vec<Readings>,
    newest: usize,
}

impl History {
    /// Room for `length` readings, at least one.
    pub(crate) fn new(length: usize, values: usize, devices: usize) -> Self {
        History { ring: vec![Readings::new(values, devices); length.max(1)], newest: 0 }
    }

    /// Writes it, or reads one that the same robot wrote.
    pub(crate) fn keep(&mut self, keeper: &mut Keeper) {
        self.ring.iter_mut().for_each(|readings| readings.keep(keeper));
        let mut newest = self.newest;
        keeper.count(&mut newest);
        self.newest = newest % self.ring.len();
    }

    /// Drops the oldest reading; returns its place for the newest.
    pub(crate) fn advance(&mut self) -> &mut Readings {
        self.newest = (self.newest + 1) % self.ring.len();
        &mut self.ring[self.newest]
    }

    /// The reading of `age` readings ago, 0 for the newest.
    pub(crate) fn past(&self, age: usize) -> Option<&Readings> {
        let length = self.ring.len();
        (age < length).then(|| &self.ring[(self.newest + length - age) % length])
    }

    /// The newest reading.
    pub(crate) fn newest(&self) -> &Readings {
        &self.ring[self.newest]
    }

    /// Number of readings that are kept.
    pub(crate) fn length(&self) -> usize {
        self.ring.len()
    }

    /// Makes all readings equal to the newest.
    pub(crate) fn repeat_newest(&mut self) {
        let newest = self.newest;
        for place in 0..self.ring.len() {
            if let Ok([other, this]) = self.ring.get_disjoint_mut([place, newest]) {
                other.copy_from(this);
            }
        }
    }
}
