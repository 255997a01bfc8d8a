//! Recordings: what is written is read, and what cannot be written is refused by name.

use robohive_dataset::trace::{
    EntryType, Layout, Precision, Recorder, Target, TraceError, TraceReader, convert, summarise,
};
use robohive_dataset::{Array, Dtype, F16, Scalar, Values};
use std::path::{Path, PathBuf};

fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("trace");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    _ = std::fs::remove_file(&path);
    path
}

fn fixture(name: &str) -> TraceReader {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../validation/reference/traces");
    TraceReader::open(&Path::new(folder).join(name)).unwrap()
}

fn recorder(path: &Path) -> Recorder {
    Recorder::create(path, Layout::RoboHive, Precision::Full).unwrap()
}

fn read(trace: &TraceReader, trial: &str, key: &str) -> Array {
    trace.read(&trace.entry(trial, key).unwrap()).unwrap()
}

fn message<T>(result: Result<T, TraceError>) -> String {
    result.err().expect("an error").to_string()
}

fn record_one<T: Scalar>(recorder: &mut Recorder, name: &str, rows: &[T]) {
    let mut trial = recorder.begin(name).unwrap();
    for row in rows {
        trial.push("x", &[], &[*row]).unwrap();
    }
    trial.finish().unwrap();
}

#[test]
fn every_type_comes_back_as_it_was() {
    let path = scratch("types.h5");
    let mut out = recorder(&path);
    record_one(&mut out, "bool", &[true, false]);
    record_one(&mut out, "u16", &[0u16, 65535]);
    record_one(&mut out, "i64", &[i64::MIN, i64::MAX]);
    record_one(&mut out, "f16", &[F16::from_f64(0.1), F16(1)]);
    record_one(&mut out, "f32", &[f32::MIN_POSITIVE, f32::INFINITY]);
    record_one(&mut out, "f64", &[0.1, -0.0]);
    out.close().unwrap();
    let trace = TraceReader::open(&path).unwrap();
    let expected = [
        ("bool", Values::Bool(vec![true, false])),
        ("f16", Values::F16(vec![F16::from_f64(0.1), F16(1)])),
        ("f32", Values::F32(vec![f32::MIN_POSITIVE, f32::INFINITY])),
        ("f64", Values::F64(vec![0.1, -0.0])),
        ("i64", Values::I64(vec![i64::MIN, i64::MAX])),
        ("u16", Values::U16(vec![0, 65535])),
    ];
    for (name, values) in expected {
        assert_eq!(read(&trace, name, "x"), Array { shape: vec![2], values });
    }
}

/// Rows larger than a chunk, rows smaller than a chunk, and rows without a byte.
#[test]
fn rows_of_all_sizes_come_back() {
    let path = scratch("sizes.h5");
    let mut out = recorder(&path);
    let rows = 20_000;
    let wide: Vec<f64> = (0..30_000).map(f64::from).collect();
    let mut trial = out.begin("Trial0").unwrap();
    for row in 0..rows {
        trial.push("narrow", &[], &[f64::from(row)]).unwrap();
        trial.push("empty", &[0], &[0f32; 0]).unwrap();
    }
    trial.finish().unwrap();
    let mut trial = out.begin("Trial1").unwrap();
    for row in 0..3 {
        let values: Vec<f64> = wide.iter().map(|x| x + f64::from(row)).collect();
        trial.push("wide", &[100, 300], &values).unwrap();
    }
    trial.finish().unwrap();
    out.close().unwrap();
    let trace = TraceReader::open(&path).unwrap();
    let narrow = read(&trace, "Trial0", "narrow");
    assert!(narrow.values.to_f64().into_iter().eq((0..rows).map(f64::from)));
    assert_eq!(read(&trace, "Trial0", "empty").shape, [rows as usize, 0]);
    let entry = trace.entry("Trial1", "wide").unwrap();
    assert_eq!(entry.shape, [3, 100, 300]);
    let last = trace.rows(&entry, 2..3).unwrap().values.to_f64();
    assert!(last.iter().zip(&wide).all(|(a, b)| *a == b + 2.0));
    assert!(message(trace.rows(&entry, 2..4)).contains("rows 2..4 of 3"));
}

