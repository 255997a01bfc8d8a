//! Writing a dataset, episode by episode.

use super::id::DatasetId;
use super::metadata::About;
use crate::json;
use dataset::Array;
use dataset::trace::{Layout, Precision, Recorder, TraceError};
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

/// The file of a folder of datasets that makes it one.
const FOLDER: &str = "namespace_metadata.json";

/// Names and rows of an episode: `observations`, `actions`, `rewards`, `terminations`, `truncations`, and `infos/…`;
/// observations and actions may be several, as in `observations/image`.
pub type Columns = [(String, Array)];

/// A dataset that is being written. It can be loaded after every episode, whatever ends the process then.
pub struct MinariWriter {
    folder: PathBuf,
    recorder: Recorder,
    metadata: Map<String, Value>,
    episodes: u64,
    steps: u64,
    /// Keys of the first episode with the shapes of their rows.
    form: Vec<(String, Vec<usize>)>,
}

impl MinariWriter {
    /// Makes a dataset in `root`, the folder that `MINARI_DATASETS_PATH` names.
    ///
    /// # Errors
    /// The dataset exists, or cannot be written.
    pub fn create(root: &Path, id: &DatasetId, about: &About) -> Result<Self, TraceError> {
        let at = root.join(id.as_str());
        let fail = |message: String| TraceError::new(&at, "", message);
        if at.exists() {
            return Err(fail("the dataset exists: delete it, or choose another name or version".into()));
        }
        let metadata = about.entries(id.as_str()).map_err(fail)?;
        let folder = at.join("data");
        std::fs::create_dir_all(&folder).map_err(|e| fail(e.to_string()))?;
        for namespace in id.folders() {
            let path = root.join(namespace).join(FOLDER);
            if !path.exists() {
                json::write(&path, &Value::Object(Map::new()))?;
            }
        }
        let file = folder.join("main_data.hdf5");
        let recorder = Recorder::create(&file, Layout::RoboHive, Precision::Full)?;
        let mut out = MinariWriter { folder, recorder, metadata, episodes: 0, steps: 0, form: Vec::new() };
        out.describe()?;
        Ok(out)
    }

    /// The folder that holds the files.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Episodes so far.
    pub fn episodes(&self) -> u64 {
        self.episodes
    }

    /// Adds an episode; see [`Columns`].
    ///
    /// # Errors
    /// A name is missing or has rows of another number or shape, or writing fails; the dataset is as before.
    pub fn add(&mut self, columns: &Columns, seed: Option<i64>) -> Result<(), TraceError> {
        let name = format!("episode_{}", self.episodes);
        let file = self.folder.join("main_data.hdf5");
        let fail = |(key, message): (String, String)| {
            TraceError::new(
                &file,
                if key.is_empty() { name.clone() } else { format!("{name}/{key}") },
                message,
            )
        };
        let steps = check(columns).map_err(fail)?;
        let form = form(columns);
        if self.episodes > 0 {
            self.compare(&form).map_err(fail)?;
        }
        let mut trial = self.recorder.begin(&name)?;
        trial.set_attribute("id", self.episodes as i64)?;
        if let Some(seed) = seed {
            trial.set_attribute("seed", seed)?;
        }
        trial.set_attribute("total_steps", steps as i64)?;
        columns.iter().try_for_each(|(key, array)| trial.set_series(key, array.clone()))?;
        if !columns.iter().any(|(key, _)| kind(key) == "infos") {
            // Minari prints the names of infos, also where there are none.
            trial.set_group("infos")?;
        }
        trial.finish()?;
        self.form = form;
        self.episodes += 1;
        self.steps += steps as u64;
        self.describe()
    }

    /// Completes the dataset, and waits until the disk has it.
    ///
    /// # Errors
    /// Writing fails.
    pub fn close(self) -> Result<(), TraceError> {
        self.recorder.close()
    }

    /// Observations and actions keep their names and shapes, which the spaces give; infos need not.
    fn compare(&self, form: &[(String, Vec<usize>)]) -> Result<(), (String, String)> {
        if let Some((key, _)) = self.form.iter().find(|(key, _)| !form.iter().any(|(other, _)| other == key))
        {
            return Err((key.clone(), "missing, but the episodes before have it".into()));
        }
        for (key, row) in form {
            let Some((_, before)) = self.form.iter().find(|(other, _)| other == key) else {
                return Err((key.clone(), "the episodes before do not have it".into()));
            };
            if before != row {
                return Err((
                    key.clone(),
                    format!("rows of shape {row:?}, {before:?} in the episodes before"),
                ));
            }
        }
        Ok(())
    }

    fn describe(&mut self) -> Result<(), TraceError> {
        let file = self.folder.join("main_data.hdf5");
        let bytes = std::fs::metadata(&file).map_err(|e| TraceError::new(&file, "", e))?.len();
        self.metadata["total_episodes"] = self.episodes.into();
        self.metadata["total_steps"] = self.steps.into();
        // Megabytes, to a tenth.
        self.metadata.insert("dataset_size".into(), ((bytes as f64 / 1e5).round() / 10.0).into());
        json::write(&self.folder.join("metadata.json"), &Value::Object(self.metadata.clone()))
    }
}

/// The first part of a key.
fn kind(key: &str) -> &str {
    key.split('/').next().unwrap_or(key)
}

/// Keys of observations and actions, with the shapes of their rows.
fn form(columns: &Columns) -> Vec<(String, Vec<usize>)> {
    let spaces = columns.iter().filter(|(key, _)| ["observations", "actions"].contains(&kind(key)));
    spaces.map(|(key, array)| (key.clone(), array.shape[1..].to_vec())).collect()
}

/// The steps of an episode whose names are complete and have as many rows as they should.
fn check(columns: &Columns) -> Result<usize, (String, String)> {
    for required in ["observations", "actions", "rewards", "terminations", "truncations"] {
        if !columns.iter().any(|(key, _)| kind(key) == required) {
            return Err((required.to_owned(), "missing: every episode has it".into()));
        }
    }
    if let Some((key, _)) = columns.iter().find(|(_, array)| array.shape.is_empty()) {
        return Err((key.clone(), "a scalar has no rows".into()));
    }
    let rewards = columns.iter().find(|(key, _)| key == "rewards");
    let Some((_, rewards)) = rewards else {
        return Err(("rewards".into(), "missing: every episode has it".into()));
    };
    let steps = rewards.shape[0];
    if steps == 0 {
        return Err((String::new(), "an episode has a step at least".into()));
    }
    for (key, array) in columns {
        let expected = match kind(key) {
            "observations" | "infos" => steps + 1,
            "actions" | "rewards" | "terminations" | "truncations" => steps,
            _ => return Err((key.clone(), "no name of Minari's: put it under infos/".into())),
        };
        if array.shape[0] != expected {
            let message = format!("{} rows: an episode of {steps} steps has {expected}", array.shape[0]);
            return Err((key.clone(), message));
        }
        if ["rewards", "terminations", "truncations"].contains(&&key[..]) && array.shape.len() != 1 {
            return Err((key.clone(), format!("shape {:?}: a step has one number", array.shape)));
        }
    }
    Ok(steps)
}
