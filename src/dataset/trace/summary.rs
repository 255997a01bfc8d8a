//! What is in a recording.

use super::error::TraceError;
use super::layout::Layout;
use super::reader::{Entry, EntryType, TraceReader};

/// A recording.
#[derive(Clone, Debug)]
pub struct Summary {
    /// Texts that describe the file.
    pub attributes: Vec<(String, String)>,
    /// Its trials, in order.
    pub trials: Vec<TrialSummary>,
}

/// A trial.
#[derive(Clone, Debug)]
pub struct TrialSummary {
    /// Name.
    pub name: String,
    /// Layout, if it is one of the two.
    pub layout: Option<Layout>,
    /// Rows of most datasets.
    pub rows: usize,
    /// Rows in which `env_infos/solved` is true, if there is one; of RoboSet's `config/solved`, one row.
    pub solved: Option<usize>,
    /// Its datasets, sorted by key.
    pub columns: Vec<ColumnSummary>,
}

/// A dataset.
#[derive(Clone, Debug)]
pub struct ColumnSummary {
    /// Name inside of the trial.
    pub key: String,
    /// Lengths of the axes.
    pub shape: Vec<usize>,
    /// Type of the elements.
    pub kind: EntryType,
    /// Least and largest number that is not NaN; `None` without such a number.
    pub range: Option<(f64, f64)>,
    /// How many are NaN.
    pub nans: usize,
    /// The first text.
    pub text: Option<String>,
}

/// Reads all of a recording, in memory that does not grow with it, and says what is in it.
///
/// # Errors
/// The file is damaged.
pub fn summarise(trace: &TraceReader) -> Result<Summary, TraceError> {
    let trials = trace.trials().iter().map(|name| trial(trace, name)).collect::<Result<_, _>>()?;
    Ok(Summary { attributes: trace.attributes()?, trials })
}

fn trial(trace: &TraceReader, name: &str) -> Result<TrialSummary, TraceError> {
    let entries = trace.entries(name)?;
    let layout = Layout::of(entries.iter().map(|entry| &entry.key[..]));
    let mut columns = Vec::new();
    let mut solved = None;
    for entry in &entries {
        let (column, nonzero) = column(trace, entry)?;
        if ["env_infos/solved", "config/solved"].contains(&&entry.key[..]) {
            solved = Some(nonzero);
        }
        columns.push(column);
    }
    Ok(TrialSummary { name: name.to_owned(), layout, rows: rows(&entries), solved, columns })
}

/// The number of rows that most datasets have; of two equally frequent ones the larger.
pub(super) fn rows(entries: &[Entry]) -> usize {
    let lengths: Vec<usize> = entries.iter().filter_map(|entry| entry.shape.first().copied()).collect();
    let frequency = |rows: usize| lengths.iter().filter(|&&other| other == rows).count();
    lengths.iter().copied().max_by_key(|&rows| (frequency(rows), rows)).unwrap_or(0)
}

/// A dataset, and how many of its numbers are not zero.
fn column(trace: &TraceReader, entry: &Entry) -> Result<(ColumnSummary, usize), TraceError> {
    let mut out = ColumnSummary {
        key: entry.key.clone(),
        shape: entry.shape.clone(),
        kind: entry.kind.clone(),
        range: None,
        nans: 0,
        text: None,
    };
    let mut nonzero = 0;
    match entry.kind {
        EntryType::Text => out.text = trace.texts(entry)?.into_iter().next(),
        EntryType::Other(_) => {}
        EntryType::Number(_) => {
            let step = entry.rows_together();
            for start in (0..entry.rows()).step_by(step) {
                let rows = start..(start + step).min(entry.rows());
                for x in trace.rows(entry, rows)?.values.to_f64() {
                    if x.is_nan() {
                        out.nans += 1;
                        continue;
                    }
                    nonzero += usize::from(x != 0.0);
                    let (low, high) = out.range.unwrap_or((x, x));
                    out.range = Some((low.min(x), high.max(x)));
                }
            }
        }
    }
    Ok((out, nonzero))
}
