//! Episodes that `run --record` writes, and their replay.

mod command;

use command::{command, robohive, scratch, text};
use dataset::trace::TraceReader;
use env::{Arguments, Env, Options, OwnModels};
use record::Recorded;
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Stdio};

const ID: &str = "hive/FrankaReach-v0";

/// Records episodes; the standard output.
fn record(path: &Path, more: &[&str]) -> String {
    let file = path.to_str().unwrap();
    let out = robohive(&[&["run", ID, "-q", "--record", file], more].concat());
    assert!(out.status.success(), "{}", text(&out.stderr));
    text(&out.stdout)
}

/// What a replay says in JSON.
fn replay(path: &Path, more: &[&str]) -> Value {
    let out = robohive(&[&["data", "replay", path.to_str().unwrap(), "--json"], more].concat());
    assert!(out.status.success(), "{}", text(&out.stderr));
    serde_json::from_slice(&out.stdout).unwrap()
}

fn values(trace: &TraceReader, trial: &str, key: &str) -> Vec<f64> {
    trace.read(&trace.entry(trial, key).unwrap()).unwrap().values.to_f64()
}

fn shape(trace: &TraceReader, key: &str) -> Vec<usize> {
    trace.entry("Trial0", key).unwrap().shape
}

#[test]
fn a_recording_holds_the_schema_of_robohives_logger() {
    let path = scratch("schema.h5");
    let out = record(&path, &["--episodes", "3", "--seed", "300"]);
    assert!(out.contains("recorded     3 episodes"), "{out}");
    let trace = TraceReader::open(&path).unwrap();
    assert_eq!(trace.trials(), ["Trial0", "Trial1", "Trial2"]);
    let attributes = trace.attributes().unwrap();
    for (name, value) in [("env", ID), ("compat", "fixed"), ("policy", "random"), ("seed", "300")] {
        assert!(attributes.contains(&(name.into(), value.into())), "{attributes:?}");
    }
    let rows = shape(&trace, "time")[0];
    assert!(rows > 2);
    for (key, row) in [
        ("observations", vec![60]),
        ("actions", vec![8]),
        ("rewards", vec![]),
        ("done", vec![]),
        ("env_infos/time", vec![]),
        ("env_infos/rwd_dense", vec![]),
        ("env_infos/rwd_sparse", vec![]),
        ("env_infos/solved", vec![]),
        ("env_infos/done", vec![]),
        ("env_infos/obs_dict/time", vec![]),
        ("env_infos/obs_dict/qp_robot", vec![30]),
        ("env_infos/proprio_dict/time", vec![1]),
        ("env_infos/rwd_dict/reach", vec![]),
        ("env_infos/rwd_dict/dense", vec![]),
        ("env_infos/state/time", vec![]),
        ("env_infos/state/qpos", vec![30]),
        ("env_infos/state/act", vec![]),
    ] {
        assert_eq!(shape(&trace, key), [&[rows], &row[..]].concat(), "{key}");
    }
    let sites = shape(&trace, "env_infos/state/site_pos");
    assert!(sites[0] == rows && sites[1] > 1 && sites[2] == 3, "{sites:?}");
    let actions = values(&trace, "Trial0", "actions");
    let (taken, last) = actions.split_at(8 * (rows - 1));
    assert!(taken.iter().all(|x| x.is_finite()) && last.iter().all(|x| x.is_nan()));
    assert!(values(&trace, "Trial0", "env_infos/state/act").iter().all(|x| x.is_nan()));
    for (number, trial) in trace.trials().iter().enumerate() {
        assert_eq!(values(&trace, trial, "seed"), [300.0 + number as f64]);
        let time = values(&trace, trial, "env_infos/state/time");
        assert!(time[0] == 0.0 && time.windows(2).all(|pair| pair[0] < pair[1]));
        // The reward of a row belongs to the state of the same row: it is the sum of its weighted terms.
        let reach = values(&trace, trial, "env_infos/rwd_dict/reach");
        assert_eq!(
            values(&trace, trial, "env_infos/rwd_sparse"),
            reach.iter().map(|x| -x).collect::<Vec<_>>()
        );
    }
    let targets = ["Trial0", "Trial1"].map(|trial| values(&trace, trial, "env_infos/state/site_pos"));
    assert!(targets[0][..3 * sites[1]] != targets[1][..3 * sites[1]], "targets are drawn");
}

