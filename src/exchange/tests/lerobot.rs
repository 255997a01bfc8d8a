//! Datasets of LeRobot: what is written is read again to the bit, and described by a second computation.

mod folder;

use dataset::{Array, Values};
use folder::Folder;
use robohive_exchange::lerobot::{
    Cells, Column, FeatureKind, Frames, LeRobotReader, LeRobotWriter, Pictures, Settings,
};
use serde_json::Value;
use std::path::Path;

/// Numbers of both signs and many magnitudes, others in each episode.
fn wave(episode: usize, count: usize) -> Vec<f64> {
    (0..count).map(|i| ((i * 37 + episode * 101) as f64).sin() * 10f64.powi((i % 7) as i32 - 3)).collect()
}

/// An episode of `frames` frames with a feature of every kind but pictures.
fn frames(episode: usize, frames: usize) -> Frames {
    let state: Vec<f32> = wave(episode, frames * 3).into_iter().map(|x| x as f32).collect();
    let grid = wave(episode + 50, frames * 4);
    Frames {
        features: vec![
            ("observation.state".into(), Array { shape: vec![frames, 3], values: Values::F32(state) }),
            ("grid".into(), Array::f64(vec![frames, 2, 2], grid)),
            ("reward".into(), Array::f64(vec![frames], wave(episode + 9, frames))),
            ("done".into(), Array { shape: vec![frames], values: bools(episode, frames) }),
            ("count".into(), Array { shape: vec![frames, 1], values: integers(episode, frames) }),
        ],
        task: if episode.is_multiple_of(2) { "open the door".into() } else { "close the door".into() },
    }
}

fn bools(episode: usize, frames: usize) -> Values {
    Values::Bool((0..frames).map(|i| (i + episode).is_multiple_of(3)).collect())
}

fn integers(episode: usize, frames: usize) -> Values {
    Values::I64((0..frames).map(|i| i64::MAX - (i * 1000 + episode) as i64).collect())
}

fn write(root: &Path, episodes: &[Frames], settings: Settings) {
    let mut writer = LeRobotWriter::create(root, settings).unwrap();
    for (k, frames) in episodes.iter().enumerate() {
        writer.add(frames).unwrap();
        assert_eq!(writer.episodes(), k + 1);
    }
    assert!(!root.exists(), "a dataset appears when it is finished");
    writer.finish().unwrap();
}

fn column<'a>(columns: &'a [Column], name: &str) -> &'a Column {
    columns.iter().find(|column| column.name == name).unwrap_or_else(|| panic!("no {name}"))
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Whether the cells of a column are the values of an array, to the bit.
fn equal(cells: &Cells, values: &Values) -> bool {
    match (cells, values) {
        (Cells::F32(a), Values::F32(b)) => a.iter().map(|x| x.to_bits()).eq(b.iter().map(|x| x.to_bits())),
        (Cells::F64(a), Values::F64(b)) => a.iter().map(|x| x.to_bits()).eq(b.iter().map(|x| x.to_bits())),
        (Cells::I64(a), Values::I64(b)) => a == b,
        (Cells::Bool(a), Values::Bool(b)) => a == b,
        _ => false,
    }
}

