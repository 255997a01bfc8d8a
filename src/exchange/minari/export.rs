//! Making a dataset of a recording.

use super::id::DatasetId;
use super::metadata::{About, box_space};
use super::writer::MinariWriter;
use crate::episode::Episode;
use crate::exported::{Exported, in_trial};
use crate::progress::{Progress, STOPPED};
use dataset::Array;
use dataset::trace::{TraceError, TraceReader};
use serde_json::{Map, Value};
use std::path::PathBuf;

/// The dataset that a recording is made into.
#[derive(Clone, Debug)]
pub struct Target {
    /// The folder that `MINARI_DATASETS_PATH` names.
    pub root: PathBuf,
    /// Name of the dataset.
    pub id: DatasetId,
    /// Whether what is not observation, action or reward is kept, as infos.
    pub infos: bool,
    /// The JSON of a space of observations and of actions; without limits if nothing is said.
    pub spaces: [Option<String>; 2],
    /// The JSON of Gymnasium's `EnvSpec`.
    pub env_spec: Option<String>,
    /// Further entries of the metadata.
    pub more: Map<String, Value>,
}

/// Makes a dataset of all trials of a recording in RoboHive's layout. What was written is removed on errors.
///
/// # Errors
/// The dataset exists, a trial has no steps or lacks a name, reading or writing fails, or the caller stopped it.
pub fn export(trace: &TraceReader, target: &Target, progress: Progress) -> Result<Exported, TraceError> {
    let at = target.root.join(target.id.as_str());
    if at.exists() {
        let message = "the dataset exists: delete it, or choose another name or version";
        return Err(TraceError::new(&at, "", message));
    }
    write(trace, target, progress).inspect_err(|_| {
        // What remains would look like a whole dataset.
        _ = std::fs::remove_dir_all(&at);
    })
}

fn write(trace: &TraceReader, target: &Target, progress: Progress) -> Result<Exported, TraceError> {
    let names = trace.trials();
    let Some(first) = names.first() else {
        return Err(TraceError::new(trace.path(), "", "the recording has no trials"));
    };
    let about = about(&Episode::of_trial(trace, first)?, target);
    let mut writer = MinariWriter::create(&target.root, &target.id, &about)?;
    let mut out = Exported { folder: writer.folder().to_owned(), ..Exported::default() };
    for (i, name) in names.iter().enumerate() {
        let mut episode = Episode::of_trial(trace, name)?;
        out.note(std::mem::take(&mut episode.dropped));
        out.steps += episode.steps();
        let seed = episode.seed;
        let named = |e: TraceError| in_trial(trace.path(), name, e);
        writer.add(&columns(episode, target.infos), seed).map_err(named)?;
        out.episodes += 1;
        if !progress(i + 1, names.len()) {
            return Err(TraceError::new(trace.path(), &name[..], STOPPED));
        }
    }
    writer.close()?;
    Ok(out)
}

fn about(episode: &Episode, target: &Target) -> About {
    let unbounded = |array: &Array| {
        box_space(array.values.dtype(), &array.shape[1..], (f64::NEG_INFINITY, f64::INFINITY))
    };
    let [observations, actions] = &target.spaces;
    About {
        observation_space: observations.clone().unwrap_or_else(|| unbounded(&episode.observations)),
        action_space: actions.clone().unwrap_or_else(|| unbounded(&episode.actions)),
        env_spec: target.env_spec.clone(),
        more: target.more.clone(),
    }
}

fn columns(episode: Episode, infos: bool) -> Vec<(String, Array)> {
    let mut out = vec![
        ("observations".to_owned(), episode.observations),
        ("actions".to_owned(), episode.actions),
        ("rewards".to_owned(), episode.rewards),
        ("terminations".to_owned(), episode.terminations),
        ("truncations".to_owned(), episode.truncations),
    ];
    if infos {
        out.extend(episode.infos.into_iter().map(|(key, array)| (format!("infos/{key}"), array)));
    }
    out
}
