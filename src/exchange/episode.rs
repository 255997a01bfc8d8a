//! A trial of a recording as the transitions that learning programs expect.

use dataset::trace::{EntryType, Layout, TraceError, TraceReader};
use dataset::{Array, Values};

/// The folder of a trial that holds everything but observations, actions, rewards and done.
const INFOS: &str = "env_infos/";
/// The dataset with the person's judgement of the episode.
const JUDGED: &str = "teleop/success";
/// The datasets that become an episode, apart from infos.
const OWN: [&str; 7] = ["observations", "actions", "rewards", "done", "time", "seed", JUDGED];
/// Why other datasets are no part of it.
const OF_NO_STEP: &str = "it belongs to no step";

/// An episode of `n` steps.
///
/// RoboHive's row `t` holds the state at `t`, the reward for being in it and the action that is taken in it. The reward of
/// step `t` therefore stands in row `t + 1`.
#[derive(Clone, Debug)]
pub struct Episode {
    /// Name of the trial.
    pub name: String,
    /// Observations, `n + 1` rows.
    pub observations: Array,
    /// Actions, `n` rows.
    pub actions: Array,
    /// Rewards of the steps, shape `[n]`.
    pub rewards: Array,
    /// Whether a step ended the episode for good, shape `[n]`.
    pub terminations: Array,
    /// Whether a step was the last one only because nothing was recorded after it, shape `[n]`.
    pub truncations: Array,
    /// What else is known of the states: names without `env_infos/`, `n + 1` rows each.
    pub infos: Vec<(String, Array)>,
    /// Times of the states \[s\], `n + 1` of them; empty if they were not recorded.
    pub times: Vec<f64>,
    /// Seed of the reset, if it was recorded.
    pub seed: Option<i64>,
    /// Whether the person who drove called it a success, if one did.
    pub judged: Option<bool>,
    /// Names of what is not in here, and why.
    pub dropped: Vec<(String, String)>,
}

impl Episode {
    /// Steps.
    pub fn steps(&self) -> usize {
        self.actions.rows()
    }

    /// The transitions of a trial in RoboHive's layout.
    ///
    /// # Errors
    /// The trial is in another layout, one of its rows is missing or has another length, it has no step, or the file is
    /// damaged.
    pub fn of_trial(trace: &TraceReader, name: &str) -> Result<Self, TraceError> {
        let fail = |key: &str, message: String| {
            let object = if key.is_empty() { name.to_owned() } else { format!("{name}/{key}") };
            TraceError::new(trace.path(), object, message)
        };
        if trace.layout(name)? != Some(Layout::RoboHive) {
            let message = "not in RoboHive's layout: `robohive data convert --layout robohive` makes a recording that is";
            return Err(fail("", message.into()));
        }
        let (mut arrays, mut dropped) = (Vec::new(), Vec::new());
        for entry in trace.entries(name)? {
            let info = entry.key.starts_with(INFOS);
            match &entry.kind {
                _ if !info && !OWN.contains(&&entry.key[..]) => dropped.push((entry.key, OF_NO_STEP.into())),
                EntryType::Number(_) => {
                    let array = trace.read(&entry)?;
                    arrays.push((entry.key, array));
                }
                kind if info => {
                    let why = format!("its elements are {}", kind.name());
                    dropped.push((entry.key, why));
                }
                // Reading says what is wrong.
                _ => drop(trace.read(&entry)?),
            }
        }
        let mut episode = Episode::of_arrays(name, arrays).map_err(|(key, message)| fail(&key, message))?;
        episode.dropped.extend(dropped);
        Ok(episode)
    }

    /// The transitions of rows under the names of RoboHive's layout.
    ///
    /// # Errors
    /// The name of the rows that are missing, have another length, or are no step, and what is wrong with them.
    pub fn of_arrays(name: &str, arrays: Vec<(String, Array)>) -> Result<Self, (String, String)> {
        let find = |key: &str| arrays.iter().find(|(known, _)| known == key).map(|(_, array)| array);
        let fail = |key: &str, message: String| (key.to_owned(), message);
        let require = |key: &str| find(key).ok_or_else(|| fail(key, "the trial has no such dataset".into()));
        let observations = require("observations")?;
        let rows = observations.rows();
        if observations.shape.is_empty() || rows < 2 {
            return Err(fail("observations", format!("{rows} rows are no step: two are the least")));
        }
        let checked = |key: &str| {
            let array = require(key)?;
            if array.shape.first() != Some(&rows) {
                return Err(fail(key, format!("{} rows, where \"observations\" has {rows}", array.rows())));
            }
            Ok(array)
        };
        let rewards = scalars(checked("rewards")?).map_err(|message| fail("rewards", message))?;
        let done = scalars(checked("done")?).map_err(|message| fail("done", message))?;
        let ended = done[1..].iter().map(|&x| x != 0.0);
        let mut truncations = vec![false; rows - 1];
        truncations[rows - 2] = done[rows - 1] == 0.0;
        let times = if find("time").is_some() { checked("time")?.values.to_f64() } else { Vec::new() };
        let mut out = Episode {
            name: name.to_owned(),
            observations: observations.clone(),
            actions: first_rows(checked("actions")?.clone(), rows - 1),
            rewards: Array::f64(vec![rows - 1], rewards[1..].to_vec()),
            terminations: Array { shape: vec![rows - 1], values: Values::Bool(ended.collect()) },
            truncations: Array { shape: vec![rows - 1], values: Values::Bool(truncations) },
            infos: Vec::new(),
            times,
            seed: find("seed").and_then(seed_of),
            judged: find(JUDGED).and_then(|array| array.values.to_f64().first().map(|&x| x != 0.0)),
            dropped: Vec::new(),
        };
        for (key, array) in arrays {
            match key.strip_prefix(INFOS) {
                Some(info) if array.shape.first() == Some(&rows) => out.infos.push((info.to_owned(), array)),
                Some(_) => out.dropped.push((key, format!("it has no {rows} rows"))),
                None if OWN.contains(&&key[..]) => {}
                None => out.dropped.push((key, OF_NO_STEP.into())),
            }
        }
        Ok(out)
    }
}

/// One number a row.
fn scalars(array: &Array) -> Result<Vec<f64>, String> {
    if array.shape[1..].iter().product::<usize>() != 1 {
        return Err(format!("shape {:?}, where a row is one number", array.shape));
    }
    Ok(array.values.to_f64())
}

fn seed_of(array: &Array) -> Option<i64> {
    match &array.values {
        Values::U64(seeds) => seeds.first().and_then(|&seed| i64::try_from(seed).ok()),
        Values::I64(seeds) => seeds.first().copied(),
        _ => None,
    }
}

/// The first rows of an array.
fn first_rows(array: Array, rows: usize) -> Array {
    let width = array.shape[1..].iter().product::<usize>() * array.values.dtype().bytes();
    let mut bytes = Vec::new();
    array.values.put_bytes(&mut bytes);
    bytes.truncate(rows * width);
    let shape = [&[rows], &array.shape[1..]].concat();
    Array { shape, values: Values::from_bytes(array.values.dtype(), &bytes) }
}
