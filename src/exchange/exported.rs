//! What came of an export.

use dataset::trace::TraceError;
use std::path::{Path, PathBuf};

/// What came of an export.
#[derive(Clone, Debug, Default)]
pub struct Exported {
    /// Episodes that were written.
    pub episodes: usize,
    /// Steps of them.
    pub steps: usize,
    /// The folder that holds the dataset.
    pub folder: PathBuf,
    /// What has no place in the dataset, and why. Of equal ones in several trials, one.
    pub dropped: Vec<(String, String)>,
}

impl Exported {
    /// Notes what was not written.
    pub(crate) fn note(&mut self, dropped: impl IntoIterator<Item = (String, String)>) {
        for (key, why) in dropped {
            if !self.dropped.iter().any(|(other, _)| *other == key) {
                self.dropped.push((key, why));
            }
        }
    }
}

/// Says which trial an error of the output is about.
pub fn in_trial(path: &Path, trial: &str, error: TraceError) -> TraceError {
    TraceError { message: format!("{} (of {}, {trial:?})", error.message, path.display()), ..error }
}