#[test]
fn hundreds_of_trials_are_found_in_the_order_of_their_numbers() {
    let path = scratch("many.h5");
    let mut out =
        Recorder::create_with(&path, Layout::RoboHive, Precision::Full, &[("env", "hive/X-v0")]).unwrap();
    for number in 0..300 {
        record_one(&mut out, &format!("Trial{number}"), &[number]);
    }
    // The file can be read while it is written, and also by who goes on with it.
    let during = TraceReader::open(&path).unwrap();
    assert_eq!(during.trials().len(), 300);
    out.close().unwrap();
    let mut again = Recorder::append(&path, Layout::RoboHive, Precision::Full).unwrap();
    assert!(message(again.begin("Trial7")).contains("has this trial already"));
    record_one(&mut again, "Trial300", &[300]);
    again.close().unwrap();
    let trace = TraceReader::open(&path).unwrap();
    assert_eq!(trace.attributes().unwrap()[1], ("env".to_owned(), "hive/X-v0".to_owned()));
    for (number, name) in trace.trials().iter().enumerate() {
        assert_eq!(*name, format!("Trial{number}"));
        assert_eq!(read(&trace, name, "x").values, Values::I32(vec![number as i32]));
    }
    assert_eq!(trace.trials().len(), 301);
}

#[test]
fn a_trial_that_is_dropped_leaves_nothing() {
    let path = scratch("dropped.h5");
    let mut out = recorder(&path);
    record_one(&mut out, "Trial0", &[1.0]);
    let length = std::fs::metadata(&path).unwrap().len();
    for _ in 0..20 {
        let mut trial = out.begin("Trial1").unwrap();
        trial.push("image", &[200, 200], &vec![3u8; 40_000]).unwrap();
        trial.push("image", &[200, 200], &vec![4u8; 40_000]).unwrap();
    }
    record_one(&mut out, "Trial1", &[2.0]);
    out.close().unwrap();
    assert!(std::fs::metadata(&path).unwrap().len() < length + 4000, "dropped trials take room");
    let trace = TraceReader::open(&path).unwrap();
    assert_eq!(trace.trials(), ["Trial0", "Trial1"]);
    assert_eq!(read(&trace, "Trial1", "x").values.to_f64(), [2.0]);
}

#[test]
fn what_cannot_be_kept_is_refused_by_name() {
    let path = scratch("refused.h5");
    let mut out = recorder(&path);
    for name in ["", ".", "a/b"] {
        assert!(message(out.begin(name)).contains("refused.h5"));
    }
    let mut trial = out.begin("Trial0").unwrap();
    trial.push("a/b", &[2], &[1.0, 2.0]).unwrap();
    let shape = message(trial.push("a/b", &[3], &[1.0, 2.0, 3.0]));
    assert!(
        shape.contains("Trial0/a/b") && shape.contains("float64 [3] follows rows of float64 [2]"),
        "{shape}"
    );
    assert!(message(trial.push("a/b", &[2], &[1i32, 2])).contains("int32"));
    assert!(message(trial.push("a/b", &[2], &[1.0])).contains("1 scalars do not fill"));
    assert!(message(trial.push("a", &[], &[1.0])).contains("cannot both be datasets"));
    assert!(message(trial.push("a//c", &[], &[1.0])).contains("a key is names"));
    trial.push("c", &[], &[1.0]).unwrap();
    trial.push("c", &[], &[1.0]).unwrap();
    assert!(message(trial.finish()).contains("2 rows, where \"a/b\" has 1"));
    assert!(message(Recorder::create(&path, Layout::RoboHive, Precision::Full)).contains("another process"));
    out.close().unwrap();
    assert!(TraceReader::open(&path).unwrap().trials().is_empty());
    let foreign = concat!(env!("CARGO_MANIFEST_DIR"), "/../../validation/reference/traces/robohive.h5");
    let copy = scratch("foreign.h5");
    std::fs::copy(foreign, &copy).unwrap();
    assert!(
        message(Recorder::append(&copy, Layout::RoboHive, Precision::Full)).contains("robohive data convert")
    );
}