#[test]
fn a_recording_in_full_precision_is_replayed_exactly() {
    for name in ["exact.h5", "exact.npz"] {
        let path = scratch(name);
        record(&path, &["--episodes", "4", "--set", "frame_skip=20"]);
        // Numpy archives have no attributes.
        let named: &[&str] =
            if name.ends_with("npz") { &[ID, "--set", "frame_skip=20", "--compat", "fixed"] } else { &[] };
        let json = replay(&path, named);
        let trials = json["trials"].as_array().unwrap();
        assert_eq!((&json["id"], trials.len()), (&ID.into(), 4));
        for trial in trials {
            assert!(trial["steps"].as_u64().unwrap() > 1 && trial["from_seed"] == true, "{trial}");
            for key in ["qpos", "qvel", "observations", "rewards"] {
                assert_eq!(trial[key], 0.0, "{name}: {trial}");
            }
        }
        let alone = replay(&path, &[named, &["--trials", "3,1-1"]].concat());
        let alone: Vec<_> = alone["trials"].as_array().unwrap().iter().map(|trial| &trial["name"]).collect();
        assert_eq!(alone, ["Trial1", "Trial3"]);
    }
    let out = robohive(&["data", "replay", scratch("exact.h5").to_str().unwrap()]);
    assert!(text(&out.stdout).contains("exactly 0            4  ####"), "{}", text(&out.stdout));
}

#[test]
fn other_settings_and_rounded_actions_are_seen_in_the_last_state() {
    let (full, reduced) = (scratch("full.h5"), scratch("reduced.h5"));
    record(&full, &["--episodes", "2"]);
    record(&reduced, &["--episodes", "2", "--precision", "reduced", "--seed", "400"]);
    let json = replay(&full, &["--set", "frame_skip=38"]);
    assert!(json["trials"][0]["qpos"].as_f64().unwrap() > 1e-6, "{json}");
    let json = replay(&reduced, &[]);
    let trial = &json["trials"][1];
    assert!(trial["from_seed"] == true && trial["qpos"].as_f64().unwrap() > 0.0, "{json}");
    // Seeds keep all bits.
    let trace = TraceReader::open(&reduced).unwrap();
    assert_eq!(values(&trace, "Trial1", "seed"), [401.0]);
}

#[test]
fn robosets_layout_is_replayed_from_its_joints() {
    let path = scratch("layout.h5");
    let out = robohive(&["run", ID, "-q", "--layout", "roboset", "--record", path.to_str().unwrap()]);
    assert!(text(&out.stderr).contains("\"rewards\"") || text(&out.stderr).contains("\"done\""));
    let trace = TraceReader::open(&path).unwrap();
    assert_eq!(values(&trace, "Trial2", "config/seed"), [2.0]);
    assert_eq!(shape(&trace, "data/ctrl_ee")[1], 1);
    let json = replay(&path, &[]);
    assert!(
        json["trials"][0]["steps"].as_u64().unwrap() > 1 && json["trials"][0]["qpos"].is_null(),
        "{json}"
    );
}

#[test]
fn what_cannot_be_replayed_is_refused_with_the_reason() {
    let path = scratch("refused.npz");
    record(&path, &["--episodes", "1"]);
    let refused = |more: &[&str]| {
        let out = robohive(&[&["data", "replay", path.to_str().unwrap()], more].concat());
        assert_eq!(out.status.code(), Some(2), "{}", text(&out.stdout));
        text(&out.stderr)
    };
    assert!(refused(&[]).contains("names no environment"));
    assert!(refused(&[ID, "--trials", "0-1"]).contains("1 trials, none of number 1"));
    assert!(refused(&[ID, "--trials", "2-1"]).contains("no list"));
    assert!(refused(&["hive/FrankaReach-v9"]).contains("did you mean"));
    let mut writer = dataset::NpzWriter::create(&path).unwrap();
    for (key, width) in [("actions", 8), ("env_infos/state/qpos", 3)] {
        let array = dataset::Array::f64(vec![2, width], vec![0.0; 2 * width]);
        writer.add(&format!("Trial0/{key}"), &array).unwrap();
    }
    writer.finish().unwrap();
    assert!(refused(&[ID]).contains("qpos has 3 values, and this environment has 30"));
}

