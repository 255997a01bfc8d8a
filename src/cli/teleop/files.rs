//! The files of finished episodes: a recording, or a LeRobot dataset.

use super::arguments::{RecordForm, Teleop};
use crate::failure::Failure;
use crate::input::library::Source;
use crate::output::{check_place, note_unmapped, recording_file};
use crate::terminal::{listed, note, show};
use ::teleop::Session;
use dataset::trace::TraceError;
use exchange::Episode;
use exchange::lerobot::{Frames, LeRobotWriter, Settings, frames};
use record::{Kept, Recording};
use std::path::{Path, PathBuf};

/// Files that contain every added episode, even if the process is killed.
pub enum Files {
    /// A recording in a file.
    Recording(Recording),
    /// A LeRobot dataset in a folder, with the description of its task and the number of earlier episodes.
    Dataset { writer: Box<LeRobotWriter>, root: PathBuf, task: String, before: usize },
}

/// Checks that the path fits the layout.
///
/// # Errors
/// A file for a dataset, or another file name than a recording's.
pub fn check(a: &Teleop) -> Result<(), Failure> {
    let Some(path) = &a.record else { return Ok(()) };
    let is_file = recording_file(&path.to_string_lossy());
    match a.layout {
        RecordForm::Dataset if is_file.is_ok() => Err(Failure::usage(format!(
            "{}: --layout lerobot writes a folder: remove the extension",
            path.display()
        ))),
        RecordForm::Dataset => Ok(()),
        _ if a.task.is_some() => Err(Failure::usage("--task applies only to --layout lerobot")),
        _ => {
            is_file.map_err(|message| {
                Failure::usage(format!("{}: {message}; --layout lerobot writes a folder", path.display()))
            })?;
            check_place(path)
        }
    }
}

impl Files {
    /// Opens the files that the arguments name. An existing dataset is extended, if the session's episodes fit it.
    ///
    /// # Errors
    /// The files cannot be written, or the episodes do not fit.
    pub fn open(a: &Teleop, source: &Source, session: &mut Session) -> Result<Option<Self>, Failure> {
        let Some(path) = a.record.as_deref() else { return Ok(None) };
        let RecordForm::File(layout) = a.layout else {
            return dataset(a, path, source, session).map(Some);
        };
        let settings = source.making.changes()?.to_string();
        let (compat, seed) = (source.making.compat.to_string(), a.seed.to_string());
        let device = a.device.to_string();
        let attributes = [
            (record::ID, &source.id[..]),
            (record::COMPAT, &compat),
            (record::SETTINGS, settings.trim_end()),
            ("policy", a.policy.as_deref().unwrap_or("teleop")),
            ("device", &device),
            ("seed", &seed),
        ];
        let recording = Recording::create(path, layout.into(), a.precision.into(), &attributes)?;
        Ok(Some(Files::Recording(recording)))
    }

    /// Adds an episode.
    ///
    /// # Errors
    /// Writing fails.
    pub fn add(&mut self, kept: &Kept) -> Result<(), Failure> {
        match self {
            Files::Recording(recording) => Ok(recording.add(kept)?),
            Files::Dataset { writer, root, task, .. } => {
                // What has no place was named when the dataset was opened.
                let (frames, _) = frames_of(kept, root, task)?;
                writer.add(&frames).map_err(Failure::new)
            }
        }
    }

    /// Completes the files, and returns a summary.
    ///
    /// # Errors
    /// Writing fails.
    pub fn close(self) -> Result<Closed, Failure> {
        match self {
            Files::Recording(recording) => {
                let (path, episodes, unmapped) = recording.close()?;
                Ok(Closed { path, episodes, unmapped, total: None })
            }
            Files::Dataset { writer, root, before, .. } => {
                let total = writer.episodes();
                writer.finish().map_err(Failure::new)?;
                Ok(Closed { path: root, episodes: total - before, unmapped: Vec::new(), total: Some(total) })
            }
        }
    }
}

/// Summary of the files that were written.
pub struct Closed {
    path: PathBuf,
    episodes: usize,
    /// Names without a place in the layout.
    unmapped: Vec<String>,
    /// Episodes of a dataset, those of earlier sessions among them.
    total: Option<usize>,
}

impl Closed {
    /// Prints the summary.
    pub fn show(&self) {
        note_unmapped(&self.unmapped);
        let total = self.total.map_or_else(String::new, |total| format!(", which has {total}"));
        show!("recorded     {} episodes in {}{total}", self.episodes, self.path.display());
    }
}

/// Opens the LeRobot dataset for the session's episodes.
fn dataset(a: &Teleop, path: &Path, source: &Source, session: &mut Session) -> Result<Files, Failure> {
    let root = path.components().collect::<PathBuf>();
    let task = a.task.clone().unwrap_or_else(|| source.id.clone());
    let settings = Settings::of_period(session.env().dt()).with_pictures(a.pictures.into());
    let writer = LeRobotWriter::grow(&root, settings).map_err(Failure::new)?;
    let (frames, dropped) = frames_of(&session.example()?, &root, &task)?;
    writer.check(&frames).map_err(Failure::new)?;
    let dropped: Vec<String> = dropped.into_iter().map(|(key, _)| key).collect();
    if !dropped.is_empty() {
        note(&format!("not recorded, because frames have no feature for: {}", listed(&dropped, 4)));
    }
    Ok(Files::Dataset { before: writer.episodes(), writer: Box::new(writer), root, task })
}

/// The frames of an episode, and the datasets that have no place in them.
fn frames_of(kept: &Kept, root: &Path, task: &str) -> Result<(Frames, Vec<(String, String)>), Failure> {
    let episode = Episode::of_arrays("episode", kept.arrays())
        .map_err(|(key, message)| Failure::new(TraceError::new(root, key, message)))?;
    Ok(frames(episode, task))
}
