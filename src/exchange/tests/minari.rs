//! Datasets of Minari: layout, metadata, and what is refused.

mod folder;

use dataset::trace::TraceReader;
use dataset::{Array, Values};
use folder::Folder;
use robohive_exchange::minari::{About, DatasetId, MinariWriter, env_spec};
use serde_json::{Value, json};
use std::path::Path;

type Columns = Vec<(String, Array)>;

fn flags(steps: usize, last: bool) -> Array {
    let values = (0..steps).map(|i| last && i + 1 == steps).collect();
    Array { shape: vec![steps], values: Values::Bool(values) }
}

fn ramp(shape: &[usize], from: f64) -> Array {
    Array::f64(shape.to_vec(), (0..shape.iter().product()).map(|i| from + i as f64 / 3.0).collect())
}

/// An episode with two observations, of which one is a picture.
fn episode(steps: usize, from: f64) -> Columns {
    let pixels = (0..(steps + 1) * 2 * 2 * 3).map(|i| (i % 256) as u8).collect();
    let picture = Array { shape: vec![steps + 1, 2, 2, 3], values: Values::U8(pixels) };
    vec![
        ("observations/state".into(), ramp(&[steps + 1, 3], from)),
        ("observations/eye".into(), picture),
        ("actions".into(), ramp(&[steps, 2], -from)),
        ("rewards".into(), ramp(&[steps], 1e-3 * from)),
        ("terminations".into(), flags(steps, true)),
        ("truncations".into(), flags(steps, false)),
        ("infos/solved".into(), ramp(&[steps + 1], 0.0)),
    ]
}

fn id() -> DatasetId {
    DatasetId::new("robohive/door/random-v3").unwrap()
}

