//! Datasets of LeRobot that grow: complete after every episode, gone on with, and whole after a kill.

mod folder;

use dataset::trace::TraceError;
use dataset::{Array, Values};
use folder::Folder;
use robohive_exchange::lerobot::{Frames, LeRobotReader, LeRobotWriter, Pictures, Settings};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// An episode of some frames.
fn frames(episode: usize, count: usize) -> Frames {
    let wave = |i: usize| ((i * 37 + episode * 101) as f64).sin();
    let state = (0..count * 3).map(|i| wave(i) as f32).collect();
    let pictures = (0..count * 4 * 6 * 3).map(|i| (i * 7 + episode) as u8).collect();
    Frames {
        features: vec![
            ("observation.state".into(), Array { shape: vec![count, 3], values: Values::F32(state) }),
            ("grid".into(), Array::f64(vec![count, 2, 2], (0..count * 4).map(wave).collect())),
            (
                "observation.images.eye".into(),
                Array { shape: vec![count, 4, 6, 3], values: Values::U8(pictures) },
            ),
        ],
        task: ["open the door", "close the door", "knock"][episode % 3].into(),
    }
}

fn settings() -> Settings {
    Settings::new(12.5).with_pictures(Pictures::Png)
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// All files below a folder.
fn files(root: &Path) -> Vec<PathBuf> {
    let mut out = Vec::new();
    for entry in std::fs::read_dir(root).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { out.extend(files(&path)) } else { out.push(path) }
    }
    out
}

#[track_caller]
fn assert_says<T>(result: Result<T, TraceError>, expected: &[&str]) {
    let Err(error) = result else { panic!("nothing was refused, where {expected:?} was expected") };
    let text = error.to_string();
    assert!(expected.iter().all(|part| text.contains(part)), "{text:?} lacks one of {expected:?}");
}

#[test]
fn a_dataset_that_grows_is_the_one_that_is_written_at_once() {
    let folder = Folder::new("grows");
    let [grown, whole] = ["grown", "whole"].map(|name| folder.path().join(name));
    let lengths = [7, 1, 12, 5];
    let mut at_once = LeRobotWriter::create(&whole, settings()).unwrap();
    let mut writer = LeRobotWriter::grow(&grown, settings()).unwrap();
    assert!(!grown.exists(), "it appears with its first episode");
    for (k, &count) in lengths.iter().enumerate() {
        if k == 2 {
            // Another process goes on.
            writer.finish().unwrap();
            writer = LeRobotWriter::grow(&grown, settings()).unwrap();
            assert_eq!(writer.episodes(), 2);
        }
        writer.add(&frames(k, count)).unwrap();
        at_once.add(&frames(k, count)).unwrap();
        // Whoever looks now, or after a kill, finds every episode that was added.
        let reader = LeRobotReader::open(&grown).unwrap();
        assert_eq!(reader.episodes(), k + 1);
        (0..=k).for_each(|episode| drop(reader.read(episode).unwrap()));
    }
    drop(writer);
    at_once.finish().unwrap();
    let [a, b] = [&grown, &whole].map(|root| LeRobotReader::open(root).unwrap());
    for episode in 0..lengths.len() {
        assert_eq!(a.read(episode).unwrap(), b.read(episode).unwrap());
    }
    let parts = |name: &str| [&grown, &whole].map(|root| json(&root.join("meta").join(name)));
    let [a, b] = parts("info.json");
    assert_eq!(a, b);
    let [a, b] = parts("stats.json");
    // The statistics that were read back have all bits.
    assert_eq!(a, b);
    assert!(files(&grown).iter().all(|path| path.extension().is_some_and(|ending| ending != "new")));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "nothing is left beside them");
}

