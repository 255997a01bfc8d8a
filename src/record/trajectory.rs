//! States of a model one after the other, as they were recorded.

use crate::error::RecordError;
use crate::recorded::Recorded;
use dataset::trace::TraceReader;
use dataset::{Array, NpzError, NpzReader};
use env::{Env, EnvError};
use physics::{Data, Model};
use std::fmt;

/// Recorded states of a model, each with its time.
#[derive(Clone, Debug)]
pub struct Trajectory {
    name: String,
    times: Vec<f64>,
    parts: Vec<Part>,
}

/// One array of the states, row by row.
#[derive(Clone, Debug)]
struct Part {
    name: &'static str,
    width: usize,
    values: Vec<f64>,
}

/// Why a recording shows no states of a model.
#[derive(Debug)]
pub enum TrajectoryError {
    /// The archive is damaged.
    Archive(NpzError),
    /// The recording of episodes is damaged, or is of another environment.
    Episode(RecordError),
    /// Arrays are missing, have other widths than the model, or numbers that no state has.
    Rows(String),
}

/// Arrays of a state with their widths in a model.
fn widths(model: &Model) -> [(&'static str, usize); 6] {
    [
        ("qpos", model.nq),
        ("qvel", model.nv),
        ("act", model.na),
        ("ctrl", model.nu),
        ("mocap_pos", 3 * model.nmocap),
        ("mocap_quat", 4 * model.nmocap),
    ]
}

impl Trajectory {
    /// The states in a numpy archive: `qpos`, and where they are there `time`, `qvel`, `act`, `ctrl`, `mocap_pos` and
    /// `mocap_quat`, each with a row a state, as `robohive sim --out` writes them; or the same under `rollout.`, as
    /// references of MuJoCo hold them, whose rows are the states after every step. Without `time`, states are a time step apart.
    ///
    /// # Errors
    /// The archive is damaged, or these are no states of the model.
    pub fn of_archive(name: &str, archive: &NpzReader, model: &Model) -> Result<Self, TrajectoryError> {
        let prefix = if archive.contains("qpos") { "" } else { "rollout." };
        let array = |part: &str| archive.get(&format!("{prefix}{part}")).map_err(TrajectoryError::Archive);
        let Some(qpos) = array("qpos")? else {
            let names: Vec<&str> = archive.names().take(8).collect();
            return Err(TrajectoryError::Rows(format!(
                "{name} has neither qpos nor rollout.qpos, which hold positions; it has {}",
                names.join(", ")
            )));
        };
        let rows = qpos.rows();
        let first = usize::from(!prefix.is_empty());
        let times = match array("time")? {
            Some(times) => times.values.to_f64(),
            None => (0..rows).map(|row| (row + first) as f64 * model.opt.timestep).collect(),
        };
        let mut parts = Vec::new();
        for (part, width) in widths(model) {
            // Controls of a reference drive the step to the row; an array of zero width may be missing.
            if let Some(Array { values, .. }) = array(part)?.filter(|_| width > 0) {
                parts.push(Part { name: part, width, values: values.to_f64() });
            }
        }
        Trajectory { name: name.to_owned(), times, parts }.checked()
    }

    /// The states of a trial of an environment's recording. `env` is left in the first of them, so that its model is the one
    /// of the trial.
    ///
    /// # Errors
    /// The trial is damaged, holds no states, or is of another environment.
    pub fn of_trial(trace: &TraceReader, trial: &str, env: &mut Env) -> Result<Self, TrajectoryError> {
        let recorded = Recorded::read(trace, trial).map_err(TrajectoryError::Episode)?;
        let refused = |error: EnvError| TrajectoryError::Episode(error.into());
        env.reset(recorded.seed.or(Some(0))).map_err(refused)?;
        recorded.restore_drawn(env).map_err(refused)?;
        if let Some(world) = recorded.start(env) {
            env.set_world(&world).map_err(refused)?;
        }
        let model = &env.scene().model;
        let mut parts = Vec::new();
        for (name, width) in widths(model) {
            let Some(column) = recorded.part(name).filter(|_| width > 0) else { continue };
            // RoboSet has the robot's joints alone; the rest stays where it was at the start.
            let rest = env.world().parts().find(|(part, _)| *part == name).map(|(_, all)| all.to_vec());
            let rest = rest.unwrap_or_default();
            let rows = (0..).map_while(|row| column.row(row));
            let values = rows.flat_map(|row| [row, rest.get(row.len()..).unwrap_or_default()].concat());
            parts.push(Part { name, width, values: values.collect() });
        }
        let Some(rows) =
            parts.iter().find(|part| part.name == "qpos").map(|part| part.values.len() / part.width)
        else {
            let wanted = format!("{}, {trial}: holds no positions to show", trace.path().display());
            return Err(TrajectoryError::Rows(wanted));
        };
        let times = match recorded.part("time") {
            Some(times) => (0..).map_while(|row| times.row(row)).flatten().copied().collect(),
            None => (0..rows).map(|row| row as f64 * env.dt()).collect(),
        };
        let name = format!("{}, {trial}", trace.path().display());
        Trajectory { name, times, parts }.checked()
    }

    /// Refuses arrays that do not belong together.
    fn checked(self) -> Result<Self, TrajectoryError> {
        let (name, rows) = (&self.name, self.times.len());
        let wrong = |message: String| Err(TrajectoryError::Rows(format!("{name}: {message}")));
        if rows == 0 {
            return wrong("no states".into());
        }
        if let Some(row) = self.times.iter().position(|time| !time.is_finite()) {
            return wrong(format!("time is {} in row {row}", self.times[row]));
        }
        if let Some(row) = self.times.windows(2).position(|pair| pair[0] > pair[1]) {
            return wrong(format!("time does not go on from row {row} to row {}", row + 1));
        }
        for Part { name: part, width, values } in &self.parts {
            if values.len() != rows * width {
                return wrong(format!(
                    "{part} has {} numbers; the model takes {width} in each of {rows} rows: is it of this model?",
                    values.len()
                ));
            }
            if let Some(at) = values.iter().position(|x| !x.is_finite()) {
                return wrong(format!("{part} is {} in row {}", values[at], at / width));
            }
        }
        Ok(self)
    }

    /// Where it comes from.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of states, at least one.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Never.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// Time of a state \[s\]; of the last one for rows behind it.
    pub fn time(&self, row: usize) -> f64 {
        self.times[row.min(self.times.len() - 1)]
    }

    /// The state that lies nearest to a time.
    pub fn nearest(&self, time: f64) -> usize {
        let after = self.times.partition_point(|&t| t < time);
        let before = after.saturating_sub(1);
        if (self.time(after) - time).abs() < (self.time(before) - time).abs() {
            after.min(self.len() - 1)
        } else {
            before
        }
    }

    /// The positions of a state, `[nq]`.
    pub fn qpos(&self, row: usize) -> &[f64] {
        let part = self.parts.iter().find(|part| part.name == "qpos");
        part.map_or(&[], |part| &part.values[row * part.width..(row + 1) * part.width])
    }

    /// Whether these are states of a model of these sizes.
    pub fn fits(&self, model: &Model) -> bool {
        let all = widths(model);
        self.parts.iter().all(|part| all.contains(&(part.name, part.width)))
    }

    /// Writes a state into `data`, which a forward pass must evaluate then. What was not recorded stays.
    ///
    /// # Panics
    /// There is no such row, or `data` is of a model that the trajectory does not fit.
    pub fn write(&self, row: usize, data: &mut Data) {
        let state = &mut data.state;
        state.time = self.times[row];
        for Part { name, width, values } in &self.parts {
            let to = match *name {
                "qpos" => &mut state.qpos[..],
                "qvel" => &mut state.qvel[..],
                "act" => &mut state.act[..],
                "ctrl" => &mut state.ctrl[..],
                "mocap_pos" => state.mocap_pos.as_flattened_mut(),
                _ => state.mocap_quat.as_flattened_mut(),
            };
            to.copy_from_slice(&values[row * width..(row + 1) * width]);
        }
    }
}

impl fmt::Display for TrajectoryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TrajectoryError::Archive(error) => write!(f, "{error}"),
            TrajectoryError::Episode(error) => write!(f, "{error}"),
            TrajectoryError::Rows(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for TrajectoryError {}
