//! Robots that are hardware: simulated servos behind real drivers, in two processes and in one.
#![cfg(unix)]

mod command;
mod serving;

use command::{ROOT, command, robohive, scratch, text};
use robot::Config;
use serving::{CONFIG, ID, Wire};
use std::io::{BufRead, BufReader, Write};
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
    run.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut start = || {
        let mut child = run.spawn().unwrap();
        // The person between two episodes.
        child.stdin.take().unwrap().write_all(b"\n").unwrap();
        child
    };
    let mut child = start();
    let flight = flights.join("legs.flight");
    let end = Instant::now() + Duration::from_secs(60);
    let commands = |flight: &Path| {
        let out = command().args(["hardware", "flight"]).arg(flight).output().unwrap();
        text(&out.stdout).lines().filter(|line| line.contains(" command ")).count()
    };
    // A reset is a hundred commands; some of the episode follow.
    while !flight.exists() || commands(&flight) < 110 {
        assert!(Instant::now() < end, "it runs");
        if child.try_wait().unwrap().is_some() {
            // On a busy machine the servos' process rests for longer than a driver bears; another try is none the worse.
            let said = text(&child.wait_with_output().unwrap().stderr);
            assert!(said.contains(" ms old"), "{said}");
            child = start();
        }
        sleep(Duration::from_millis(50));
    }
    let other = wire.robohive(&["hardware", "check"], &[]).output().unwrap();
    let said = text(&other.stderr);
    assert!(said.contains(&format!("another program (process {}) is using /dev/pts/", child.id())), "{said}");
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(commands(&flight) >= 110);
    // They come to rest, in however much time the machine gives their simulation.
    let mut before = positions(&wire);
    loop {
        sleep(Duration::from_millis(500));
        let after = positions(&wire);
        if before.iter().zip(&after).all(|(before, after)| (before - after).abs() < 0.02) {
            break;
        }
        assert!(Instant::now() < end, "they stand: {before:?} {after:?}");
        before = after;
    }
}

/// Ctrl-C while the robot moves: it is made safe, and not left where the process died.
#[test]
fn a_signal_ends_a_motion_and_leaves_the_robot_safe() {
    let wire = Wire::new("signalled.toml", &[]);
    for (signal, code) in [("-INT", 130), ("-TERM", 143)] {
        let flights = scratch("signalled_flights");
        std::fs::remove_dir_all(&flights).unwrap_or_default();
        let mut home = wire.robohive(&["hardware", "home"], &["--arm", "--flight"]);
        let mut child = home.arg(&flights).stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
        let flight = flights.join("legs.flight");
        let records = || text(&command().args(["hardware", "flight"]).arg(&flight).output().unwrap().stdout);
        while !flight.exists() || !records().contains(" command ") {
            assert!(child.try_wait().unwrap().is_none(), "it moves");
            sleep(Duration::from_millis(20));
        }
        let status = std::process::Command::new("kill").args([signal, &child.id().to_string()]).status();
        assert!(status.unwrap().success());
        let out = child.wait_with_output().unwrap();
        let (said, kept) = (text(&out.stderr), records());
        assert_eq!(out.status.code(), Some(code), "{said}");
        assert!(said.contains("its motion was ended before it was done"), "{said}");
        assert!(kept.contains("note     safe") && kept.contains("closed"), "{kept}");
    }
    // Who is waited for to prepare the surroundings can end it, too.
    let mut run = wire.robohive(&["run", ID, "--arm", "--hardware"], &[]);
    let mut child = run.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
    assert!(lines.any(|line| line.unwrap().contains("press Enter")));
    let status = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(status.unwrap().success());
    assert!(lines.any(|line| line.unwrap().contains("interrupted in episode 0")));
    let out = child.wait_with_output().unwrap();
    assert_eq!(out.status.code(), Some(130));
    let shown = text(&out.stdout);
    assert_eq!(
        shown,
        format!("{ID}: 0 episodes, 0 steps, random policy\n"),
        "without an episode there are no statistics"
    );
}

#[test]
fn a_check_of_a_device_that_goes_away_fails() {
    let mut wire = Wire::new("gone.toml", &[]);
    let mut check = wire.robohive(&["hardware", "check"], &["--samples", "100", "--rate", "20"]);
    let check = check.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    sleep(Duration::from_millis(1500));
    wire.kill();
    let out = check.wait_with_output().unwrap();
    let (shown, said) = (text(&out.stdout), text(&out.stderr));
    assert!(out.status.code() == Some(1) && said.contains("device 'legs': "), "{shown}{said}");
    assert!(shown.contains(" of 100, "), "{shown}");
}