fn metadata(root: &Path) -> Value {
    let path = root.join("robohive/door/random-v3/data/metadata.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[track_caller]
fn assert_says<T>(result: Result<T, dataset::trace::TraceError>, expected: &[&str]) {
    let Err(error) = result else { panic!("nothing was refused, where {expected:?} was expected") };
    let text = error.to_string();
    assert!(expected.iter().all(|part| text.contains(part)), "{text:?} lacks one of {expected:?}");
}

#[test]
fn a_dataset_is_complete_after_every_episode() {
    let folder = Folder::new("minari");
    let more = [("author".to_owned(), json!("someone"))].into_iter().collect();
    let about = About { env_spec: Some(env_spec("hive/Door-v0", Some(50))), more, ..About::default() };
    let mut writer = MinariWriter::create(folder.path(), &id(), &about).unwrap();
    assert_eq!(metadata(folder.path())["total_episodes"], 0);
    let episodes = [episode(4, 1.0), episode(1, 2.0), episode(9, -7.5)];
    let mut steps = 0;
    for (k, columns) in episodes.iter().enumerate() {
        writer.add(columns, (k == 1).then_some(-5)).unwrap();
        steps += columns[3].1.rows();
        let said = metadata(folder.path());
        assert_eq!((&said["total_episodes"], &said["total_steps"]), (&json!(k + 1), &json!(steps)));
    }
    assert_eq!(writer.episodes(), 3);
    let file = writer.folder().join("main_data.hdf5");
    writer.close().unwrap();
    let trace = TraceReader::open(&file).unwrap();
    assert_eq!(trace.trials(), ["episode_0", "episode_1", "episode_2"]);
    for (k, columns) in episodes.iter().enumerate() {
        let trial = format!("episode_{k}");
        for (key, array) in columns {
            let entry = trace.entry(&trial, key).unwrap();
            assert_eq!(trace.read(&entry).unwrap(), *array, "{trial}/{key}");
        }
        let attributes = trace.integers(&trial).unwrap();
        let mut expected = vec![("id".to_owned(), k as i64)];
        expected.extend((k == 1).then(|| ("seed".to_owned(), -5)));
        expected.push(("total_steps".into(), columns[3].1.rows() as i64));
        assert_eq!(attributes, expected);
    }
    let said = metadata(folder.path());
    assert_eq!((&said["dataset_id"], &said["author"]), (&json!(id().as_str()), &json!("someone")));
    let spec: Value = serde_json::from_str(said["env_spec"].as_str().unwrap()).unwrap();
    assert_eq!((&spec["kwargs"]["env_id"], &spec["max_episode_steps"]), (&json!("hive/Door-v0"), &json!(50)));
    let size = std::fs::metadata(&file).unwrap().len() as f64 / 1e6;
    assert!((said["dataset_size"].as_f64().unwrap() - size).abs() <= 0.05, "{size}");
    for namespace in ["robohive", "robohive/door"] {
        assert!(folder.path().join(namespace).join("namespace_metadata.json").is_file(), "{namespace}");
    }
}

#[test]
fn episodes_that_are_none_are_refused_and_change_nothing() {
    let folder = Folder::new("refused");
    let mut writer = MinariWriter::create(folder.path(), &id(), &About::default()).unwrap();
    writer.add(&episode(3, 0.0), None).unwrap();
    let without = |key: &str| -> Columns {
        episode(3, 0.0).into_iter().filter(|(name, _)| !name.starts_with(key)).collect()
    };
    for key in ["observations", "actions", "rewards", "terminations", "truncations"] {
        assert_says(writer.add(&without(key), None), &["episode_1", key, "missing: every episode has it"]);
    }
    let with = |key: &str, array: Array| -> Columns {
        let mut columns = without(key);
        columns.push((key.into(), array));
        columns
    };
    let cases: [(Columns, &[&str]); 8] = [
        (with("actions", ramp(&[4, 2], 0.0)), &["actions", "4 rows: an episode of 3 steps has 3"]),
        (with("observations/state", ramp(&[3, 3], 0.0)), &["state", "3 rows: an episode of 3 steps has 4"]),
        (with("infos/solved", ramp(&[3], 0.0)), &["infos/solved", "has 4"]),
        (with("rewards", ramp(&[3, 2], 0.0)), &["rewards", "[3, 2]", "one number"]),
        (with("rewards", ramp(&[0], 0.0)), &["a step at least"]),
        (with("actions", ramp(&[3, 5], 0.0)), &["actions", "[5], [2] in the episodes before"]),
        (with("extra", ramp(&[3], 0.0)), &["extra", "put it under infos/"]),
        (with("observations/state", ramp(&[], 0.0)), &["observations/state", "a scalar has no rows"]),
    ];
    for (columns, expected) in cases {
        assert_says(writer.add(&columns, None), expected);
    }
    assert_says(writer.add(&without("observations/eye"), None), &["observations/eye", "missing"]);
    let more = with("observations/touch", ramp(&[4, 1], 0.0));
    assert_says(writer.add(&more, None), &["observations/touch", "do not have it"]);
    // Infos may differ from episode to episode.
    writer.add(&without("infos"), None).unwrap();
    assert_eq!((writer.episodes(), &metadata(folder.path())["total_steps"]), (2, &json!(6)));
    let file = writer.folder().join("main_data.hdf5");
    writer.close().unwrap();
    assert_eq!(TraceReader::open(&file).unwrap().trials(), ["episode_0", "episode_1"]);
}

#[test]
fn datasets_are_not_overwritten() {
    let folder = Folder::new("again");
    let mut writer = MinariWriter::create(folder.path(), &id(), &About::default()).unwrap();
    writer.add(&episode(2, 0.0), None).unwrap();
    writer.close().unwrap();
    let again = MinariWriter::create(folder.path(), &id(), &About::default()).map(drop);
    assert_says(again, &["robohive/door/random-v3", "the dataset exists", "another name or version"]);
    assert_eq!(metadata(folder.path())["total_steps"], 2);
    let other = DatasetId::new("robohive/door/random-v4").unwrap();
    let more = [("total_steps".to_owned(), json!(7))].into_iter().collect();
    let about = About { more, ..About::default() };
    let refused = MinariWriter::create(folder.path(), &other, &about).map(drop);
    assert_says(refused, &["total_steps", "is set by the writer"]);
    assert!(!folder.path().join(other.as_str()).exists());
}
