//! Recordings from one layout, format or precision to another.

use super::error::TraceError;
use super::layout::Layout;
use super::precision::Precision;
use super::reader::{Entry, EntryType, TraceReader};
use super::recorder::{Recorder, Trial, is_npz};
use super::routes::Translation;
use super::summary::rows;
use std::path::Path;

/// What a recording is made into; the ending of its path says whether it is HDF5 or a numpy archive.
#[derive(Clone, Copy, Debug, Default)]
pub struct Target {
    /// Layout; by default the input's.
    pub layout: Option<Layout>,
    /// Precision.
    pub precision: Precision,
}

/// What came of a conversion.
#[derive(Clone, Debug, Default)]
pub struct Converted {
    /// Trials that were written.
    pub trials: usize,
    /// Datasets that have no place in the output, and why. Of equal ones in several trials, one.
    pub dropped: Vec<(String, String)>,
}

/// Writes the trials of a recording to a new file at `path`.
///
/// # Errors
/// Reading or writing fails, a number does not fit the precision, or a trial has a layout that cannot be translated.
pub fn convert(trace: &TraceReader, path: &Path, target: Target) -> Result<Converted, TraceError> {
    let attributes = trace.attributes()?;
    let attributes: Vec<(&str, &str)> =
        attributes.iter().map(|(name, text)| (&name[..], &text[..])).collect();
    let translation = translation(trace, target)?;
    let mut recorder = Recorder::translating(path, translation, target.precision, &attributes)?;
    let mut out = Converted::default();
    if is_npz(path) {
        out.dropped.extend(
            attributes.iter().map(|(name, _)| {
                (format!("attribute {name}"), "numpy archives hold no attributes".to_owned())
            }),
        );
    }
    for name in trace.trials() {
        copy_trial(trace, name, &mut recorder, is_npz(path), &mut out)?;
        out.trials += 1;
    }
    let place = match target.layout {
        Some(layout) => format!("no place in {}'s layout", layout.name()),
        None => String::new(),
    };
    out.dropped.extend(recorder.unmapped().map(|key| (key.to_owned(), place.clone())));
    recorder.close()?;
    Ok(out)
}

/// How names change: all trials must have one layout, if it does.
fn translation(trace: &TraceReader, target: Target) -> Result<Translation, TraceError> {
    let Some(wanted) = target.layout else { return Ok(Translation::None) };
    let mut found = None;
    for name in trace.trials() {
        let layout = trace.layout(name)?.ok_or_else(|| {
            let message = format!(
                "its layout is neither RoboHive's nor RoboSet's: it cannot be made {}'s",
                wanted.name()
            );
            TraceError::new(trace.path(), &name[..], message)
        })?;
        if *found.get_or_insert(layout) != layout {
            return Err(TraceError::new(
                trace.path(),
                &name[..],
                "its layout is not that of the trials before",
            ));
        }
    }
    Ok(match (found.unwrap_or(wanted), wanted) {
        (Layout::RoboHive, Layout::RoboSet) => Translation::ToRoboSet,
        (Layout::RoboSet, Layout::RoboHive) => Translation::ToRoboHive,
        _ => Translation::None,
    })
}

/// Copies a trial; `plain` files hold no texts.
pub(super) fn copy_trial(
    trace: &TraceReader,
    name: &str,
    recorder: &mut Recorder,
    plain: bool,
    out: &mut Converted,
) -> Result<(), TraceError> {
    let entries = trace.entries(name)?;
    let common = rows(&entries);
    let mut trial = recorder.begin(name)?;
    let mut drop = |key: &str, why: String| {
        if !out.dropped.iter().any(|(dropped, _)| dropped == key) {
            out.dropped.push((key.to_owned(), why));
        }
    };
    for entry in &entries {
        match &entry.kind {
            EntryType::Number(_) => copy_numbers(trace, entry, common, &mut trial)?,
            EntryType::Text if plain => drop(&entry.key, "numpy archives hold no texts".into()),
            EntryType::Text => trial.set_text(&entry.key, &entry.shape, &trace.texts(entry)?)?,
            EntryType::Other(kind) => drop(&entry.key, format!("elements of type {kind} are not read")),
        }
    }
    trial.finish()
}

/// Copies a dataset as rows, if it has as many as the trial.
fn copy_numbers(
    trace: &TraceReader,
    entry: &Entry,
    common: usize,
    trial: &mut Trial,
) -> Result<(), TraceError> {
    if entry.shape.first() != Some(&common) {
        return trial.set(&entry.key, &trace.read(entry)?);
    }
    // Also without rows there is a column.
    let step = entry.rows_together();
    for start in (0..common.max(1)).step_by(step) {
        let rows = start.min(common)..(start + step).min(common);
        trial.push_rows(&entry.key, &trace.rows(entry, rows)?)?;
    }
    Ok(())
}