/// A run that would take hours, whose episodes are told as they end.
fn long_run(path: &Path) -> Child {
    _ = std::fs::remove_file(path);
    let words = ["run", ID, "-q", "--each", "--episodes", "4000000000", "--record"];
    command().args(words).arg(path).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

#[cfg(unix)]
#[test]
fn signals_leave_every_finished_episode() {
    for (signal, code) in [("-INT", Some(130)), ("-KILL", None)] {
        let path = scratch(&format!("ended{signal}.h5"));
        let mut child = long_run(&path);
        let mut told = BufReader::new(child.stdout.take().unwrap()).lines();
        for seed in 0..3 {
            let line = told.next().unwrap().unwrap();
            assert!(line.starts_with(&format!("seed {seed}: ")), "{line}");
        }
        let status = std::process::Command::new("kill").args([signal, &child.id().to_string()]).status();
        assert!(status.unwrap().success());
        let finished = 3 + told.map_while(Result::ok).filter(|line| line.starts_with("seed ")).count();
        let out = child.wait_with_output().unwrap();
        assert_eq!(out.status.code(), code);
        let trials = TraceReader::open(&path).unwrap().trials().len();
        assert!((finished..=finished + 1).contains(&trials), "{finished} were finished, {trials} are there");
        if code.is_some() {
            let said = format!("interrupted in episode {finished}; ");
            assert!(text(&out.stderr).contains(&said), "{}", text(&out.stderr));
        }
        let json = replay(&path, &["--trials", "2"]);
        assert_eq!(json["trials"][0]["qpos"], 0.0);
    }
}

#[test]
fn physics_that_was_drawn_is_recorded_and_comes_back() {
    let path = scratch("drawn.h5");
    let factor = "factor = { low = [0.5], high = [2] }";
    let drawn = format!("physics_randomization={{ masses = [{{ {factor} }}], friction = [{{ {factor} }}] }}");
    record(&path, &["--episodes", "2", "--set", &drawn]);
    let replayed = replay(&path, &[]);
    for trial in replayed["trials"].as_array().unwrap() {
        assert_eq!(
            (&trial["qpos"], &trial["observations"]),
            (&Value::from(0.0), &Value::from(0.0)),
            "{trial}"
        );
    }
    let trace = TraceReader::open(&path).unwrap();
    let masses: Vec<_> = ["Trial0", "Trial1"]
        .map(|trial| values(&trace, trial, "physics_randomization/body/link5/mass"))
        .concat();
    assert!(masses[0] != masses[1] && masses.iter().all(|factor| (0.5..2.0).contains(factor)), "{masses:?}");

    // From another seed, by what was recorded alone.
    let options = Options::default().with_changes(drawn.parse::<Arguments>().unwrap());
    let mut env = Env::make(ID, &OwnModels, &options).unwrap();
    env.reset(Some(77)).unwrap();
    let recorded = Recorded::read(&trace, "Trial1").unwrap();
    assert!(recorded.restore_drawn(&mut env).unwrap());
    assert!(!recorded.restore_drawn(&mut env).unwrap(), "it is there already");
    let start = recorded.start(&env).unwrap();
    env.set_world(&start).unwrap();
    let mut step = 0;
    while let Some(action) = recorded.actions.row(step).filter(|action| action.iter().all(|x| !x.is_nan())) {
        env.step(action).unwrap();
        step += 1;
    }
    assert_eq!(recorded.part("qpos").unwrap().last().unwrap(), env.scene().data.state.qpos);
    let mut other = Env::make(ID, &OwnModels, &Options::default()).unwrap();
    let error = recorded.restore_drawn(&mut other).unwrap_err().to_string();
    assert!(error.contains("physics_randomization is not among the settings"), "{error}");
}
