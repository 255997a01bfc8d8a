//! Robots that are hardware: simulated servos behind real drivers, in two processes and in one.
#![cfg(unix)]

mod command;
mod serving;

use command::{ROOT, command, robohive, scratch, text};
use serving::{CONFIG, ID, Wire};
use std::io::Write;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// What the servos measure now, in the units of the device.
fn positions(wire: &Wire) -> Vec<f64> {
    let out = wire.robohive(&["hardware", "monitor"], &["--seconds", "0.05"]).output().unwrap();
    let shown = text(&out.stdout);
    assert!(out.status.success(), "{shown}{}", text(&out.stderr));
    let lines = shown.lines().filter_map(|line| line.split_once('(')?.1.split_once(' '));
    let values: Vec<f64> = lines.map(|(value, _)| value.parse().unwrap()).collect();
    assert!(values.len() >= 12, "{shown}");
    values[values.len() - 12..].to_vec()
}

#[test]
fn a_rehearsal_runs_the_whole_way_and_nothing_moves_unarmed() {
    let run = |more: &[&str]| {
        let common = ["run", ID, "--episodes", "1", "--policy", "zero", "--set", "max_episode_steps=20"];
        robohive(&[&common[..], &["--hardware", CONFIG, "--rehearse"], more].concat())
    };
    let armed = run(&["--arm", "--json"]);
    let shown = text(&armed.stdout);
    assert!(shown.contains("\"steps\":20"), "{shown}{}", text(&armed.stderr));
    let unarmed = run(&[]);
    assert_eq!(unarmed.status.code(), Some(1));
    let said = text(&unarmed.stderr);
    assert!(said.contains("device 'legs': it refused: nothing moves before it is armed (--arm)"), "{said}");
    let dry = run(&["--dry-run"]);
    assert!(text(&dry.stderr).contains("legs: would be sent [3.1416"), "{}", text(&dry.stderr));
    let pointless = robohive(&["run", ID, "--arm"]);
    assert_eq!(pointless.status.code(), Some(2));
    assert!(text(&pointless.stderr).contains("name their config with --hardware"));
}

#[test]
fn a_killed_run_leaves_the_servos_standing_and_its_last_minutes_on_disk() {
    let wire = Wire::new("killed.toml", &[]);
    let flights = scratch("killed_flights");
    std::fs::remove_dir_all(&flights).unwrap_or_default();
    let mut run = command();
    run.args(["run", ID, "--episodes", "1", "--quiet", "--arm", "--hardware"])
        .arg(&wire.config)
        .arg("--flight")
        .arg(&flights);
    let mut child = run.stdin(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
    // The person between two episodes.
    child.stdin.take().unwrap().write_all(b"\n").unwrap();
    let flight = flights.join("legs.flight");
    let end = Instant::now() + Duration::from_secs(60);
    let commands = |flight: &Path| {
        let out = command().args(["hardware", "flight"]).arg(flight).output().unwrap();
        text(&out.stdout).lines().filter(|line| line.contains(" command ")).count()
    };
    // A reset is a hundred commands; some of the episode follow.
    while !flight.exists() || commands(&flight) < 110 {
        assert!(Instant::now() < end, "it runs");
        assert_eq!(child.try_wait().unwrap(), None, "it runs");
        sleep(Duration::from_millis(50));
    }
    let other = wire.robohive(&["hardware", "check"], &[]).output().unwrap();
    let said = text(&other.stderr);
    assert!(said.contains(&format!("another program (process {}) is using /dev/pts/", child.id())), "{said}");
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(commands(&flight) >= 110);
    sleep(Duration::from_millis(500));
    let before = positions(&wire);
    sleep(Duration::from_millis(500));
    let after = positions(&wire);
    for (before, after) in before.iter().zip(&after) {
        assert!((before - after).abs() < 0.02, "{before} {after}");
    }
}

#[test]
fn what_is_wrong_with_a_device_is_said_before_anything_moves() {
    let wrong = |text: &str, name: &str| {
        let path = scratch(name);
        let config = std::fs::read_to_string(Path::new(ROOT).join(CONFIG)).unwrap();
        let (from, to) = text.split_once(" => ").unwrap();
        assert!(config.contains(from));
        std::fs::write(&path, config.replace(from, to)).unwrap();
        path
    };
    for (change, part) in [
        ("\"dynamixel\" => \"dinamixel\"", "nothing drives the interface 'dinamixel'; there are dynamixel"),
        ("/dev/ttyUSB0 => /dev/ttyNONE", "/dev/ttyNONE at 1000000 baud: No such file or directory"),
        ("safe = \"off\" => save = 1", "'save' of its interface is not known; there are name, safe"),
        ("hdr_id = 12 => hdr_id = 300", "hdr_id 300 of 'front_right_knee_position' is no id of a servo"),
        ("pos_range = [-0.6, 0.6] => pos_range = 5", "pos_range"),
    ] {
        let path = wrong(change, "wrong.toml");
        let out = command().args(["hardware", "check"]).arg(&path).output().unwrap();
        let said = text(&out.stderr);
        assert!(!out.status.success() && said.contains(part), "{change}: {said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    let cut = scratch("cut.toml");
    let config = std::fs::read(Path::new(ROOT).join(CONFIG)).unwrap();
    std::fs::write(&cut, &config[..config.len() / 2]).unwrap();
    let out = command().args(["hardware", "check"]).arg(&cut).output().unwrap();
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("cut.toml:"), "{}", text(&out.stderr));
    let slow = command().args(["wire", "--ids", "300"]).output().unwrap();
    assert!(text(&slow.stderr).contains("no list of ids"), "{}", text(&slow.stderr));
}
