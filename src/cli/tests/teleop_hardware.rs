//! Sessions by hand whose robot is hardware: drivers of servos, with simulated servos behind them.

#![cfg(unix)]

mod command;
mod serving;
mod typing;

use command::{robohive, scratch, text};
use dataset::trace::TraceReader;
use record::Recorded;
use rustix::termios::{LocalModes, tcgetattr};
use serving::{CONFIG, ID, Wire};
use std::time::{Duration, Instant};
use typing::Typed;

/// Arguments of a session on rehearsed hardware.
fn rehearsed<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&[ID, "--control", "joints", "--hardware", CONFIG, "--rehearse"], more].concat()
}

/// The seconds of the episode that the line shows.
fn seconds(typed: &Typed) -> f64 {
    let line = typed.line();
    let (_, after) = line.split_once("seed 0  ").unwrap_or_else(|| panic!("{line}"));
    after.split(' ').next().unwrap().parse().unwrap()
}

/// Waits until the status line shows at least this episode time.
fn until(typed: &Typed, time: f64) {
    let began = Instant::now();
    while seconds(typed) < time {
        assert!(began.elapsed() < Duration::from_secs(60), "{time} s do not pass: {}", typed.line());
        typed.pause();
    }
}

#[test]
fn servos_are_driven_paused_and_stopped_and_time_does_not_go_back() {
    let file = scratch("servos.h5");
    let mut typed = Typed::start(&rehearsed(&["--arm", "--record", file.to_str().unwrap()]), true);
    // Before the first motion the servos rest, for longer than their watchdog would wait for a command.
    (0..6).for_each(|_| typed.pause());
    assert!(typed.line().contains("PAUSED"), "{}", typed.line());
    // Joint 2 while its key is held.
    typed.write("\u{1b}[51;1:1u");
    until(&typed, 0.5);
    typed.write("\u{1b}[51;1:3u");
    until(&typed, 1.5);
    typed.write("\u{1b}[98;1:1u\u{1b}[98;1:3u");
    typed.wait_for("hardware cannot go back in time");
    typed.write("\u{1b}[115;1:1u\u{1b}[115;1:3u");
    typed.wait_for("hardware has no slow motion");
    // A pause is longer than the watchdogs' quarter of a second, and ends with a motion.
    typed.write("\u{1b}[32;1:1u\u{1b}[32;1:3u");
    typed.wait_for("PAUSED");
    (0..8).for_each(|_| typed.pause());
    let paused = seconds(&typed);
    (0..4).for_each(|_| typed.pause());
    assert_eq!(seconds(&typed), paused, "time stands still");
    typed.write("\u{1b}[52;1:1u");
    (0..4).for_each(|_| typed.pause());
    typed.write("\u{1b}[52;1:3u");
    typed.pause();
    assert!(seconds(&typed) > paused, "{}", typed.all());
    typed.write("\r");
    typed.wait_for("episode 2  seed 1");
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success() && !said.contains("watchdog"), "{said}");
    assert!(said.contains("1 episodes kept, 1 succeeded"), "{said}");

    let trace = TraceReader::open(&file).unwrap();
    let recorded = Recorded::read(&trace, "Trial0").unwrap();
    let thigh: Vec<f64> = (0..).map_while(|row| Some(recorded.actions.row(row)?[1])).collect();
    let thigh = &thigh[..thigh.len() - 1];
    let (first, most) = (thigh[0], thigh.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    assert!(most > first + 0.2, "{thigh:?}");
    // Once the key is up, the same is sent again and again.
    let rests = thigh.windows(2).filter(|pair| (pair[0] - pair[1]).abs() < 1e-12).count();
    assert!(rests >= 6, "{thigh:?}");
}

#[test]
fn keys_that_are_not_repeated_stop_the_servos() {
    let file = scratch("stale.h5");
    let mut typed = Typed::start(&rehearsed(&["--arm", "--record", file.to_str().unwrap()]), false);
    // A terminal that tells no releases, and a connection that ends while the key is down.
    (0..3).for_each(|_| {
        typed.write("3");
        std::thread::sleep(Duration::from_millis(40));
    });
    until(&typed, 1.5);
    typed.write("\r");
    typed.wait_for("episode 2  seed 1");
    typed.write("\u{1b}");
    let (status, said) = typed.end();
    assert!(status.success(), "{said}");
    let recorded = Recorded::read(&TraceReader::open(&file).unwrap(), "Trial0").unwrap();
    let thigh: Vec<f64> = (0..15).map(|row| recorded.actions.row(row).unwrap()[1]).collect();
    let moved = thigh.windows(2).take_while(|pair| pair[1] > pair[0]).count();
    println!("moved in {} ticks of 0.1 s", moved + 1);
    assert!(thigh[8..].iter().all(|place| (place - thigh[14]).abs() < 1e-12), "{thigh:?}");
}

