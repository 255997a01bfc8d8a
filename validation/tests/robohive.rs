//! Observations and rewards beside RoboHive's own Python, without its models: a stand-in has the names and counts
//! that a task asks for, and the recorded arrays are put where physics would have computed them.

mod stand_in;

use dataset::npz::NpzReader;
use env::{AssetError, Assets, Compat, Env, Options};
use mjcf::Loader;
use mjcf::files::Memory;
use serde_json::Value;
use stand_in::{Columns, text};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest difference relative to the larger of 1 and the recorded number. Both sides compute in double precision from the
/// same numbers, a few hundred operations of magnitudes up to about 10, each rounded by 1e-16.
const TOLERANCE: f64 = 1e-12;
/// The same for tasks that weigh the body: joints of the stand-in have 1e-9 kg each, which the recorded model has not.
const WEIGHED: f64 = 1e-9;

/// The stand-in under every path, and a config without devices.
struct StandIn(String);

impl Assets for StandIn {
    fn model(&self, _: &str) -> Result<(Loader, PathBuf), AssetError> {
        let mut files = Memory::default();
        files.insert("stand_in.xml", self.0.as_bytes());
        Ok((Loader::default().files(files), "stand_in.xml".into()))
    }

    fn read(&self, path: &str) -> Result<Arc<[u8]>, AssetError> {
        if path.ends_with(".config") {
            // A device that senses and moves nothing.
            Ok(Arc::from(&b"{'none': {'interface': {'type': 'none'}, 'sensor': [], 'actuator': []}}"[..]))
        } else {
            Err(format!("no {path} here").into())
        }
    }
}

/// Every difference between an environment and its record.
fn differences(path: &Path) -> Vec<String> {
    let archive = NpzReader::open(path).unwrap();
    let meta = archive.require("meta").unwrap().values.to_f64();
    let meta = String::from_utf8(meta.iter().map(|&byte| byte as u8).collect()).unwrap();
    // Python writes infinities, which JSON does not have and no stand-in needs.
    let meta: Value =
        serde_json::from_str(&meta.replace("-Infinity", "null").replace("Infinity", "null")).unwrap();
    let id = meta["id"].as_str().unwrap();
    let changes = "define = []\nreparent = []\nvisual_keys = []\nact_mode = 'pos'".parse().unwrap();
    let options = Options::default().with_compat(Compat::RoboHive07).with_changes(changes);
    let mut env = match Env::make(id, &StandIn(text(&meta)), &options) {
        Ok(env) => env,
        Err(error) => return vec![format!("{id}: {error}")],
    };
    let mut found = Vec::new();
    let columns = Columns::new(&archive, &meta);
    let mut moved = false;
    for state in 0..columns.states() {
        env.observe_injected(|injected| columns.inject(state, injected));
        let mut compare = |name: &str, ours: &[f64]| {
            let Some(recorded) = columns.row(name, state) else { return };
            if columns.counts_steps() && ["obs_dict/time", "obs_dict/t"].contains(&name) {
                return;
            }
            moved |= state > 0 && columns.row(name, 0) != Some(recorded);
            let tolerance = if id.starts_with("myoLeg") { WEIGHED } else { TOLERANCE };
            let close = |(x, y): (&f64, &f64)| (x - y).abs() <= tolerance * y.abs().max(1.0);
            if ours.len() != recorded.len() || !ours.iter().zip(recorded).all(close) {
                found.push(format!("{id}: {name} of state {state} is {ours:.6?}, not {recorded:.6?}"));
            }
        };
        env.rows().iter().for_each(|(row, values)| compare(&format!("obs_dict/{}", row.name()), values));
        env.terms().iter().for_each(|(row, values)| compare(&format!("rwd_dict/{}", row.name()), values));
        compare("obs", env.observation());
        let verdict = env.verdict();
        compare("rwd_dict/dense", &[env.dense()]);
        compare("rwd_dict/sparse", &[verdict.sparse]);
        compare("rwd_dict/solved", &[f64::from(verdict.solved)]);
        compare("rwd_dict/done", &[f64::from(verdict.done)]);
    }
    assert!(moved, "{id}: the record has states that differ");
    for name in archive.names().filter_map(|name| name.strip_prefix("rwd_dict/")) {
        let known = ["dense", "sparse", "solved", "done"].contains(&name) || env.terms().get(name).is_some();
        if !known {
            found.push(format!("{id}: the term {name} is missing"));
        }
    }
    found
}

#[test]
fn functions_of_every_class_are_those_of_the_original() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/robohive");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert_eq!(paths.len(), 37, "one record for each class");
    let found: Vec<_> = paths.iter().flat_map(|path| differences(path)).collect();
    assert!(found.is_empty(), "{} differences:\n{}", found.len(), found.join("\n"));
}
