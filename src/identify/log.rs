//! A recorded log: where a robot began, what it was told, what its sensors read.

use crate::error::IdentifyError;
use crate::parameter::called;
use dataset::NpzReader;
use physics::model::{ObjType, SensorType};
use physics::{Data, Model};
use std::cmp::Ordering;

/// Most steps of one log.
const MAX_STEPS: f64 = 1e8;

/// What was read, row by row.
#[derive(Clone, Debug)]
pub struct Readings {
    /// Names of the columns.
    pub(crate) names: Vec<String>,
    /// Where the columns stand in `sensordata`, or in `qpos`.
    pub(crate) columns: Vec<usize>,
    /// The columns are of `sensordata`.
    pub(crate) of_sensors: bool,
    /// First columns of quaternions, of which either sign is the same rotation.
    pub(crate) quaternions: Vec<usize>,
    /// All rows, one after the other; NaN for what is missing.
    pub(crate) values: Vec<f64>,
}

impl Readings {
    /// All sensors of a model, in the order of `sensordata`.
    pub fn sensors(model: &Model, values: Vec<f64>) -> Self {
        let (mut names, mut quaternions) = (Vec::new(), Vec::new());
        for sensor in 0..model.nsensor {
            let kind = model.sensor_type[sensor];
            if [SensorType::Framequat, SensorType::Ballquat].iter().any(|quat| quat.code() == kind) {
                quaternions.push(names.len());
            }
            let label = called(model, ObjType::Sensor, sensor);
            let width = model.sensor_dim[sensor];
            names
                .extend((0..width).map(|i| if width == 1 { label.clone() } else { format!("{label}[{i}]") }));
        }
        Readings { columns: (0..names.len()).collect(), names, of_sensors: true, quaternions, values }
    }

    /// All positions of a model, in the order of `qpos`.
    pub fn positions(model: &Model, values: Vec<f64>) -> Self {
        let (mut names, mut quaternions) = (vec![String::new(); model.nq], Vec::new());
        for joint in 0..model.njnt {
            let (label, first) = (called(model, ObjType::Joint, joint), model.jnt_qposadr[joint] as usize);
            let end = if joint + 1 < model.njnt { model.jnt_qposadr[joint + 1] as usize } else { model.nq };
            if end - first >= 4 {
                quaternions.push(end - 4);
            }
            for (i, at) in (first..end).enumerate() {
                names[at] = if end - first == 1 { label.clone() } else { format!("{label}[{i}]") };
            }
        }
        Readings { columns: (0..names.len()).collect(), names, of_sensors: false, quaternions, values }
    }

    /// The number of columns.
    pub(crate) fn width(&self) -> usize {
        self.columns.len()
    }

    /// Those of a number of columns, as they stand in a row.
    fn keep(self, kept: &[usize]) -> Self {
        let (width, rows) = (self.width(), self.values.len() / self.width().max(1));
        let values = (0..rows).flat_map(|row| kept.iter().map(move |&c| row * width + c));
        let whole = |first: &usize| {
            kept.windows(4).position(|four| *four == [*first, first + 1, first + 2, first + 3])
        };
        Readings {
            quaternions: self.quaternions.iter().filter_map(whole).collect(),
            values: values.map(|at| self.values[at]).collect(),
            names: kept.iter().map(|&c| self.names[c].clone()).collect(),
            columns: kept.iter().map(|&c| self.columns[c]).collect(),
            of_sensors: self.of_sensors,
        }
    }
}

/// A recorded log.
#[derive(Clone, Debug)]
pub struct Log {
    /// Where it comes from.
    pub(crate) name: String,
    /// Time of each row \[s\].
    pub(crate) times: Vec<f64>,
    /// Controls in force from each row on.
    pub(crate) ctrl: Vec<f64>,
    pub(crate) readings: Readings,
    /// The state of each row, `qpos`, `qvel` and `act`; of the first one alone where the others were not recorded.
    pub(crate) states: Vec<f64>,
}