#[test]
fn every_number_is_read_again() {
    let folder = Folder::new("numbers");
    let root = folder.path().join("set");
    let lengths = [7, 1, 12];
    let episodes: Vec<Frames> = lengths.iter().enumerate().map(|(k, &n)| frames(k, n)).collect();
    write(&root, &episodes, Settings::new(12.5).with_robot(Some("franka".into())));
    let reader = LeRobotReader::open(&root).unwrap();
    assert_eq!(reader.episodes(), 3);
    assert_eq!((reader.task(0), reader.task(1)), (Some("open the door"), Some("close the door")));
    assert_eq!(reader.task(2), None);
    let mut first = 0;
    for (k, episode) in episodes.iter().enumerate() {
        let columns = reader.read(k).unwrap();
        for (name, array) in &episode.features {
            assert!(equal(&column(&columns, name).cells, &array.values), "{name} of episode {k}");
        }
        assert_eq!(column(&columns, "grid").row, [2, 2]);
        assert!(column(&columns, "count").row.is_empty(), "a value of shape [1] is a scalar");
        let indices = |name: &str| column(&columns, name).cells.clone();
        assert_eq!(indices("index"), Cells::I64((first..first + lengths[k] as i64).collect()));
        assert_eq!(indices("frame_index"), Cells::I64((0..lengths[k] as i64).collect()));
        assert_eq!(indices("episode_index"), Cells::I64(vec![k as i64; lengths[k]]));
        assert_eq!(indices("task_index"), Cells::I64(vec![k as i64 % 2; lengths[k]]));
        let times = (0..lengths[k]).map(|i| (i as f64 / 12.5) as f32).collect();
        assert_eq!(indices("timestamp"), Cells::F32(times));
        first += lengths[k] as i64;
    }
    let error = reader.read(3).unwrap_err().to_string();
    assert!(error.contains("there is no episode 3: the dataset has 3"), "{error}");
}

#[test]
fn the_description_counts_what_is_there() {
    let folder = Folder::new("description");
    let root = folder.path().join("set");
    write(&root, &[frames(0, 5), frames(1, 4)], Settings::new(30.0).with_robot(Some("allegro".into())));
    let info = json(&root.join("meta/info.json"));
    assert_eq!((&info["total_episodes"], &info["total_frames"]), (&2.into(), &9.into()));
    assert_eq!((&info["fps"], &info["robot_type"]), (&30.into(), &"allegro".into()));
    assert_eq!((&info["total_tasks"], &info["splits"]["train"]), (&2.into(), &"0:2".into()));
    assert!(info["video_path"].is_null());
    let features = info["features"].as_object().unwrap();
    let kinds = ["observation.state", "grid", "reward", "done", "count", "timestamp", "task_index"];
    let expected = ["float32", "float64", "float64", "bool", "int64", "float32", "int64"];
    for (name, dtype) in kinds.into_iter().zip(expected) {
        assert_eq!(features[name]["dtype"], dtype, "{name}");
    }
    assert_eq!(features["grid"]["shape"], serde_json::json!([2, 2]));
    assert_eq!(features.len(), 5 + 5);
    let reader = LeRobotReader::open(&root).unwrap();
    let done = reader.features().iter().find(|feature| feature.name == "done").unwrap();
    assert_eq!((done.kind, &done.shape[..]), (FeatureKind::Bool, &[1][..]));
    assert!(!done.kind.is_picture() && reader.info()["codebase_version"] == "v3.0");
}

#[test]
fn statistics_are_the_moments_of_all_frames() {
    let folder = Folder::new("statistics");
    let root = folder.path().join("set");
    let episodes = [frames(0, 40), frames(1, 3), frames(2, 17)];
    write(&root, &episodes, Settings::new(10.0));
    let stats = json(&root.join("meta/stats.json"));
    for direction in 0..3 {
        let all: Vec<f64> = episodes
            .iter()
            .flat_map(|episode| episode.features[0].1.values.to_f64())
            .skip(direction)
            .step_by(3)
            .collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        let variance = all.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / all.len() as f64;
        let of = |part: &str| stats["observation.state"][part][direction].as_f64().unwrap();
        // Sums of 60 numbers up to 1e3, in two orders.
        assert!((of("mean") - mean).abs() < 1e-12 * 1e3, "{} {mean}", of("mean"));
        assert!((of("std") - variance.sqrt()).abs() < 1e-12 * 1e3, "{} {variance}", of("std"));
        // The parser of JSON rounds the last bit as it pleases.
        let same = |a: f64, b: f64| (a - b).abs() <= f64::EPSILON * b.abs();
        assert!(same(of("min"), all.iter().copied().fold(f64::INFINITY, f64::min)));
        assert!(same(of("max"), all.iter().copied().fold(f64::NEG_INFINITY, f64::max)));
        assert!(of("q01") <= of("q50") && of("q50") <= of("q99") && of("q99") < of("max"));
    }
    assert_eq!(stats["observation.state"]["count"], serde_json::json!([60]));
    assert_eq!(stats["index"]["max"], serde_json::json!([59.0]));
    assert_eq!(stats["done"]["min"], serde_json::json!([0.0]));
}

