//! What a dataset of LeRobot refuses, by which message, and that nothing is left behind.

mod folder;

use dataset::{Array, Values};
use folder::Folder;
use robohive_exchange::lerobot::{Frames, LeRobotReader, LeRobotWriter, Settings};
use std::path::{Path, PathBuf};

type Features = Vec<(String, Array)>;

fn numbers(name: &str, shape: &[usize]) -> (String, Array) {
    let count = shape.iter().product();
    (name.into(), Array::f64(shape.to_vec(), (0..count).map(|i| i as f64).collect()))
}

fn frames(features: Features) -> Frames {
    Frames { features, task: "task".into() }
}

fn written(folder: &Folder) -> PathBuf {
    let root = folder.path().join("set");
    let mut writer = LeRobotWriter::create(&root, Settings::new(10.0)).unwrap();
    for rows in [4, 6] {
        writer.add(&frames(vec![numbers("action", &[rows, 2]), numbers("reward", &[rows])])).unwrap();
    }
    writer.finish().unwrap();
    root
}

#[track_caller]
fn assert_says<T>(result: Result<T, dataset::trace::TraceError>, expected: &[&str]) {
    let Err(error) = result else { panic!("nothing was refused, where {expected:?} was expected") };
    let text = error.to_string();
    assert!(expected.iter().all(|part| text.contains(part)), "{text:?} lacks one of {expected:?}");
}

#[test]
fn frames_that_are_none_are_refused_by_name() {
    let folder = Folder::new("frames");
    let cases: [(Features, &[&str]); 9] = [
        (vec![], &["an episode has no features"]),
        (vec![numbers("action", &[0, 2])], &["action", "a frame at least"]),
        (vec![numbers("", &[2])], &["not empty and has no /"]),
        (vec![numbers("a/b", &[2])], &["a/b", "not empty and has no /"]),
        (vec![numbers("timestamp", &[2])], &["timestamp", "the writer sets this feature"]),
        (vec![numbers("a", &[2]), numbers("a", &[2])], &["given twice"]),
        (vec![numbers("a", &[2, 0])], &["[2, 0]", "no value"]),
        (vec![numbers("a", &[2]), numbers("b", &[3])], &["b", "3 frames, where \"a\" has 2"]),
        (vec![numbers("a", &[1, 1, 1, 1, 1, 1, 1])], &["five axes at most"]),
    ];
    for (features, expected) in cases {
        let root = folder.path().join("set");
        let mut writer = LeRobotWriter::create(&root, Settings::new(10.0)).unwrap();
        assert_says(writer.add(&frames(features)), expected);
        assert_eq!(writer.episodes(), 0);
        assert_says(writer.finish(), &["a dataset needs at least one episode"]);
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "something was left behind");
}

#[test]
fn later_episodes_have_the_features_of_the_first() {
    let folder = Folder::new("features");
    let root = folder.path().join("set");
    let mut writer = LeRobotWriter::create(&root, Settings::new(10.0)).unwrap();
    writer.add(&frames(vec![numbers("a", &[3, 2]), numbers("b", &[3])])).unwrap();
    assert_says(writer.add(&frames(vec![numbers("a", &[3, 2])])), &["b"]);
    assert_says(writer.add(&frames(vec![numbers("a", &[3, 3]), numbers("b", &[3])])), &["a", "[3]", "[2]"]);
    let integers = Array { shape: vec![3], values: Values::I64(vec![1, 2, 3]) };
    assert_says(writer.add(&frames(vec![numbers("a", &[3, 2]), ("b".into(), integers)])), &["b", "int64"]);
    let more = vec![numbers("a", &[3, 2]), numbers("b", &[3]), numbers("c", &[3])];
    assert_says(writer.add(&frames(more)), &["c"]);
    // The episodes before are as they were.
    writer.add(&frames(vec![numbers("b", &[5]), numbers("a", &[5, 2])])).unwrap();
    writer.finish().unwrap();
    let reader = LeRobotReader::open(&root).unwrap();
    assert_eq!(reader.episodes(), 2);
    let rows = reader.read(1).unwrap();
    assert_eq!(rows.iter().find(|column| column.name == "b").unwrap().cells.len(), 5);
}

