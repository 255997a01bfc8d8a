//! A glove on a person's hand: from samples to the joints of a hand, by a calibration.

use crate::error::TeleopError;
use crate::event::{Axis, Device, Event, Lost};
use crate::held::Sample;
use crate::settings::{number, wrong};
use protocol::cyberglove::{Decoder, GloveError, MOST, Message};
use toml::{Table, Value};

/// Decodes samples.
#[derive(Debug, Default)]
pub struct Glove {
    decoder: Decoder,
    trouble: Option<GloveError>,
}

impl Glove {
    /// Takes bytes, in pieces of any length. Sensors are axes, with their raw values.
    pub fn feed(&mut self, bytes: &[u8], events: &mut Vec<Event>) {
        self.decoder.feed(bytes);
        while let Some(message) = self.decoder.next_message() {
            match message {
                Message::Sample(values) => events.extend(
                    (0..).zip(values).map(|(k, value)| Event::Move(Axis(Device::Glove, k), f64::from(value))),
                ),
                Message::Error(trouble) => {
                    events.push(Event::Lost(Lost::Device(Device::Glove)));
                    self.trouble = Some(trouble);
                }
                Message::Sensors(_) => {}
            }
        }
    }

    /// What it has refused since the last call.
    pub fn trouble(&mut self) -> Option<GloveError> {
        self.trouble.take()
    }
}

/// What a person's glove says of the joints of a hand, as RoboHive's gloves are calibrated: each sensor between the person's least and
/// largest value is 0 to 1; a matrix makes of these, and a 1 behind them, joints from 0 to 1 of their ranges.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    least: Vec<f64>,
    largest: Vec<f64>,
    /// Rows of a joint, each of all sensors and the 1.
    matrix: Vec<Vec<f64>>,
    ranges: Vec<[f64; 2]>,
    actuators: Vec<String>,
}

impl Calibration {
    /// Reads a calibration: `min` and `max` of 18 or 22 sensors, and of each joint a row of `matrix`, a pair of `ranges` \[rad\] and the name of its
    /// actuator in `actuators`, which is empty for joints that the hand lacks. `file` is its name, for errors.
    ///
    /// # Errors
    /// It is no TOML, or its parts do not fit together.
    pub fn from_toml(text: &str, file: &str) -> Result<Self, TeleopError> {
        let wrong = |message: String| wrong(file, message);
        let table = text.parse::<Table>().map_err(|error| wrong(error.to_string()))?;
        let list = |name: &str| {
            table
                .get(name)
                .and_then(Value::as_array)
                .ok_or_else(|| wrong(format!("it lacks the list '{name}'")))
        };
        let row = |name: &str, values: &[Value]| {
            let numbers: Option<Vec<f64>> =
                values.iter().map(|value| number(value).filter(|x| x.is_finite())).collect();
            numbers.ok_or_else(|| wrong(format!("'{name}' has something else than numbers")))
        };
        let rows = |name: &str| {
            let rows = list(name)?.iter();
            rows.map(|values| row(name, values.as_array().map_or(&[], Vec::as_slice)))
                .collect::<Result<Vec<_>, _>>()
        };
        let (least, largest) = (row("min", list("min")?)?, row("max", list("max")?)?);
        let (matrix, pairs) = (rows("matrix")?, rows("ranges")?);
        let names = list("actuators")?.iter();
        let actuators: Vec<String> = names.filter_map(Value::as_str).map(str::to_owned).collect();
        let sensors = least.len();
        if ![18, MOST].contains(&sensors) || largest.len() != sensors {
            return Err(wrong(format!(
                "'min' and 'max' have 18 or 22 values, and not {sensors} and {}",
                largest.len()
            )));
        }
        if let Some(k) = (0..sensors).find(|&k| least[k] >= largest[k]) {
            return Err(wrong(format!(
                "sensor {k}: its least value {} is not below {}",
                least[k], largest[k]
            )));
        }
        if let Some(k) = matrix.iter().position(|row| row.len() != sensors + 1) {
            return Err(wrong(format!(
                "row {k} of 'matrix' has {} values, and not {}",
                matrix[k].len(),
                sensors + 1
            )));
        }
        let ranges: Vec<[f64; 2]> = pairs
            .iter()
            .filter_map(|pair| <[f64; 2]>::try_from(pair.as_slice()).ok())
            .filter(|[low, high]| low <= high)
            .collect();
        if [pairs.len(), ranges.len(), actuators.len()] != [matrix.len(); 3] {
            return Err(wrong(format!(
                "{} rows of 'matrix' need as many 'ranges' of [low, high] and 'actuators'; there are {} and {}",
                matrix.len(),
                ranges.len(),
                actuators.len()
            )));
        }
        Ok(Calibration { least, largest, matrix, ranges, actuators })
    }

    /// Names of the actuators of the joints.
    pub fn actuators(&self) -> &[String] {
        &self.actuators
    }

    /// How many sensors it is of.
    pub fn sensors(&self) -> usize {
        self.least.len()
    }

    /// Where the joints are \[rad\] when the sensors measure this, one value for each.
    pub fn joints(&self, raw: &[f64]) -> Vec<f64> {
        let ends = self.least.iter().zip(&self.largest);
        let shares = raw.iter().zip(ends).map(|(x, (low, high))| (x.clamp(*low, *high) - low) / (high - low));
        let shares: Vec<f64> = shares.chain([1.0]).collect();
        let place = |row: &Vec<f64>| row.iter().zip(&shares).map(|(a, b)| a * b).sum::<f64>().clamp(0.0, 1.0);
        let joints = self.matrix.iter().zip(&self.ranges);
        joints.map(|(row, [low, high])| low + place(row) * (high - low)).collect()
    }

    /// The joints of a sample that every sensor is in, and no other: what a glove with more sensors calls the first 18 is elsewhere.
    pub(crate) fn read(&self, sample: &Sample) -> Option<Vec<f64>> {
        let sensors = 0..self.least.len() as u16;
        if sample.axes.contains_key(&Axis(Device::Glove, sensors.end)) {
            return None;
        }
        let raw: Option<Vec<f64>> =
            sensors.map(|k| sample.axes.get(&Axis(Device::Glove, k)).copied()).collect();
        raw.map(|raw| self.joints(&raw))
    }
}
