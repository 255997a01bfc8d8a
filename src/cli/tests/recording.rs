//! Trajectories that `sim --out` writes: from the initial state on, whatever ends the run.

mod command;

use command::{command, robohive, scratch, text};
use dataset::NpzReader;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::time::Duration;

const NAMES: [&str; 9] =
    ["act", "ctrl", "energy", "mocap_pos", "mocap_quat", "qpos", "qvel", "sensordata", "time"];

fn values(archive: &NpzReader, name: &str) -> Vec<f64> {
    archive.require(name).unwrap().values.to_f64()
}

/// The archive at `path`, complete: all arrays, equally many rows.
fn complete(path: &Path) -> (NpzReader, usize) {
    let archive = NpzReader::open(path).unwrap();
    assert_eq!(archive.names().collect::<Vec<_>>(), NAMES);
    let rows = archive.require("time").unwrap().rows();
    for name in NAMES {
        assert_eq!(archive.require(name).unwrap().rows(), rows, "{name}");
    }
    assert!(!parts(path).exists(), "the folder of arrays is left");
    (archive, rows)
}

fn parts(path: &Path) -> PathBuf {
    PathBuf::from(format!("{}.part", path.display()))
}

fn model(name: &str, xml: &str) -> String {
    let path = scratch(name);
    std::fs::write(&path, xml).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The first row is the keyframe, energies belong to the state of their row, and recording changes no step.
#[test]
fn rows_are_states_from_the_initial_one_on() {
    let (run, again, forward) = (scratch("run.npz"), scratch("again.npz"), scratch("forward.npz"));
    let paths = [&run, &again, &forward].map(|path| path.to_str().unwrap());
    let elbow = "assets/elbow/elbow.xml";
    let out = robohive(&["sim", elbow, "--seconds", "0.1", "--out", paths[0], "-q"]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    let (recorded, rows) = complete(&run);
    assert_eq!(rows, 51);
    let (time, qpos) = (values(&recorded, "time"), values(&recorded, "qpos"));
    assert_eq!((time[0], qpos.len()), (0.0, 102));
    assert!((time[50] - 0.1).abs() < 1e-12);

    let out = robohive(&["trace", elbow, "--in", paths[0], "--out", paths[1]]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    let stepped = values(&NpzReader::open(&again).unwrap(), "qpos");
    assert!(stepped[..100] == qpos[2..], "a step after recording differs from one without");
    assert!((qpos[100] - qpos[0]).abs() > 1e-6, "the elbow does not move");

    let fields = ["--fields", "energy,sensordata"];
    let out = robohive(
        &[&["trace", elbow, "--in", paths[0], "--out", paths[2], "--forward"], &fields[..]].concat(),
    );
    assert!(out.status.success(), "{}", text(&out.stderr));
    let computed = NpzReader::open(&forward).unwrap();
    let energy = values(&computed, "energy");
    assert!(energy == values(&recorded, "energy"), "energies are not those of the states");
    assert!(energy[0] != energy[100] && energy[101] > 0.0);
    for (a, b) in values(&computed, "sensordata").iter().zip(values(&recorded, "sensordata")) {
        assert!((a - b).abs() < 1e-9 * b.abs().max(1.0), "{a} beside {b}");
    }
}

/// Simulated time is what passes from the keyframe on.
#[test]
fn speed_does_not_count_the_clock_of_the_keyframe() {
    let file = model(
        "late.xml",
        "<mujoco><worldbody><body><freejoint/><geom size='0.1'/></body></worldbody>
        <keyframe><key name='late' time='5000'/></keyframe></mujoco>",
    );
    let out = robohive(&["sim", &file, "--seconds", "0.2", "-q"]);
    let out = text(&out.stdout);
    assert!(out.contains("5000.200000 s after 100 steps"), "{out}");
    let line = out.lines().find_map(|line| line.strip_prefix("speed")).unwrap();
    let numbers: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    let [steps_per_second, ratio] = numbers[..] else { panic!("{line}") };
    assert!((ratio - 0.002 * steps_per_second).abs() < 0.06, "{line}");
}

/// A spring too stiff for its time step.
#[test]
fn instability_leaves_the_states_up_to_it() {
    let file = model(
        "unstable.xml",
        "<mujoco><option timestep='0.01'/><worldbody><body><joint type='slide' stiffness='1e9' damping='0'
        springref='1'/><geom size='0.1'/></body></worldbody><sensor><clock/></sensor></mujoco>",
    );
    let path = scratch("unstable.npz");
    let out = robohive(&["sim", &file, "--out", path.to_str().unwrap(), "-q"]);
    let error = text(&out.stderr);
    assert_eq!(out.status.code(), Some(1), "{error}");
    let (archive, rows) = complete(&path);
    assert!((2..100).contains(&rows), "{rows} rows");
    let (time, energy) = (values(&archive, "time"), values(&archive, "energy"));
    assert!(error.contains(&format!("at {:.6} s", time[rows - 1])), "{error}");
    assert!(error.contains("unstable.npz holds the motion up to there"), "{error}");
    assert!(energy[..2 * rows - 2].iter().all(|e| e.is_finite()) && energy[2 * rows - 1].is_nan());
}

#[test]
fn a_file_that_cannot_be_written_is_told_before_the_run() {
    let folder = scratch("no_such_folder/run.npz");
    let out =
        robohive(&["sim", "assets/elbow/elbow.xml", "--seconds", "1e6", "--out", folder.to_str().unwrap()]);
    assert_eq!(out.status.code(), Some(1));
    assert!(text(&out.stderr).contains("no_such_folder"), "{}", text(&out.stderr));
}

/// A run that would take hours, and the time array that it writes.
fn long_run(name: &str) -> (Child, PathBuf) {
    let path = scratch(name);
    _ = std::fs::remove_file(&path);
    let arguments = ["sim", "assets/elbow/elbow.xml", "--seconds", "1e6", "-q", "--out"];
    let child = command().args(arguments).arg(&path).stderr(Stdio::piped()).stdout(Stdio::piped()).spawn();
    (child.unwrap(), path)
}

/// Rows that a `.npy` file's header tells; none while there is no file.
fn rows_told(path: &Path) -> usize {
    let bytes = std::fs::read(path).unwrap_or_default();
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(128)]).into_owned();
    let rows = text.split_once("'shape': (").and_then(|(_, rest)| rest.split_once(','));
    rows.map_or(0, |(rows, _)| rows.parse().unwrap())
}

fn wait_for_rows(child: &mut Child, path: &Path) -> usize {
    loop {
        let rows = rows_told(&parts(path).join("time.npy"));
        if rows > 0 {
            return rows;
        }
        assert!(child.try_wait().unwrap().is_none(), "the run ended by itself");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[cfg(unix)]
fn signal(child: &Child, name: &str) {
    let status = std::process::Command::new("kill").args([name, &child.id().to_string()]).status();
    assert!(status.unwrap().success());
}

#[cfg(unix)]
#[test]
fn signals_end_a_run_with_a_complete_file() {
    for (name, code) in [("-INT", 130), ("-TERM", 143)] {
        let (mut child, path) = long_run(&format!("signal{code}.npz"));
        let told = wait_for_rows(&mut child, &path);
        signal(&child, name);
        let out = child.wait_with_output().unwrap();
        assert_eq!(out.status.code(), Some(code), "{}", text(&out.stderr));
        let (archive, rows) = complete(&path);
        assert!(rows >= told, "{rows} rows, {told} were there before");
        let time = values(&archive, "time");
        let end = format!("interrupted at {:.6} s", time[rows - 1]);
        assert!(text(&out.stderr).contains(&end), "{end}: {}", text(&out.stderr));
        assert_eq!(time[0], 0.0);
        assert!(time.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(values(&archive, "energy").iter().all(|e| e.is_finite()));
    }
}

/// What a killed process leaves can be read, and the next run replaces it.
#[cfg(unix)]
#[test]
fn a_killed_run_leaves_readable_arrays() {
    let (mut child, path) = long_run("killed.npz");
    wait_for_rows(&mut child, &path);
    let busy = robohive(&["sim", "assets/elbow/elbow.xml", "-q", "--out", path.to_str().unwrap()]);
    assert_eq!(busy.status.code(), Some(1));
    assert!(text(&busy.stderr).contains("another process"), "{}", text(&busy.stderr));
    signal(&child, "-KILL");
    child.wait().unwrap();
    for name in NAMES {
        let file = parts(&path).join(format!("{name}.npy"));
        let rows = rows_told(&file) as u64;
        let width = match name {
            "time" => 1,
            "energy" | "qpos" | "qvel" => 2,
            _ => 0,
        };
        assert!(rows > 0 && std::fs::metadata(&file).unwrap().len() >= 128 + 8 * width * rows, "{name}");
    }
    let out = robohive(&["sim", "assets/elbow/elbow.xml", "-q", "--out", path.to_str().unwrap()]);
    assert!(out.status.success(), "{}", text(&out.stderr));
    assert_eq!(complete(&path).1, 501);
}