#[test]
fn a_number_beyond_reduced_precision_is_refused_and_the_others_are_kept() {
    let path = scratch("reduced.h5");
    let mut out = Recorder::create(&path, Layout::RoboHive, Precision::Reduced).unwrap();
    let mut trial = out.begin("Trial0").unwrap();
    trial.push("x", &[], &[0.1]).unwrap();
    let error = message(trial.push("x", &[], &[1e6]));
    assert!(error.contains("Trial0/x") && error.contains("1000000 does not fit into float16"), "{error}");
    trial.push("n", &[], &[-5i64]).unwrap();
    trial.finish().unwrap();
    out.close().unwrap();
    let trace = TraceReader::open(&path).unwrap();
    assert_eq!(read(&trace, "Trial0", "x").values, Values::F16(vec![F16::from_f64(0.1)]));
    assert_eq!(read(&trace, "Trial0", "n").values, Values::I8(vec![-5]));
}

#[test]
fn a_robot_is_recorded_in_the_layout_of_roboset() {
    let path = scratch("roboset.h5");
    let mut out = Recorder::create(&path, Layout::RoboSet, Precision::Full).unwrap();
    let mut trial = out.begin("Trial0").unwrap();
    let pose: Vec<f64> = (0..12).map(f64::from).collect();
    let actions = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];
    for row in 0..2 {
        trial.push("env_infos/obs_dict/time", &[], &[f64::from(row)]).unwrap();
        trial.push("actions", &[9], &actions).unwrap();
        // The rotation may come before the position.
        trial.push("env_infos/obs_dict/rot_ee", &[9], &pose[3..]).unwrap();
        trial.push("env_infos/obs_dict/pos_ee", &[3], &pose[..3]).unwrap();
        trial.push("rewards", &[], &[0.0]).unwrap();
    }
    trial.finish().unwrap();
    assert_eq!(out.unmapped().collect::<Vec<_>>(), ["rewards"]);
    let mut trial = out.begin("Trial1").unwrap();
    trial.push("env_infos/obs_dict/pos_ee", &[3], &pose[..3]).unwrap();
    assert!(message(trial.finish()).contains("derived/pose_ee"));
    let mut trial = out.begin("Trial2").unwrap();
    assert!(message(trial.push("actions", &[5], &actions[..5])).contains("no parts of 7"));
    drop(trial);
    out.close().unwrap();
    let trace = TraceReader::open(&path).unwrap();
    assert_eq!(trace.layout("Trial0").unwrap(), Some(Layout::RoboSet));
    assert_eq!(
        read(&trace, "Trial0", "data/ctrl_arm").values.to_f64(),
        [&actions[..7], &actions[..7]].concat()
    );
    assert_eq!(read(&trace, "Trial0", "data/ctrl_ee").shape, [2, 2]);
    assert_eq!(read(&trace, "Trial0", "derived/pose_ee").values.to_f64(), [&pose[..], &pose[..]].concat());
}

