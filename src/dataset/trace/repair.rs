//! Saving what is readable of a damaged recording.

use super::convert::{Converted, copy_trial};
use super::error::TraceError;
use super::layout::Layout;
use super::precision::Precision;
use super::reader::TraceReader;
use super::recorder::Recorder;
use crate::hdf5::file::Hdf5Reader;
use std::path::Path;

/// What came of a repair.
#[derive(Clone, Debug, Default)]
pub struct Repaired {
    /// Trials that were saved.
    pub saved: Vec<String>,
    /// Trials that are lost, and why.
    pub lost: Vec<(String, String)>,
    /// Datasets of saved trials that could not be written, and why.
    pub dropped: Vec<(String, String)>,
    /// What was wrong with the file as a whole, if anything.
    pub damage: Option<String>,
    /// Bytes behind the end of the file: of an episode that was never finished.
    pub unused: u64,
}

/// Writes the trials of the HDF5 file at `path` that are readable to a new file at `out`.
///
/// A recorder's file that is cut off, or whose beginning is damaged, still has the lists of trials that were current before;
/// the last one that is readable is used.
///
/// # Errors
/// Nothing of the file is readable, or writing fails.
pub fn repair(path: &Path, out: &Path) -> Result<Repaired, TraceError> {
    let mut report = Repaired::default();
    let trace = open(path, &mut report)?;
    let attributes = trace.attributes().unwrap_or_default();
    let attributes: Vec<(&str, &str)> =
        attributes.iter().map(|(name, text)| (&name[..], &text[..])).collect();
    let mut recorder = Recorder::create_with(out, Layout::RoboHive, Precision::Full, &attributes)?;
    let mut copied = Converted::default();
    for name in trace.trials() {
        match copy_trial(&trace, name, &mut recorder, false, &mut copied) {
            Ok(()) => report.saved.push(name.clone()),
            Err(error) if error.path == out => return Err(error),
            Err(error) => report.lost.push((name.clone(), error.to_string())),
        }
    }
    report.dropped = copied.dropped;
    recorder.close()?;
    Ok(report)
}

fn open(path: &Path, report: &mut Repaired) -> Result<TraceReader, TraceError> {
    let whole = Hdf5Reader::open(path);
    match whole {
        Ok(file) => {
            report.unused = file.unused();
            match TraceReader::hdf5(file) {
                Ok(trace) => return Ok(trace),
                Err(error) => report.damage = Some(error.message),
            }
        }
        Err(error) => report.damage = Some(error.message),
    }
    let damaged = Hdf5Reader::open_damaged(path).map_err(TraceError::from).and_then(TraceReader::hdf5);
    damaged.or_else(|error| {
        let earlier = Hdf5Reader::open_earlier(path).map_err(TraceError::from)?;
        earlier.ok_or(error).and_then(TraceReader::hdf5)
    })
}