impl Log {
    /// A log of a numpy archive as `robohive sim --out` writes it: `time`, `ctrl`, `qpos` and `qvel` of the first row at
    /// least, and `sensordata`. Without sensors, positions are what was read. NaN stands for a reading that is missing.
    ///
    /// # Errors
    /// The archive is damaged, or an array is missing or not what the model takes.
    pub fn of_archive(name: &str, archive: &NpzReader, model: &Model) -> Result<Self, IdentifyError> {
        let broken = |error| IdentifyError::Archive { log: name.into(), error };
        let array = |column: &str| archive.get(column).map_err(broken);
        let Some(times) = array("time")?.map(|times| times.values.to_f64()) else {
            return Err(IdentifyError::column(name, "time", "is missing: it has the time of each row [s]"));
        };
        let rows = times.len();
        let matrix = |column: &str, width: usize| match array(column)? {
            None => Ok(None),
            Some(array) if array.values.len() == rows * width => Ok(Some(array.values.to_f64())),
            Some(array) => Err(IdentifyError::column(
                name,
                column,
                format!(
                    "has the shape {:?}; the model takes {width} numbers in each of {rows} rows: is it of this model?",
                    array.shape
                ),
            )),
        };
        let Some(ctrl) = (if model.nu == 0 { Some(Vec::new()) } else { matrix("ctrl", model.nu)? }) else {
            return Err(IdentifyError::column(
                name,
                "ctrl",
                format!("is missing: {} controls a row", model.nu),
            ));
        };
        let qpos = matrix("qpos", model.nq)?;
        let (qvel, act) = (matrix("qvel", model.nv)?, matrix("act", model.na)?);
        let readings = match (matrix("sensordata", model.nsensordata)?, &qpos) {
            (Some(values), _) if model.nsensordata > 0 => Readings::sensors(model, values),
            (_, Some(values)) => Readings::positions(model, values.clone()),
            (_, None) => {
                return Err(IdentifyError::column(
                    name,
                    "sensordata",
                    "is missing, and so is qpos: nothing was read",
                ));
            }
        };
        let start = Data::new(model);
        let whole = qpos.is_some() && qvel.is_some();
        let states = (0..if whole { rows } else { rows.min(1) }).flat_map(|row| {
            let part = |values: &Option<Vec<f64>>, rest: &[f64]| {
                let width = rest.len();
                values.as_ref().map_or(rest.to_vec(), |all| all[row * width..(row + 1) * width].to_vec())
            };
            [part(&qpos, &start.state.qpos), part(&qvel, &start.state.qvel), part(&act, &start.state.act)]
                .concat()
        });
        Log { name: name.into(), times, ctrl, states: states.collect(), readings }.checked(model)
    }

    /// A log of numbers at hand.
    ///
    /// # Arguments
    /// Times of the rows \[s\], the state that the first row has, `nu` controls a row, and what was read.
    ///
    /// # Errors
    /// Times do not go on, or numbers are too few, too many or not finite.
    pub fn of_arrays(
        name: &str,
        times: Vec<f64>,
        start: &Data,
        ctrl: Vec<f64>,
        readings: Readings,
        model: &Model,
    ) -> Result<Self, IdentifyError> {
        let states = [&start.state.qpos[..], &start.state.qvel, &start.state.act].concat();
        Log { name: name.into(), times, ctrl, readings, states }.checked(model)
    }

    /// The log with some of its columns: those whose name a pattern with `*` stands for.
    ///
    /// # Errors
    /// There is none.
    pub fn only(mut self, patterns: &str) -> Result<Self, IdentifyError> {
        let wanted: Vec<_> = patterns.split(',').map(str::trim).collect();
        let names = &self.readings.names;
        let is = |name: &str| wanted.iter().any(|pattern| crate::choose::matches(pattern, name));
        let kept: Vec<_> = (0..names.len()).filter(|&column| is(&names[column])).collect();
        if kept.is_empty() {
            let all = names.join(", ");
            return Err(IdentifyError::column(
                &self.name,
                patterns,
                format!("no column has this name; there are {all}"),
            ));
        }
        self.readings = self.readings.keep(&kept);
        Ok(self)
    }

    /// The number of rows.
    pub(crate) fn rows(&self) -> usize {
        self.times.len()
    }

    fn checked(self, model: &Model) -> Result<Self, IdentifyError> {
        let (rows, wrong) =
            (self.rows(), |column, reason: String| Err(IdentifyError::column(&self.name, column, reason)));
        if rows < 2 {
            return wrong("time", format!("has {rows} rows; two are needed at least"));
        }
        let after = |row: usize| self.times[row].partial_cmp(&self.times[row - 1]) == Some(Ordering::Greater);
        if let Some(row) = (1..rows).find(|&row| !after(row)) {
            let (this, before) = (self.times[row], self.times[row - 1]);
            return wrong(
                "time",
                format!("is {this} in row {row} after {before}: sort the rows, and drop repeated ones"),
            );
        }
        let steps = (self.times[rows - 1] - self.times[0]) / model.opt.timestep;
        if steps.is_nan() || steps > MAX_STEPS {
            let dt = model.opt.timestep;
            return wrong(
                "time",
                format!("spans {steps:e} steps of {dt} s; {MAX_STEPS:e} can be simulated: is it in seconds?"),
            );
        }
        for (column, values, width) in [
            ("ctrl", &self.ctrl, model.nu),
            ("readings", &self.readings.values, self.readings.width()),
            ("the state", &self.states, model.nq + model.nv + model.na),
        ] {
            let expected =
                if column == "the state" { values.len() / width.max(1) * width } else { rows * width };
            if values.len() != expected || (column == "the state" && values.len() < width) {
                return wrong(column, format!("{} numbers; {rows} rows of {width} are needed", values.len()));
            }
            let bad = values.iter().position(|x| !x.is_finite()).filter(|_| column != "readings");
            if let Some(at) = bad {
                return wrong(column, format!("{} in row {}: cut the log there", values[at], at / width));
            }
        }
        Ok(self)
    }
}
