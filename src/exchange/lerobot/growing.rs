//! Datasets that are complete after every episode, and those that more episodes are added to.

use super::features::{Feature, NUMBERING};
use super::reader::LeRobotReader;
use super::series::{CHUNK_FILES, Series, file_name};
use super::stats::Stats;
use super::writer::{LeRobotWriter, Settings, lock};
use crate::json;
use dataset::trace::TraceError;
use serde_json::Value;
use std::path::Path;

impl LeRobotWriter {
    /// Begins a dataset that is complete after every episode, so that a killed process loses no added episode; an existing
    /// dataset is extended. Each episode then has its own files.
    ///
    /// # Errors
    /// The folder contains something else, or a dataset with another frame rate, or one that lacks files or cannot be read;
    /// it cannot be written, or another process writes it. Episodes with other features are refused when they are checked or added.
    pub fn grow(root: &Path, settings: Settings) -> Result<Self, TraceError> {
        if !root.exists() {
            let mut writer = LeRobotWriter::create(root, settings)?;
            writer.grows = true;
            return Ok(writer);
        }
        if !root.join("meta/info.json").is_file() {
            let message = "the folder exists and is not a LeRobot dataset: choose another one";
            return Err(TraceError::new(root, "", message));
        }
        let _lock = lock(root)?;
        let reader = LeRobotReader::open(root)?;
        if let Some(path) = reader.files()?.iter().find(|path| !path.is_file()) {
            let message = "the file is missing, so the dataset cannot be extended: restore it, or choose another folder";
            return Err(TraceError::new(path, "", message));
        }
        let (frames, data, table) = reader.end();
        let writer = LeRobotWriter {
            root: root.to_owned(),
            folder: root.to_owned(),
            grows: true,
            features: features(root, &reader, &settings)?,
            settings,
            tasks: reader.tasks(),
            stats: stats(root, &reader)?,
            data: Series::new(root.join("data"), data),
            table: Series::new(root.join("meta/episodes"), table),
            episodes: reader.episodes(),
            frames,
            _lock,
        };
        writer.drop_torn(data, table)?;
        Ok(writer)
    }

    /// Removes the tables of an episode that a killed process had not yet added to the index.
    fn drop_torn(&self, data: usize, table: usize) -> Result<(), TraceError> {
        for (folder, number) in [("data", data), ("meta/episodes", table)] {
            for ending in ["parquet", "parquet.new"] {
                let path = self.root.join(folder).join(file_name(number)).with_extension(ending);
                if path.exists() {
                    std::fs::remove_file(&path).map_err(|e| TraceError::new(&path, "", e))?;
                }
            }
        }
        Ok(())
    }
}

/// The features of an existing dataset that fits the settings, without the columns that number its frames.
fn features(root: &Path, reader: &LeRobotReader, settings: &Settings) -> Result<Vec<Feature>, TraceError> {
    let fail = |object: &str, message: String| TraceError::new(root, object, message);
    let number = |name: &str| reader.info().get(name).and_then(Value::as_f64);
    let rate = number("fps").unwrap_or(f64::NAN);
    if rate != settings.frames_per_second {
        let message = format!(
            "{rate} frames a second, and the new episodes have {}: choose another folder",
            settings.frames_per_second
        );
        return Err(fail("fps", message));
    }
    if number("chunks_size") != Some(CHUNK_FILES as f64) {
        return Err(fail(
            "chunks_size",
            format!("only datasets with chunks of {CHUNK_FILES} files can be extended"),
        ));
    }
    let names = reader.info().get("features").and_then(Value::as_object);
    let unknown = names.into_iter().flatten().find(|(name, _)| {
        let known = |feature: &Feature| feature.name == **name;
        !reader.features().iter().any(known)
    });
    if let Some((name, entry)) = unknown {
        return Err(fail(name, format!("features of type {} cannot be written", entry["dtype"])));
    }
    let numbers = |feature: &&Feature| NUMBERING.iter().all(|(name, _)| *name != feature.name);
    Ok(reader.features().iter().filter(numbers).cloned().collect())
}

/// The statistics of an existing dataset.
fn stats(root: &Path, reader: &LeRobotReader) -> Result<Vec<(String, Stats)>, TraceError> {
    let path = root.join("meta/stats.json");
    let all = json::read(&path)?;
    let of = |feature: &Feature| {
        let stats = all.get(&feature.name).and_then(Stats::from_json);
        let stats = stats.ok_or_else(|| {
            TraceError::new(
                &path,
                &feature.name[..],
                "there are no statistics with quantiles, so the dataset cannot be extended",
            )
        })?;
        Ok((feature.name.clone(), stats))
    };
    reader.features().iter().map(of).collect()
}
