//! What each iteration was like: rows with the columns of AgentHive's logs, as CSV, as lines of JSON and as events for TensorBoard.

use super::events;
use crate::error::PolicyError;
use crate::learn::{Iteration, Learner};
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// TensorBoard reads what has `tfevents` in its name.
const EVENTS: &str = "events.out.tfevents.robohive";

/// Names of the columns.
pub const COLUMNS: [&str; 17] = [
    "iteration",
    "num_samples",
    "episodes",
    "stoc_pol_mean",
    "stoc_pol_std",
    "stoc_pol_max",
    "stoc_pol_min",
    "success_percentage",
    "rwd_sparse",
    "rwd_dense",
    "episode_length",
    "faults",
    "kl_dist",
    "entropy",
    "clipped",
    "vf_explained",
    "time",
];

/// A row: a number for each of [`COLUMNS`]. Its time \[s\] is the only one that differs from machine to machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row(pub [f64; COLUMNS.len()]);

impl Row {
    pub(super) fn new(learner: &Learner, iteration: &Iteration, seconds: f64) -> Self {
        let Iteration { evaluation, spread: [deviation, most, least], update, .. } = iteration;
        Row([
            learner.iterations as f64,
            learner.samples as f64,
            learner.episodes as f64,
            evaluation.reward,
            *deviation,
            *most,
            *least,
            evaluation.success_percentage,
            evaluation.rwd_sparse,
            evaluation.rwd_dense,
            iteration.length,
            iteration.faults as f64,
            update.divergence,
            update.entropy,
            update.clipped,
            iteration.explained,
            seconds,
        ])
    }

    /// The number of a column; NaN where there is none of this name.
    pub fn get(&self, column: &str) -> f64 {
        COLUMNS.iter().position(|name| *name == column).map_or(f64::NAN, |place| self.0[place])
    }

    /// The event of the row, at a wall time \[s\].
    fn event(&self, wall_time: f64) -> Vec<u8> {
        let tags = COLUMNS.map(|column| format!("{}/{column}", group(column)));
        let values = tags.iter().map(String::as_str).zip(self.0.map(|number| number as f32));
        events::scalars(wall_time, self.get("num_samples") as i64, values)
    }
}

/// Under which heading TensorBoard shows a column.
fn group(column: &str) -> &'static str {
    match column {
        "iteration" | "num_samples" | "episodes" | "time" => "time",
        "kl_dist" | "entropy" | "clipped" | "vf_explained" => "train",
        _ => "rollout",
    }
}

/// The files, open at their ends.
pub(super) struct Log {
    csv: (PathBuf, File),
    json: (PathBuf, File),
    events: (PathBuf, File),
    /// What the iterations so far took \[s\]: the wall time of events.
    seconds: f64,
}

impl Log {
    /// Opens the files of a folder with their first `rows` rows; what follows these is left out.
    pub fn open(folder: &Path, rows: u64) -> Result<Self, PolicyError> {
        let header = format!("{}\n", COLUMNS.join(","));
        let csv = begin(folder.join("log.csv"), &header, rows)?;
        let json = begin(folder.join("log.jsonl"), "", rows)?;
        let (mut content, mut seconds) = (events::version(), 0.0);
        for row in read(folder)? {
            seconds += row.get("time");
            content.extend(row.event(seconds));
        }
        let path = folder.join(EVENTS);
        let file = replace(&path, &content).map_err(|error| PolicyError::run(&path, error))?;
        Ok(Log { csv, json, events: (path, file), seconds })
    }

    /// Adds a row.
    pub fn add(&mut self, row: &Row) -> Result<(), PolicyError> {
        let numbers: Vec<String> = row.0.iter().map(f64::to_string).collect();
        append(&mut self.csv, format!("{}\n", numbers.join(",")).as_bytes())?;
        let pairs: serde_json::Map<String, serde_json::Value> =
            COLUMNS.iter().zip(row.0).map(|(name, number)| ((*name).to_owned(), number.into())).collect();
        append(&mut self.json, format!("{}\n", serde_json::Value::Object(pairs)).as_bytes())?;
        self.seconds += row.get("time");
        append(&mut self.events, &row.event(self.seconds))
    }
}

/// The rows of the log in a folder.
pub(super) fn read(folder: &Path) -> Result<Vec<Row>, PolicyError> {
    let path = folder.join("log.csv");
    let text = std::fs::read_to_string(&path).map_err(|error| PolicyError::run(&path, error))?;
    let mut lines = text.lines();
    if lines.next() != Some(&COLUMNS.join(",")) {
        return Err(PolicyError::run(&path, "its first line does not name the columns"));
    }
    let row = |(index, line): (usize, &str)| {
        let wrong = || {
            let message =
                format!("line {}: a row is {} numbers, and this is {line:?}", index + 2, COLUMNS.len());
            PolicyError::run(&path, message)
        };
        let numbers =
            line.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>().map_err(|_| wrong())?;
        numbers.try_into().map(Row).map_err(|_| wrong())
    };
    lines.enumerate().map(row).collect()
}

/// Opens a file with its header and its first `rows` lines after it.
fn begin(path: PathBuf, header: &str, rows: u64) -> Result<(PathBuf, File), PolicyError> {
    let open = || {
        let old = if rows == 0 { header.to_owned() } else { std::fs::read_to_string(&path)? };
        let wrong = |message: String| std::io::Error::other(message);
        let old = old
            .strip_prefix(header)
            .ok_or_else(|| wrong("its first line does not name the columns".into()))?;
        let lines = old.lines().take(rows as usize);
        let found = lines.clone().count() as u64;
        if found < rows {
            return Err(wrong(format!(
                "it has {found} rows, and the checkpoint is of iteration {rows}: restore the file"
            )));
        }
        let kept: String =
            std::iter::once(header.to_owned()).chain(lines.map(|line| format!("{line}\n"))).collect();
        replace(&path, kept.as_bytes())
    };
    match open() {
        Ok(file) => Ok((path, file)),
        Err(error) => Err(PolicyError::run(&path, error)),
    }
}

/// Gives a file another content at once, and opens it at its end.
fn replace(path: &Path, content: &[u8]) -> std::io::Result<File> {
    let unfinished = path.with_file_name("log.unfinished");
    std::fs::write(&unfinished, content)?;
    std::fs::rename(&unfinished, path)?;
    OpenOptions::new().append(true).open(path)
}

fn append((path, file): &mut (PathBuf, File), content: &[u8]) -> Result<(), PolicyError> {
    file.write_all(content).map_err(|error| PolicyError::run(path, error))
}