#[test]
fn long_episodes_span_groups_of_rows() {
    let folder = Folder::new("groups");
    let root = folder.path().join("set");
    // 2.4 MB each: a group of rows begins within what is held after 4 MiB.
    let long = |episode: usize| Frames {
        features: vec![("wide".into(), Array::f64(vec![1500, 200], wave(episode, 1500 * 200)))],
        task: String::new(),
    };
    let episodes: Vec<Frames> = (0..4).map(long).collect();
    write(&root, &episodes, Settings::new(1.0));
    let reader = LeRobotReader::open(&root).unwrap();
    for k in [3, 0, 2, 1] {
        let columns = reader.read(k).unwrap();
        assert!(equal(&column(&columns, "wide").cells, &episodes[k].features[0].1.values), "episode {k}");
    }
}

/// Pictures of 6 by 4 pixels, no two alike.
fn pictures(frames: usize) -> Array {
    let bytes = (0..frames * 4 * 6 * 3).map(|i| (i * 7 % 251) as u8).collect();
    Array { shape: vec![frames, 4, 6, 3], values: Values::U8(bytes) }
}

#[test]
fn pictures_in_tables_lose_nothing() {
    let folder = Folder::new("png");
    let root = folder.path().join("set");
    let frames =
        Frames { features: vec![("observation.images.eye".into(), pictures(3))], task: "look".into() };
    write(&root, std::slice::from_ref(&frames), Settings::new(5.0).with_pictures(Pictures::Png));
    let reader = LeRobotReader::open(&root).unwrap();
    assert_eq!(reader.features()[0].kind, FeatureKind::Image);
    let columns = reader.read(0).unwrap();
    let Cells::Png(files) = &column(&columns, "observation.images.eye").cells else { panic!("no pictures") };
    let Values::U8(expected) = &frames.features[0].1.values else { unreachable!() };
    for (file, expected) in files.iter().zip(expected.chunks(4 * 6 * 3)) {
        let mut picture = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
        let mut pixels = vec![0; picture.output_buffer_size().unwrap()];
        let info = picture.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height, info.color_type), (6, 4, png::ColorType::Rgb));
        assert_eq!(pixels, expected);
    }
    assert_eq!(files.len(), 3);
    let stats = json(&root.join("meta/stats.json"));
    let red: Vec<f64> = expected.iter().step_by(3).map(|&x| f64::from(x) / 255.0).collect();
    let mean = red.iter().sum::<f64>() / red.len() as f64;
    let found = stats["observation.images.eye"]["mean"][0][0][0].as_f64().unwrap();
    assert!((found - mean).abs() < 1e-12, "{found} {mean}");
}

#[test]
fn videos_stand_beside_the_tables() {
    let folder = Folder::new("video");
    let root = folder.path().join("set");
    let frames = Frames {
        features: vec![
            ("observation.images.eye".into(), pictures(5)),
            ("action".into(), Array::f64(vec![5, 2], wave(0, 10))),
        ],
        task: "look".into(),
    };
    write(&root, &[frames.clone(), frames], Settings::new(5.0));
    for file in ["file-000.mp4", "file-001.mp4"] {
        let bytes = std::fs::read(root.join("videos/observation.images.eye/chunk-000").join(file)).unwrap();
        assert_eq!(&bytes[4..8], b"ftyp", "{file}");
    }
    let info = json(&root.join("meta/info.json"));
    let eye = &info["features"]["observation.images.eye"];
    assert_eq!((&eye["dtype"], &eye["shape"]), (&"video".into(), &serde_json::json!([4, 6, 3])));
    assert_eq!((&eye["info"]["video.fps"], &eye["info"]["video.codec"]), (&5.into(), &"h264".into()));
    let columns = LeRobotReader::open(&root).unwrap().read(1).unwrap();
    assert!(columns.iter().all(|column| column.name != "observation.images.eye"));
    assert_eq!(column(&columns, "action").cells.len(), 10);
}