/// What h5py wrote goes to HDF5 of ours, to a numpy archive and back, and nothing changes.
#[test]
fn conversions_keep_every_number() {
    for name in ["robohive.h5", "roboset.h5"] {
        let trace = fixture(name);
        let (h5, npz) = (scratch(&format!("to_{name}")), scratch(&format!("{name}.npz")));
        let done = convert(&trace, &h5, Target::default()).unwrap();
        assert!(done.dropped.is_empty(), "{:?}", done.dropped);
        let ours = TraceReader::open(&h5).unwrap();
        let done = convert(&ours, &npz, Target::default()).unwrap();
        let named: Vec<_> = done.dropped.iter().map(|(key, _)| &key[..]).collect();
        assert_eq!(
            named,
            if name == "roboset.h5" {
                vec!["attribute writer", "config/task"]
            } else {
                vec!["attribute writer"]
            }
        );
        let archive = TraceReader::open(&npz).unwrap();
        assert_eq!(ours.trials(), trace.trials());
        assert_eq!(archive.trials(), trace.trials());
        for entry in trace.trials().iter().flat_map(|trial| trace.entries(trial).unwrap()) {
            let own = ours.entry(&entry.trial, &entry.key).unwrap();
            assert_eq!((&own.shape, &own.kind), (&entry.shape, &entry.kind));
            if entry.kind == EntryType::Text {
                assert_eq!(ours.texts(&own).unwrap(), trace.texts(&entry).unwrap());
                continue;
            }
            let bytes = |array: Array| {
                let mut out = Vec::new();
                array.values.put_bytes(&mut out);
                out
            };
            let expected = bytes(trace.read(&entry).unwrap());
            assert!(bytes(ours.read(&own).unwrap()) == expected, "{}", entry.path());
            assert!(bytes(read(&archive, &entry.trial, &entry.key)) == expected, "{}", entry.path());
        }
    }
}

#[test]
fn layouts_are_converted_there_and_back() {
    let (set, back) = (scratch("set.h5"), scratch("back.h5"));
    let target = |layout| Target { layout: Some(layout), precision: Precision::Full };
    let trace = fixture("robohive.h5");
    let done = convert(&trace, &set, target(Layout::RoboSet)).unwrap();
    let named: Vec<_> = done.dropped.iter().map(|(key, _)| &key[..]).collect();
    let expected = [
        "done",
        "env_infos/rwd_dict/dense",
        "env_infos/solved",
        "env_infos/state/count",
        "observations",
        "rewards",
        "time",
    ];
    assert_eq!(named, expected);
    convert(&TraceReader::open(&set).unwrap(), &back, target(Layout::RoboHive)).unwrap();
    let again = TraceReader::open(&back).unwrap();
    assert_eq!(again.entries("Trial10").unwrap().len(), 9);
    for entry in again.entries("Trial10").unwrap() {
        let (a, b) = (again.read(&entry).unwrap(), read(&trace, "Trial10", &entry.key));
        assert_eq!((&a.shape, a.values.dtype()), (&b.shape, b.values.dtype()), "{}", entry.key);
        let equal = |(x, y): (f64, f64)| x == y || x.is_nan() && y.is_nan();
        assert!(a.values.to_f64().into_iter().zip(b.values.to_f64()).all(equal), "{}", entry.key);
    }
    let neither = scratch("neither.h5");
    let mut out = recorder(&neither);
    record_one(&mut out, "Trial0", &[1.0]);
    out.close().unwrap();
    let trace = TraceReader::open(&neither).unwrap();
    assert!(
        message(convert(&trace, &set, target(Layout::RoboSet))).contains("neither RoboHive's nor RoboSet's")
    );
}

#[test]
fn a_summary_counts_and_measures() {
    let summary = summarise(&fixture("robohive.h5")).unwrap();
    let [first, _, last] = &summary.trials[..] else { panic!("{summary:?}") };
    assert_eq!((first.rows, first.solved, last.solved), (12, Some(8), Some(0)));
    let column = |key: &str| first.columns.iter().find(|column| column.key == key).unwrap();
    assert_eq!((column("actions").nans, column("actions").kind.clone()), (8, EntryType::Number(Dtype::F64)));
    assert_eq!(column("env_infos/state/count").range, Some((0.0, 11.0)));
    assert_eq!(column("env_infos/obs_dict/qv_arm").kind, EntryType::Number(Dtype::F16));
    let roboset = summarise(&fixture("roboset.h5")).unwrap();
    let task = roboset.trials[0].columns.iter().find(|column| column.key == "config/task").unwrap();
    assert_eq!(task.text.as_deref(), Some("open the drawer"));
}
