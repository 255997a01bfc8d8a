//! Making a dataset of a recording.

use super::frames::{Frames, Pictures};
use super::writer::{LeRobotWriter, Settings, whole_rate};
use crate::episode::Episode;
use crate::exported::{Exported, in_trial};
use crate::progress::{Progress, STOPPED};
use dataset::trace::{TraceError, TraceReader};
use dataset::{Array, Values};
use std::path::PathBuf;

/// The folder of a trial's infos that holds what cameras saw.
const VISUALS: &str = "visual_dict/";

/// The dataset that a recording is made into.
#[derive(Clone, Debug)]
pub struct Target {
    /// Its folder.
    pub root: PathBuf,
    /// What the episodes are attempts at, in words; the id of the environment if nothing is said.
    pub task: Option<String>,
    /// The robot, in a word.
    pub robot: Option<String>,
    /// Frames a second; as recorded if nothing is said.
    pub frames_per_second: Option<f64>,
    /// Where pictures are kept.
    pub pictures: Pictures,
}

/// Makes a dataset of all trials of a recording in RoboHive's layout.
///
/// # Errors
/// The folder exists, a trial has no steps or lacks a name, the times of a trial are not equally far apart, reading or writing
/// fails, or the caller stopped it.
pub fn export(trace: &TraceReader, target: &Target, progress: Progress) -> Result<Exported, TraceError> {
    let names = trace.trials();
    let Some(first) = names.first() else {
        return Err(TraceError::new(trace.path(), "", "the recording has no trials"));
    };
    let frames_per_second = match target.frames_per_second {
        Some(rate) => rate,
        None => rate(&Episode::of_trial(trace, first)?)
            .map_err(|message| TraceError::new(trace.path(), format!("{first}/time"), message))?,
    };
    let settings =
        Settings::new(frames_per_second).with_robot(target.robot.clone()).with_pictures(target.pictures);
    let task = match &target.task {
        Some(task) => task.clone(),
        None => {
            let named = trace.attributes()?.into_iter().find(|(name, _)| name == "env");
            named.map_or_else(|| "unknown".to_owned(), |(_, id)| id)
        }
    };
    let mut writer = LeRobotWriter::create(&target.root, settings)?;
    let mut out = Exported { folder: target.root.clone(), ..Exported::default() };
    for (i, name) in names.iter().enumerate() {
        let mut episode = Episode::of_trial(trace, name)?;
        out.note(std::mem::take(&mut episode.dropped));
        out.steps += episode.steps();
        let (frames, dropped) = frames(episode, &task);
        out.note(dropped);
        let named = |e: TraceError| in_trial(trace.path(), name, e);
        writer.add(&frames).map_err(named)?;
        out.episodes += 1;
        if !progress(i + 1, names.len()) {
            return Err(TraceError::new(trace.path(), &name[..], STOPPED));
        }
    }
    writer.finish()?;
    Ok(out)
}

/// States a second.
fn rate(episode: &Episode) -> Result<f64, String> {
    let [first, .., last] = episode.times[..] else {
        return Err("missing: say how many frames a second there are".into());
    };
    let rate = episode.steps() as f64 / (last - first);
    let even = |pair: &[f64]| ((pair[1] - pair[0]) * rate - 1.0).abs() < 0.01;
    if !rate.is_finite() || rate <= 0.0 || !episode.times.windows(2).all(even) {
        return Err("its steps differ: say how many frames a second there are".into());
    }
    // Rounding of times in the recording is no part of the rate.
    Ok(whole_rate(rate))
}

/// The frames of an episode, and the datasets that have no place in them, with the reason. Features: `observation.state`, `observation.images.CAMERA`,
/// `action`, `next.reward`, `next.done`, `next.success` if the task reports it; for a teleoperated episode also `intervention` (the person
/// acted) and `judged_success` (the same in all frames).
pub fn frames(episode: Episode, task: &str) -> (Frames, Vec<(String, String)>) {
    let steps = episode.steps();
    let mut features = vec![
        ("observation.state".to_owned(), single(&episode.observations, 0, steps)),
        ("action".to_owned(), single(&episode.actions, 0, steps)),
    ];
    let mut dropped = Vec::new();
    let mut success = None;
    for (key, array) in &episode.infos {
        let pictures =
            matches!(&array.values, Values::U8(_)) && array.shape.len() == 4 && array.shape[3] == 3;
        if let (Some(visual), true) = (key.strip_prefix(VISUALS), pictures) {
            // As in `rgb:left_cam:8x12:2d`.
            let camera = visual.split(':').nth(1).unwrap_or(visual).replace('/', ".");
            features.push((format!("observation.images.{camera}"), rows(array, 0, steps)));
        } else if key == "solved" {
            success = Some(flags(&array.values.to_f64()[1..]));
        } else if key == "intervention" {
            features.push((key.clone(), flags(&array.values.to_f64()[..steps])));
        } else {
            dropped.push((format!("env_infos/{key}"), "no feature of a frame".to_owned()));
        }
    }
    features.push(("next.reward".to_owned(), single(&episode.rewards, 0, steps)));
    features.push(("next.done".to_owned(), episode.terminations));
    features.extend(success.map(|array| ("next.success".to_owned(), array)));
    let judged = episode.judged.map(|success| flags(&vec![f64::from(u8::from(success)); steps]));
    features.extend(judged.map(|array| ("judged_success".to_owned(), array)));
    (Frames { features, task: task.to_owned() }, dropped)
}

/// A feature of booleans, one for each frame.
fn flags(values: &[f64]) -> Array {
    let flags = values.iter().map(|&x| x != 0.0).collect();
    Array { shape: vec![values.len()], values: Values::Bool(flags) }
}

/// Rows of an array.
fn rows(array: &Array, start: usize, end: usize) -> Array {
    let width = array.shape[1..].iter().product::<usize>() * array.values.dtype().bytes();
    let mut bytes = Vec::new();
    array.values.put_bytes(&mut bytes);
    let shape = [&[end - start], &array.shape[1..]].concat();
    Array { shape, values: Values::from_bytes(array.values.dtype(), &bytes[start * width..end * width]) }
}

/// Rows of an array in single precision.
fn single(array: &Array, start: usize, end: usize) -> Array {
    let rows = rows(array, start, end);
    let values = rows.values.to_f64().into_iter().map(|x| x as f32).collect();
    Array { shape: rows.shape, values: Values::F32(values) }
}