#[test]
fn files_of_devices_are_named_and_kept() {
    let refuse = |arguments: &[&str], says: &str| {
        let out = robohive(arguments);
        let said = text(&out.stderr);
        assert!(!out.status.success() && said.contains(says), "{arguments:?}: {said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    };
    // A config is not replaced by that of its simulated devices.
    let config = scratch("own.toml");
    std::fs::copy(Path::new(ROOT).join(CONFIG), &config).unwrap();
    let own = config.to_str().unwrap();
    let before = std::fs::read(&config).unwrap();
    let serve = ["wire", "--config", own, "--env", ID, "--seconds", "0", "--out"];
    refuse(&[&serve[..], &[own]].concat(), "input and output are one file");
    assert_eq!(std::fs::read(&config).unwrap(), before);
    refuse(&[&serve[..], &["nowhere/served.toml"]].concat(), "there is no folder nowhere");
    let home = ["hardware", "home", CONFIG, "--rehearse", ID, "--arm", "--flight", own];
    refuse(&home, &format!("its record cannot begin: {own}: "));
    refuse(&["hardware", "flight", own], &format!("robohive: {own} is not a file of a flight recorder"));
}

#[test]
fn cameras_are_neither_monitored_nor_moved() {
    let of = |verb: &str, more: &[&str]| {
        let cameras =
            ["hardware", verb, "assets/franka/tasks/hardware.toml", "--device", "front", "--rehearse"];
        let out = robohive(&[&cameras[..], &["hive/FrankaReach-v0"], more].concat());
        assert_eq!(out.status.code(), Some(2));
        text(&out.stderr)
    };
    assert!(of("monitor", &["--seconds", "1"]).contains("`robohive hardware check` looks through them"));
    assert!(of("home", &["--arm"]).contains("no actuators to move"));
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
        ("hdr_id = 12 => hdr_id = 300", "hdr_id 300 of 'front_right_knee' is not the id of a servo"),
        ("pos_range = [-0.6, 0.6] => pos_range = 5", "pos_range"),
    ] {
        let path = wrong(change, "wrong.toml");
        let out = command().args(["hardware", "check"]).arg(&path).output().unwrap();
        let said = text(&out.stderr);
        assert!(!out.status.success() && said.contains(part), "{change}: {said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    // What is not there is no wrong input.
    let path = wrong("/dev/ttyUSB0 => /dev/ttyNONE", "wrong.toml");
    let out = command().args(["run", ID, "--arm", "--hardware"]).arg(&path).output().unwrap();
    assert_eq!(out.status.code(), Some(1), "{}", text(&out.stderr));
    let path = wrong("safe = \"off\" => model = \"AX-12\"", "wrong.toml");
    let out = command().args(["hardware", "check", "--rehearse", ID]).arg(&path).output().unwrap();
    let said = text(&out.stderr);
    assert!(
        said.contains("device 'legs': no servo 'AX-12' can be simulated; there are XM430-W350"),
        "{said}"
    );
    assert!(said.contains("AX-12A"), "{said}");
    let path = wrong("\"dynamixel\" => \"dinamixel\"", "wrong.toml");
    let out = command().args(["hardware", "check", "--rehearse", ID]).arg(&path).output().unwrap();
    let said = text(&out.stderr);
    assert!(
        said.contains("can be simulated: 'dinamixel' of device 'legs'; those that can are dynamixel"),
        "{said}"
    );
    let cut = scratch("cut.toml");
    let config = std::fs::read(Path::new(ROOT).join(CONFIG)).unwrap();
    std::fs::write(&cut, &config[..config.len() / 2]).unwrap();
    let out = command().args(["hardware", "check"]).arg(&cut).output().unwrap();
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("cut.toml:"), "{}", text(&out.stderr));
    let slow = command().args(["wire", "--ids", "300"]).output().unwrap();
    assert!(text(&slow.stderr).contains("not a list of ids"), "{}", text(&slow.stderr));
}

#[test]
fn calibration_finds_how_the_servos_are_mounted() {
    let right = std::fs::read_to_string(Path::new(ROOT).join(CONFIG)).unwrap();
    // The knee counts the other way and from elsewhere, and the hip has slipped; the config does not know it.
    let knee = "\"front_left_knee\", pos_range = [-1.57, 1.57], vel_range = [-6.0, 6.0], hdr_id = 22, ";
    let hip = "\"back_right_hip\", pos_range = [-0.6, 0.6], vel_range = [-6.0, 6.0], hdr_id = 40, ";
    let mounted_text = right
        .replace(&format!("{knee}offset = 3.141592653589793"), &format!("{knee}scale = -1, offset = 2.8"))
        .replace(&format!("{hip}offset = 3.141592653589793"), &format!("{hip}offset = 3.4"));
    assert_ne!(mounted_text, right);
    let (mounted, out) = (scratch("mounted.toml"), scratch("calibrated.toml"));
    std::fs::write(&mounted, &mounted_text).unwrap();
    let calibrate = |more: &[&str]| {
        let mut calibrate = command();
        calibrate.args(["hardware", "calibrate", CONFIG, "--rehearse", ID, "--force", "--mounted"]);
        calibrate.arg(&mounted).arg("--out").arg(&out).args(more).output().unwrap()
    };
    let run = calibrate(&[]);
    let shown = text(&run.stdout);
    assert!(run.status.success(), "{shown}{}", text(&run.stderr));
    assert_eq!(shown.matches("it counts the other way").count(), 1, "{shown}");
    let truth = Config::read(&mounted).unwrap().devices.remove(0);
    let found = Config::read(&out).unwrap().devices.remove(0);
    // A servo counts in 1.5 mrad, and the joint falls a little between the hand and the reading.
    let unit = protocol::dynamixel::Model::POSITION_UNIT;
    for (found, truth) in found.actuators.iter().zip(&truth.actuators) {
        assert_eq!(found.scale, truth.scale, "{}", truth.name);
        assert!((found.offset - truth.offset).abs() < 2.0 * unit, "{} {}", found.offset, truth.name);
    }
    for (sensor, actuator) in found.sensors.iter().zip(&found.actuators) {
        assert_eq!((sensor.scale, sensor.offset), (1.0 / actuator.scale, -actuator.offset / actuator.scale));
    }

    // One pose alone keeps the direction that the config has, and other joints as they are.
    let run = calibrate(&["--pose", "back_right_hip=0.25"]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let one = Config::read(&out).unwrap().devices.remove(0);
    let before = Config::read(Path::new(ROOT).join(CONFIG)).unwrap().devices.remove(0);
    assert!((one.actuators[9].offset - 3.4).abs() < 2.0 * unit, "{}", one.actuators[9].offset);
    assert_eq!(one.actuators[..9], before.actuators[..9]);
}

#[test]
fn calibration_refuses_poses_that_nobody_held() {
    let out = scratch("refused.toml");
    std::fs::remove_file(&out).unwrap_or_default();
    let calibrate = |more: &[&str]| {
        let mut calibrate = command();
        calibrate.args(["hardware", "calibrate", CONFIG, "--rehearse", ID, "--out"]).arg(&out).args(more);
        text(&calibrate.output().unwrap().stderr)
    };
    assert!(
        calibrate(&["--pose", "front_left_toe=1"])
            .contains("is named 'front_left_toe'; there are front_right_hip")
    );
    assert!(calibrate(&["--pose", "low"]).contains("'low' is no pose"));
    // Degrees, perhaps.
    assert!(calibrate(&["--pose", "front_left_knee=57"]).contains("outside its range, [-1.57, 1.57]"));
    assert!(calibrate(&["--tolerance", "nan"]).contains("a number above 0"));
    assert!(calibrate(&["--tolerance", "0.0001"]).contains("hold it still"));
    assert!(!out.exists());
    let wire = Wire::new("held_still.toml", &[]);
    // Somebody presses Enter without moving the robot.
    let mut still = wire.robohive(&["hardware", "calibrate"], &["--out"]);
    still.arg(&out).args(["--samples", "5", "--pose", "front_left_knee=-1", "--pose", "front_left_knee=1"]);
    let mut child = still.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(b"\n\n").unwrap();
    let said = text(&child.wait_with_output().unwrap().stderr);
    assert!(said.contains("'front_left_knee' of device 'legs': it moved by "), "{said}");
    assert!(said.contains("% of what the poses ask for"), "{said}");
    assert!(!out.exists());
}