#[test]
fn nothing_moves_unarmed() {
    let mut typed = Typed::open(&rehearsed(&[]));
    let (status, said) = typed.end();
    assert_eq!(status.code(), Some(1), "{said}");
    assert!(said.contains("device 'legs': it refused: nothing moves before it is armed (--arm)"), "{said}");
    let after = tcgetattr(&typed.slave).unwrap();
    assert!(
        after.local_modes.contains(LocalModes::ICANON | LocalModes::ECHO),
        "the terminal edits lines again"
    );
    let pointless = robohive(&["teleop", ID, "--arm"]);
    assert_eq!(pointless.status.code(), Some(2));
    assert!(text(&pointless.stderr).contains("name their config with --hardware"));
    let mut typed = Typed::start(&rehearsed(&["--dry-run"]), true);
    typed.write("\u{1b}[51;1:1u");
    typed.wait_for("legs: would be sent [3.1");
}

#[test]
fn servos_in_real_time_are_driven_and_rest_when_the_session_ends() {
    let wire = Wire::new("driven.toml", &[]);
    let config = wire.config.to_str().unwrap();
    let common = [ID, "--control", "joints", "--arm", "--hardware", config];
    let mut typed = Typed::open(&[&common[..], &["--set", "act_mode=vel"]].concat());
    let (status, said) = typed.end();
    assert!(
        !status.success() && said.contains("in which it moves without input: add --set act_mode=pos"),
        "{said}"
    );

    // Ctrl-C on the way to the first episode.
    let mut typed = Typed::open(&common);
    typed.wait_for("\u{1b}[?u");
    let status = std::process::Command::new("kill").args(["-INT", &typed.child.id().to_string()]).status();
    assert!(status.unwrap().success());
    let (status, said) = typed.end();
    assert_eq!(status.code(), Some(130), "{said}");
    assert!(said.contains("its motion was ended before it was done"), "{said}");

    let mut typed = Typed::start(&common, true);
    typed.wait_for("the robot is at the start of an episode");
    typed.write("\u{1b}[51;1:1u");
    until(&typed, 0.3);
    typed.write("\u{1b}[51;1:3u\u{1b}[32;1:1u\u{1b}[32;1:3u");
    typed.wait_for("PAUSED");
    (0..8).for_each(|_| typed.pause());
    typed.write("\u{1b}[51;1:1u\u{1b}[51;1:3u");
    (0..3).for_each(|_| typed.pause());
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success() && !said.contains("watchdog"), "{said}");
    // Another program may have them now.
    let out = wire.robohive(&["hardware", "check"], &["--samples", "5"]).output().unwrap();
    assert!(out.status.success(), "{}", text(&out.stderr));
}

#[test]
fn a_policy_acts_on_servos_until_a_key_takes_over() {
    let mut typed = Typed::start(&rehearsed(&["--arm", "--policy", "zero"]), true);
    assert!(typed.line().contains("policy acts"), "{}", typed.line());
    typed.write("\u{1b}[32;1:1u\u{1b}[32;1:3u");
    until(&typed, 0.5);
    assert!(typed.line().contains("policy acts") && !typed.line().contains("PAUSED"), "{}", typed.line());
    typed.write("\u{1b}[51;1:1u\u{1b}[51;1:3u");
    typed.wait_for("BY HAND");
    let taken = seconds(&typed);
    until(&typed, taken + 0.5);
    typed.write("p");
    until(&typed, taken + 1.0);
    assert!(typed.line().contains("policy acts"), "{}", typed.line());
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success() && said.contains("steps by hand"), "{said}");
}

#[test]
fn a_trot_moves_the_legs_of_servos() {
    let file = scratch("trot.h5");
    let arguments = [ID, "--control", "base", "--hardware", CONFIG, "--rehearse", "--arm", "--record"];
    let mut typed = Typed::start(&[&arguments[..], &[file.to_str().unwrap()]].concat(), true);
    typed.write("\u{1b}[119;1:1u");
    until(&typed, 2.0);
    typed.write("\u{1b}[119;1:3u\r");
    typed.wait_for("episode 2");
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success() && !said.contains("watchdog"), "{said}");
    // What the servos measured: thighs swing, a diagonal against the other.
    let trace = TraceReader::open(&file).unwrap();
    let recorded = Recorded::read(&trace, "Trial0").unwrap();
    let qpos = recorded.part("qpos").unwrap();
    let thighs: Vec<[f64; 2]> =
        (8..).map_while(|row| Some([qpos.row(row)?[8], qpos.row(row)?[11]])).collect();
    let swing = |leg: usize| {
        let angles = thighs.iter().map(|pair| pair[leg]);
        angles.clone().fold(f64::MIN, f64::max) - angles.fold(f64::MAX, f64::min)
    };
    assert!(swing(0) > 0.1 && swing(1) > 0.1, "{thighs:?}");
}
