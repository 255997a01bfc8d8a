//! Numbers over time: energy, rewards, sensors, whatever is watched.

use crate::session::Session;
use crate::watch::watch;
use physics::model::{Enable, ObjType};
use std::collections::VecDeque;

/// Points of a series that are kept.
const POINTS: usize = 2000;

/// What is measured.
#[derive(Clone, Debug, PartialEq)]
pub enum Signal {
    /// Potential energy \[J\], where the model computes energies (`option/flag energy`).
    Potential,
    /// Kinetic energy \[J\].
    Kinetic,
    /// Their sum \[J\].
    Energy,
    /// The reward of the environment's last step.
    Reward,
    /// The sum of rewards of its episode.
    Return,
    /// A number of a sensor: the sensor, and the place among its readings.
    Sensor(usize, usize),
    /// A number by the name of its array, and the place in it.
    Watched(String, usize),
    /// Greatest difference of a position to the reference's \[m, rad\].
    Difference,
}

impl Signal {
    /// What people call it.
    pub fn name(&self, session: &Session) -> String {
        match self {
            Signal::Potential => "potential energy".into(),
            Signal::Kinetic => "kinetic energy".into(),
            Signal::Energy => "energy".into(),
            Signal::Reward => "reward".into(),
            Signal::Return => "return".into(),
            Signal::Sensor(sensor, place) => {
                let name = session.model().label_of(ObjType::Sensor, *sensor);
                if *place == 0 { name } else { format!("{name} {place}") }
            }
            Signal::Watched(name, index) => format!("{name}[{index}]"),
            Signal::Difference => "difference to the reference".into(),
        }
    }

    /// Its value now; none where the model, or what is shown, has no such number.
    pub fn value(&self, session: &Session) -> Option<f64> {
        let (model, data) = (session.model(), session.data());
        let energy = || model.opt.enableflags.contains(Enable::ENERGY).then_some(data.energy);
        match self {
            Signal::Potential => energy().map(|[potential, _]| potential),
            Signal::Kinetic => energy().map(|[_, kinetic]| kinetic),
            Signal::Energy => energy().map(|[potential, kinetic]| potential + kinetic),
            Signal::Reward => session.play().map(|play| play.env().reward()),
            Signal::Return => session.play().map(|play| play.episode().reward),
            Signal::Sensor(sensor, place) => {
                let dimension = *model.sensor_dim.get(*sensor)? as usize;
                let first = model.sensor_adr[*sensor] as usize;
                (*place < dimension).then(|| data.sensor.sensordata[first + place])
            }
            Signal::Watched(name, index) => watch(model, data, name, *index).ok(),
            Signal::Difference => session.reference()?.difference(),
        }
    }
}

/// A signal over time.
#[derive(Clone, Debug)]
pub struct Series {
    signal: Signal,
    points: VecDeque<[f64; 2]>,
}

impl Series {
    /// What is measured.
    pub fn signal(&self) -> &Signal {
        &self.signal
    }

    /// Time \[s\] and value, the oldest first.
    pub fn points(&self) -> impl ExactSizeIterator<Item = [f64; 2]> {
        self.points.iter().copied()
    }

    /// Keeps a value. Where time went back, by a reset or into the past, later points go.
    fn push(&mut self, time: f64, value: f64) {
        while self.points.back().is_some_and(|&[last, _]| last >= time) {
            self.points.pop_back();
        }
        if self.points.len() == POINTS {
            self.points.pop_front();
        }
        self.points.push_back([time, value]);
    }
}

/// The signals that a person follows.
#[derive(Clone, Debug, Default)]
pub struct Signals {
    series: Vec<Series>,
    /// The session's revision when they were measured last.
    measured: Option<u64>,
}

impl Signals {
    /// All that are followed.
    pub fn series(&self) -> &[Series] {
        &self.series
    }

    /// Whether a signal is followed.
    pub fn follows(&self, signal: &Signal) -> bool {
        self.series.iter().any(|series| series.signal == *signal)
    }

    /// Follows a signal from now on, or no longer.
    pub fn follow(&mut self, signal: Signal, on: bool) {
        match (on, self.follows(&signal)) {
            (true, false) => self.series.push(Series { signal, points: VecDeque::new() }),
            (false, true) => self.series.retain(|series| series.signal != signal),
            _ => {}
        }
        self.measured = None;
    }

    /// Forgets all points, for another model.
    pub fn clear(&mut self) {
        self.series.iter_mut().for_each(|series| series.points.clear());
        self.measured = None;
    }

    /// Measures the state of a session, unless it is the one measured last.
    pub fn measure(&mut self, session: &Session) {
        if self.measured.replace(session.revision()) == Some(session.revision()) {
            return;
        }
        let time = session.data().time();
        for series in &mut self.series {
            if let Some(value) = series.signal.value(session).filter(|value| value.is_finite()) {
                series.push(time, value);
            }
        }
    }
}