#[test]
fn what_a_killed_process_has_not_counted_is_dropped() {
    let folder = Folder::new("torn");
    let root = folder.path().join("set");
    let mut writer = LeRobotWriter::grow(&root, settings()).unwrap();
    (0..2).for_each(|k| writer.add(&frames(k, 4)).unwrap());
    drop(writer);
    // A kill between two renames: frames and table of a third episode, and half a file, that nothing counts.
    for part in ["data", "meta/episodes"] {
        let chunk = root.join(part).join("chunk-000");
        std::fs::copy(chunk.join("file-001.parquet"), chunk.join("file-002.parquet")).unwrap();
        std::fs::write(chunk.join("file-002.parquet.new"), b"PAR1").unwrap();
    }
    assert_eq!(LeRobotReader::open(&root).unwrap().episodes(), 2);
    let mut writer = LeRobotWriter::grow(&root, settings()).unwrap();
    assert!(files(&root).iter().all(|path| !path.to_string_lossy().contains("file-002")));
    writer.add(&frames(2, 9)).unwrap();
    let reader = LeRobotReader::open(&root).unwrap();
    let last = reader.read(2).unwrap();
    assert_eq!((reader.episodes(), last[0].cells.len()), (3, 27));
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    let folder = Folder::new("refused");
    let root = folder.path().join("set");
    let mut writer = LeRobotWriter::grow(&root, settings()).unwrap();
    writer.add(&frames(0, 4)).unwrap();
    drop(writer);
    assert_says(LeRobotWriter::grow(&root, Settings::new(10.0)), &["12.5 frames a second", "have 10"]);
    let before = files(&root);
    let mut writer = LeRobotWriter::grow(&root, settings()).unwrap();
    let mut wide = frames(1, 4);
    wide.features[0].1 = Array { shape: vec![4, 5], values: Values::F32(vec![0.0; 20]) };
    assert_says(writer.check(&wide), &["observation.state", "shape [5]", "shape [3]"]);
    assert_says(writer.add(&wide), &["observation.state"]);
    let mut lacking = frames(1, 4);
    lacking.features.remove(1);
    assert_says(writer.check(&lacking), &["grid", "missing"]);
    let mut more = frames(1, 4);
    more.features.push(("action".into(), Array::f64(vec![4], vec![0.0; 4])));
    assert_says(writer.check(&more), &["action", "does not have it"]);
    drop(writer);
    assert_eq!(files(&root), before, "refusals write nothing");
    let strange = folder.path().join("strange");
    std::fs::create_dir(&strange).unwrap();
    std::fs::write(strange.join("notes.txt"), "mine").unwrap();
    assert_says(LeRobotWriter::grow(&strange, settings()), &["is not a LeRobot dataset"]);
    let path = root.join("meta/info.json");
    let text = std::fs::read_to_string(&path).unwrap().replace("float64", "complex128");
    std::fs::write(&path, text).unwrap();
    assert_says(LeRobotWriter::grow(&root, settings()), &["grid", "complex128"]);
}

#[test]
fn a_dataset_that_lacks_a_file_is_not_extended() {
    let folder = Folder::new("lacks");
    let root = folder.path().join("set");
    for (form, file) in [
        (Pictures::Png, "data/chunk-000/file-000.parquet"),
        (Pictures::Video, "videos/observation.images.eye/chunk-000/file-001.mp4"),
    ] {
        let settings = || Settings::new(12.5).with_pictures(form);
        let mut writer = LeRobotWriter::grow(&root, settings()).unwrap();
        (0..3).for_each(|k| writer.add(&frames(k, 4)).unwrap());
        drop(writer);
        LeRobotWriter::grow(&root, settings()).unwrap();
        std::fs::remove_file(root.join(file)).unwrap();
        assert_says(LeRobotWriter::grow(&root, settings()), &[file, "missing", "cannot be extended"]);
        std::fs::remove_dir_all(&root).unwrap();
    }
}

#[cfg(unix)]
#[test]
fn two_sessions_do_not_write_one_dataset() {
    let folder = Folder::new("two");
    let root = folder.path().join("set");
    let busy = ["another session is writing this dataset"];
    let mut first = LeRobotWriter::grow(&root, settings()).unwrap();
    assert_says(LeRobotWriter::grow(&root, settings()).map(drop), &busy);
    assert_says(LeRobotWriter::create(&root, settings()).map(drop), &busy);
    first.add(&frames(0, 4)).unwrap();
    // The folder has its name now.
    assert_says(LeRobotWriter::grow(&root, settings()).map(drop), &busy);
    first.add(&frames(1, 3)).unwrap();
    first.finish().unwrap();
    let mut second = LeRobotWriter::grow(&root, settings()).unwrap();
    assert_says(LeRobotWriter::grow(&root, settings()).map(drop), &busy);
    second.add(&frames(2, 2)).unwrap();
    second.finish().unwrap();
    assert_eq!(LeRobotReader::open(&root).unwrap().episodes(), 3);
}