#[test]
fn datasets_are_not_overwritten_and_leftovers_are() {
    let folder = Folder::new("exists");
    let root = written(&folder);
    assert_says(LeRobotWriter::create(&root, Settings::new(1.0)).map(drop), &["set", "the folder exists"]);
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let other = folder.path().join("other");
        assert_says(LeRobotWriter::create(&other, Settings::new(rate)).map(drop), &["a positive number"]);
    }
    // Of a process that was killed.
    let leftover = folder.path().join(".other.unfinished/data");
    std::fs::create_dir_all(&leftover).unwrap();
    std::fs::write(leftover.join("old.parquet"), b"old").unwrap();
    std::fs::write(leftover.with_file_name("old.json"), b"old").unwrap();
    let root = folder.path().join("other");
    let mut writer = LeRobotWriter::create(&root, Settings::new(1.0)).unwrap();
    writer.add(&frames(vec![numbers("a", &[2])])).unwrap();
    writer.finish().unwrap();
    assert!(!root.join("data/old.parquet").exists() && !root.join("old.json").exists());
    assert!(root.join("data/chunk-000/file-000.parquet").exists());
}

#[test]
fn pictures_of_odd_sides_are_no_videos() {
    let folder = Folder::new("odd");
    let root = folder.path().join("set");
    let picture = Array { shape: vec![2, 3, 4, 3], values: Values::U8(vec![9; 72]) };
    let mut writer = LeRobotWriter::create(&root, Settings::new(5.0)).unwrap();
    let result = writer.add(&frames(vec![numbers("a", &[2]), ("eye".into(), picture)]));
    assert_says(result, &["eye", "4 x 3 pixels", "store the pictures as PNG"]);
    // Nothing of that episode counts.
    writer.add(&frames(vec![numbers("a", &[3])])).unwrap();
    writer.finish().unwrap();
    let stats = std::fs::read_to_string(root.join("meta/stats.json")).unwrap();
    let stats: serde_json::Value = serde_json::from_str(&stats).unwrap();
    assert_eq!((&stats["a"]["count"][0], &stats["a"]["mean"][0]), (&3.into(), &1.0.into()));
}

fn edit_info(root: &Path, from: &str, to: &str) {
    let path = root.join("meta/info.json");
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains(from), "{text}");
    std::fs::write(path, text.replace(from, to)).unwrap();
}

#[test]
fn missing_and_foreign_files_are_named() {
    let missing = |file: &str, expected: &[&str]| {
        let folder = Folder::new("missing");
        let root = written(&folder);
        std::fs::remove_file(root.join(file)).unwrap();
        assert_says(LeRobotReader::open(&root).and_then(|reader| reader.read(0)), expected);
    };
    missing("meta/info.json", &["info.json"]);
    missing("meta/tasks.parquet", &["tasks.parquet"]);
    missing("meta/episodes/chunk-000/file-000.parquet", &["episodes", "file-000.parquet"]);
    missing("data/chunk-000/file-000.parquet", &["data", "file-000.parquet"]);
    let edited = |from: &str, to: &str, expected: &[&str]| {
        let folder = Folder::new("edited");
        let root = written(&folder);
        edit_info(&root, from, to);
        assert_says(LeRobotReader::open(&root).and_then(|reader| reader.read(1)), expected);
    };
    edited("v3.0", "v2.1", &["version v2.1 is not read", "lerobot's own script"]);
    edited("\"features\"", "\"parts\"", &["info.json", "the file has no features"]);
    edited("\"total_episodes\": 2", "\"total_episodes\": 3", &["file-001.parquet"]);
    edited("\"total_episodes\"", "\"episodes\"", &["info.json", "total_episodes", "missing"]);
    edited("\"reward\"", "\"penalty\"", &["penalty", "no such column"]);
    edited("{", "[", &["info.json"]);
}

#[test]
fn damaged_tables_end_in_errors() {
    let (mut refused, mut read) = (0, 0);
    for file in
        ["data/chunk-000/file-000.parquet", "meta/episodes/chunk-000/file-000.parquet", "meta/tasks.parquet"]
    {
        let folder = Folder::new("damaged");
        let root = written(&folder);
        let whole = std::fs::read(root.join(file)).unwrap();
        for length in [0, 3, 8, whole.len() / 3, whole.len() / 2, whole.len() - 1] {
            std::fs::write(root.join(file), &whole[..length]).unwrap();
            let result = LeRobotReader::open(&root).and_then(|reader| reader.read(0));
            assert_says(result, &[file.rsplit('/').next().unwrap(), "no Parquet file, or a damaged one"]);
        }
        // Any byte may be another; most such files are refused, none ends the process.
        for at in (0..whole.len()).step_by(whole.len() / 97 + 1) {
            let mut bytes = whole.clone();
            bytes[at] ^= 0x5a;
            std::fs::write(root.join(file), &bytes).unwrap();
            let result = LeRobotReader::open(&root)
                .and_then(|reader| (0..2).try_for_each(|k| reader.read(k).map(drop)));
            if result.is_ok() { read += 1 } else { refused += 1 }
        }
    }
    assert!(refused > 30 && read > 0, "{refused} refused, {read} read");
}
