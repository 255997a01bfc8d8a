//! What each iteration was like: rows with the columns of AgentHive's logs, as CSV and as lines of JSON.

use crate::error::PolicyError;
use crate::learn::{Iteration, Learner};
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

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
}

/// Both files, open at their ends.
pub(super) struct Log {
    csv: (PathBuf, File),
    json: (PathBuf, File),
}

impl Log {
    /// Opens the files of a folder with their first `rows` rows; what follows these is left out.
    pub fn open(folder: &Path, rows: u64) -> Result<Self, PolicyError> {
        let header = format!("{}\n", COLUMNS.join(","));
        Ok(Log {
            csv: begin(folder.join("log.csv"), &header, rows)?,
            json: begin(folder.join("log.jsonl"), "", rows)?,
        })
    }

    /// Adds a row.
    pub fn add(&mut self, row: &Row) -> Result<(), PolicyError> {
        let numbers: Vec<String> = row.0.iter().map(f64::to_string).collect();
        append(&mut self.csv, &format!("{}\n", numbers.join(",")))?;
        let pairs: serde_json::Map<String, serde_json::Value> =
            COLUMNS.iter().zip(row.0).map(|(name, number)| ((*name).to_owned(), number.into())).collect();
        append(&mut self.json, &format!("{}\n", serde_json::Value::Object(pairs)))
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
        let unfinished = path.with_extension("unfinished");
        std::fs::write(&unfinished, kept)?;
        std::fs::rename(&unfinished, &path)?;
        OpenOptions::new().append(true).open(&path)
    };
    match open() {
        Ok(file) => Ok((path, file)),
        Err(error) => Err(PolicyError::run(&path, error)),
    }
}

fn append((path, file): &mut (PathBuf, File), line: &str) -> Result<(), PolicyError> {
    file.write_all(line.as_bytes()).map_err(|error| PolicyError::run(path, error))
}
