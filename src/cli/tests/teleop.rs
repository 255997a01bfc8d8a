//! Sessions by hand, typed into a terminal of the test's own.

#![cfg(unix)]

mod command;
mod typing;

use command::{robohive, scratch, text};
use dataset::trace::TraceReader;
use env::{Env, Options, OwnModels};
use exchange::lerobot::LeRobotReader;
use record::Recorded;
use rustix::termios::tcgetattr;
use std::path::Path;
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use typing::Typed;
use wire::adb::{Server, Shown};
use wire::{Bench, Carries, End, Plant, serve};

const ID: &str = "hive/FrankaReach-v0";

/// Where the hand is [m].
fn hand(typed: &Typed) -> [f64; 3] {
    let line = typed.line();
    let (_, after) = line.split_once("hand ").unwrap();
    let numbers: Vec<f64> = after.split(' ').map_while(|word| word.parse().ok()).collect();
    numbers[..3].try_into().unwrap()
}

/// Where the target of a seed is [m].
fn target(seed: u64) -> [f64; 3] {
    let mut env = Env::make(ID, &OwnModels, &Options::default()).unwrap();
    env.reset(Some(seed)).unwrap();
    let scene = env.scene();
    scene.data.kin.site_xpos[scene.model.site("target").unwrap().index()]
}

/// Brings the hand to a target as a person does who sees both: strikes of the keys of each axis on which they are apart.
fn reach(typed: &mut Typed, target: [f64; 3]) {
    const KEYS: [[char; 2]; 3] = [['a', 'd'], ['x', 'w'], ['z', 'q']];
    let began = Instant::now();
    while !typed.line().contains("solved") {
        assert!(began.elapsed() < Duration::from_secs(60), "{target:?} is not reached: {}", typed.line());
        let hand = hand(typed);
        for (axis, [less, more]) in KEYS.into_iter().enumerate() {
            let way = target[axis] - hand[axis];
            if way.abs() > 0.015 {
                let key = u32::from(if way > 0.0 { more } else { less });
                typed.write(&format!("\u{1b}[{key};1:1u\u{1b}[{key};1:3u"));
            }
        }
        typed.pause();
    }
}

fn number_after(text: &str, before: &str) -> f64 {
    let (_, after) = text.split_once(before).unwrap_or_else(|| panic!("no {before:?} in {text}"));
    let word: String = after.trim_start().chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
    word.parse().unwrap_or_else(|_| panic!("{before}{after}"))
}

#[test]
fn typed_keys_solve_the_task_and_the_recording_loads() {
    let file = scratch("teleop.h5");
    let mut typed = Typed::start(&[ID, "--record", file.to_str().unwrap(), "--seed", "8"], true);
    let single = tcgetattr(&typed.slave).unwrap();
    reach(&mut typed, target(8));
    typed.write("\r");
    typed.wait_for("episode 2  seed 9");
    // A second one, gone back in and given up.
    typed.write("\u{1b}[97;1:1u");
    (0..4).for_each(|_| typed.pause());
    typed.write("\u{1b}[97;1:3u\u{1b}[98;1:1u");
    (0..3).for_each(|_| typed.pause());
    typed.write("\u{1b}[98;1:3u");
    typed.wait_for("PAUSED");
    typed.write("\u{1b}[127u");
    typed.wait_for("episode 3  seed 10");
    let slave = typed.slave.try_clone().unwrap();
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success(), "{said}");
    assert!(said.contains("2 episodes kept, 1 succeeded, 0 thrown away"), "{said}");
    assert!(said.contains("2 episodes in"), "{said}");
    let after = tcgetattr(&slave).unwrap();
    assert!(single.local_modes != after.local_modes, "the terminal edits lines again");
    assert!(said.contains("\u{1b}[<u"), "and reports keys as before");
    let (middle, late) = (number_after(&said, "latency "), number_after(&said, "(p50), "));
    let rate = number_after(&said, &format!("{},", number_after(&said, "ticks ")));
    println!("latency {middle} ms (p50), {late} ms (p99); {rate} ticks a second");
    assert!((6.0..13.0).contains(&rate), "ticks last 0.08 s: {said}");
    assert!(middle <= late && middle > 0.0);

    let trace = TraceReader::open(&file).unwrap();
    let judged: Vec<f64> = ["Trial0", "Trial1"]
        .into_iter()
        .map(|trial| {
            let entries = trace.entries(trial).unwrap();
            let entry = entries.into_iter().find(|entry| entry.key == "teleop/success").unwrap();
            trace.read(&entry).unwrap().values.to_f64()[0]
        })
        .collect();
    assert_eq!(judged, [1.0, 0.0]);
    let recorded = Recorded::read(&trace, "Trial0").unwrap();
    assert_eq!(recorded.seed, Some(8));
    let solved =
        trace.entries("Trial0").unwrap().into_iter().find(|entry| entry.key == "env_infos/solved").unwrap();
    assert!(trace.read(&solved).unwrap().values.to_f64().contains(&1.0), "the task was solved");
    let out = robohive(&["data", "replay", file.to_str().unwrap()]);
    assert!(out.status.success(), "{}{}", text(&out.stdout), text(&out.stderr));
}

#[test]
fn typed_keys_walk_a_quadruped() {
    let file = scratch("walk.h5");
    let arguments = ["hive/QuadrupedWalk-v0", "--control", "base", "--horizon", "30"];
    let mut typed = Typed::start(&[&arguments[..], &["--record", file.to_str().unwrap()]].concat(), true);
    typed.write("\u{1b}[119;1:1u");
    typed.wait_for("episode 2  seed 1");
    typed.write("\u{1b}[119;1:3u\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success(), "{said}");
    let trace = TraceReader::open(&file).unwrap();
    let recorded = Recorded::read(&trace, "Trial0").unwrap();
    let qpos = recorded.part("qpos").unwrap();
    let ahead = qpos.last().unwrap()[1] - qpos.row(0).unwrap()[1];
    println!("three seconds of w: {ahead:.3} m ahead");
    assert!((0.3..0.7).contains(&ahead), "0.2 m/s for three seconds: {ahead} m");
}

#[test]
fn a_person_takes_over_from_a_policy_and_gives_back() {
    let file = scratch("shared.h5");
    let mut typed = Typed::start(&[ID, "--policy", "random", "--record", file.to_str().unwrap()], true);
    assert!(typed.line().contains("policy acts") && typed.line().contains("PAUSED"), "{}", typed.line());
    typed.write(" ");
    (0..4).for_each(|_| typed.pause());
    assert!(typed.line().contains("policy acts") && !typed.line().contains("PAUSED"), "{}", typed.line());
    typed.write("\u{1b}[119;1:1u\u{1b}[119;1:3u");
    typed.wait_for("BY HAND");
    (0..3).for_each(|_| typed.pause());
    typed.write("p");
    (0..4).for_each(|_| typed.pause());
    assert!(typed.line().contains("policy acts"), "{}", typed.line());
    typed.write("\r");
    typed.wait_for("episode 2");
    typed.write("\u{1b}[27u");
    let (status, said) = typed.end();
    assert!(status.success(), "{said}");
    let trace = TraceReader::open(&file).unwrap();
    let find = |key: &str| trace.entries("Trial0").unwrap().into_iter().find(|entry| entry.key == key);
    let by_hand = trace.read(&find("env_infos/intervention").unwrap()).unwrap().values.to_f64();
    let steps = by_hand.len() - 1;
    let hand = by_hand.iter().filter(|x| **x != 0.0).count();
    let acted = format!("{hand} steps by hand, {} by the policy", steps - hand);
    assert!(hand >= 2 && by_hand[0] == 0.0 && by_hand[steps - 1] == 0.0, "{by_hand:?}");
    assert!(said.contains(&acted), "{acted}: {said}");
    let out = robohive(&["teleop", ID, "--policy", "/nonexistent/policy.pickle"]);
    assert_eq!(out.status.code(), Some(2));
    assert!(text(&out.stderr).contains("/nonexistent/policy.pickle"), "{}", text(&out.stderr));
}

#[test]
fn a_kill_loses_no_finished_episode() {
    let file = scratch("killed.h5");
    let arguments = [ID, "--record", file.to_str().unwrap(), "--horizon", "3"];
    let mut typed = Typed::start(&arguments, true);
    typed.write("\u{1b}[100;1:1u");
    typed.wait_for("episode 3  seed 2");
    typed.child.kill().unwrap();
    typed.child.wait().unwrap();
    let trace = TraceReader::open(&file).unwrap();
    for trial in ["Trial0", "Trial1"] {
        let recorded = Recorded::read(&trace, trial).unwrap();
        assert!(recorded.actions.row(3).is_some() && recorded.actions.row(4).is_none());
    }
}

#[test]
fn a_kill_loses_no_finished_episode_of_a_dataset_which_then_goes_on() {
    let root = scratch("killed_dataset");
    _ = std::fs::remove_dir_all(&root);
    let path = root.to_str().unwrap();
    let arguments = [ID, "--record", path, "--layout", "lerobot", "--task", "reach", "--horizon", "3"];
    let mut typed = Typed::start(&arguments, true);
    typed.write("\u{1b}[100;1:1u");
    typed.wait_for("episode 3  seed 2");
    typed.child.kill().unwrap();
    typed.child.wait().unwrap();
    let killed = LeRobotReader::open(&root).unwrap();
    let kept = killed.episodes();
    assert!(kept >= 2, "{kept}");
    // Another session goes on.
    let mut typed = Typed::start(&[&arguments[..], &["--episodes", "2", "--seed", "40"]].concat(), true);
    typed.write("\u{1b}[100;1:1u");
    let (status, said) = typed.end();
    assert!(
        status.success() && said.contains(&format!("2 episodes in {path}, which has {}", kept + 2)),
        "{said}"
    );
    let reader = LeRobotReader::open(&root).unwrap();
    assert_eq!((reader.episodes(), reader.task(0), reader.task(1)), (kept + 2, Some("reach"), None));
    let length = |columns: &[exchange::lerobot::Column]| {
        columns.iter().find(|column| column.name == "judged_success").unwrap().cells.len()
    };
    for episode in 0..kept {
        let columns = reader.read(episode).unwrap();
        assert_eq!((&columns, length(&columns)), (&killed.read(episode).unwrap(), 3));
    }
    assert_eq!(length(&reader.read(kept + 1).unwrap()), 3);
    // What does not fit is refused before anybody drives.
    let refused = |arguments: &[&str]| {
        let out = robohive(&[&["teleop"], arguments].concat());
        assert!(!out.status.success());
        text(&out.stderr)
    };
    let other = [ID, "--set", "obs_keys=[\"time\"]", "--record", path, "--layout", "lerobot"];
    let (status, said) = Typed::open(&other).end();
    assert!(
        !status.success() && said.contains("observation.state") && said.contains("in the first episode"),
        "{said}"
    );
    // Cameras are videos of it.
    let root = scratch("filmed_dataset");
    _ = std::fs::remove_dir_all(&root);
    let arguments =
        ["hive/FrankaReach_v2d-v0", "--layout", "lerobot", "--visual", "--horizon", "2", "--episodes", "1"];
    let mut typed = Typed::start(&[&arguments[..], &["--record", root.to_str().unwrap()]].concat(), true);
    typed.write("\u{1b}[100;1:1u");
    let (status, said) = typed.end();
    assert!(status.success(), "{said}");
    let reader = LeRobotReader::open(&root).unwrap();
    let films = reader.features().iter().find(|feature| feature.name == "observation.images.front").unwrap();
    assert_eq!((films.kind.name(), &films.shape[..]), ("video", &[224, 224, 3][..]));
    assert!(root.join("videos/observation.images.front/chunk-000/file-000.mp4").is_file());
    let said = refused(&[ID, "--record", "reach.h5", "--layout", "lerobot"]);
    assert!(said.contains("writes a folder: remove the extension"), "{said}");
    let said = refused(&[ID, "--record", path]);
    assert!(said.contains("--layout lerobot writes a folder"), "{said}");
}

#[test]
fn a_terminal_that_goes_leaves_whole_files() {
    let file = scratch("gone.npz");
    let mut typed = Typed::start(&[ID, "--record", file.to_str().unwrap(), "--horizon", "2"], true);
    typed.write("\u{1b}[100;1:1u\u{1b}[100;1:3u");
    typed.wait_for("hand");
    typed.write("\u{1b}[100;1:1u");
    typed.wait_for("episode 2  seed 1");
    // A window that is closed sends the first signal; what the program then writes, nobody reads.
    let interrupt = Command::new("kill").args(["-HUP", &typed.child.id().to_string()]).status().unwrap();
    assert!(interrupt.success());
    let (status, said) = typed.end();
    assert_eq!(status.code(), Some(129), "{said}");
    let trace = TraceReader::open(&file).unwrap();
    assert!(Recorded::read(&trace, "Trial0").unwrap().actions.row(2).is_some());
}

#[test]
fn a_plain_terminal_repeats_keys_and_an_interrupt_ends() {
    let mut typed = Typed::start(&[ID], false);
    let start = hand(&typed);
    for _ in 0..20 {
        typed.write("z");
        std::thread::sleep(Duration::from_millis(40));
    }
    let way = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    // Nothing tells that the key is up, and the hand comes to rest all the same.
    let mut places = vec![hand(&typed)];
    while places.len() < 5 || way(places[places.len() - 1], places[places.len() - 4]) > 0.01 {
        assert!(places.len() < 100, "it does not stop: {places:?}");
        typed.pause();
        places.push(hand(&typed));
    }
    let stopped = places[places.len() - 1];
    assert!(stopped[2] < start[2] - 0.1, "{start:?} {stopped:?}");
    // What a terminal makes of Ctrl-C for the program that it belongs to.
    let interrupt = Command::new("kill").args(["-INT", &typed.child.id().to_string()]).status().unwrap();
    assert!(interrupt.success());
    let (status, said) = typed.end();
    assert!(said.contains("0 episodes kept"), "{said}");
    assert_eq!(status.code(), Some(130), "{said}");
}

#[test]
fn what_cannot_be_opened_is_named_with_what_to_do() {
    let out = robohive(&["teleop", ID]);
    assert_eq!(out.status.code(), Some(1));
    assert!(text(&out.stderr).contains("run the command in a terminal"), "{}", text(&out.stderr));
    let cases: [(&[&str], &str); 16] = [
        (&[ID, "--device", "openxr:x"], "'x' is not a port"),
        (&[ID, "--device", "openxr", "--path", "/dev/null"], "--path does not apply to openxr"),
        (&[ID, "--device", "gamepad", "--path", "/nonexistent/event3"], "/nonexistent/event3"),
        (&[ID, "--device", "quest:127.0.0.1:1"], "adb start-server"),
        (&[ID, "--device", "quest:headset"], "is not the address"),
        (&[ID, "--device", "quest:127.0.0.1:1", "--path", "/dev/null"], "give only one of them"),
        (&[ID, "--device", "glove:/dev/null"], "--calibration FILE"),
        (&[ID, "--calibration", "/dev/null"], "--device glove:PORT"),
        (&[ID, "--device", "glove:/dev/null", "--calibration", "/nonexistent/glove.toml"], "glove.toml"),
        (&[ID, "--device", "glove:/dev/null", "--calibration", "Cargo.toml"], "it lacks the list"),
        (&[ID, "--path", "/dev/null"], "--device"),
        (&["hive/ElbowPose-v0"], "--site"),
        (&[ID, "--mapping", "/nonexistent/keys.toml"], "keys.toml"),
        (&[ID, "--site", "nose"], "nose"),
        (&[ID, "--left-site", "ear"], "ear"),
        (&[ID, "--control", "base"], "free joint"),
    ];
    for (arguments, says) in cases {
        let out = robohive(&[&["teleop"], arguments].concat());
        assert!(!out.status.success());
        assert!(text(&out.stderr).contains(says), "{arguments:?}: {}", text(&out.stderr));
    }
    let printed = robohive(&["teleop", "--print-mapping"]);
    let file = scratch("keys.toml");
    std::fs::write(&file, &printed.stdout).unwrap();
    let out = robohive(&["teleop", ID, "--mapping", file.to_str().unwrap()]);
    assert!(text(&out.stderr).contains("no terminal"), "what it prints is a mapping: {}", text(&out.stderr));
    assert!(!Path::new("teleop.h5").exists());
}

#[test]
fn a_headset_drives_by_an_adb_server() {
    const SQUARE: [f64; 9] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    // A hand that goes down by a metre in four seconds while it grips; then it lets go, and presses A.
    let frame = |k: u32, buttons: &str| {
        let time = f64::from(k) / 72.0;
        let at = [0.0, -(time / 4.0), 0.0];
        Shown { time, hands: [None, Some((at, SQUARE))], buttons: buttons.to_owned() }
    };
    let script: Vec<Shown> =
        (0..72).map(|k| frame(k, "R,RG")).chain([frame(90, "R,A"), frame(91, "R")]).collect();
    let env = Env::make(ID, &OwnModels, &Options::default()).unwrap();
    let mut bench = Bench::new(Plant::new(env.scene().model.clone()).unwrap());
    let link = bench.connect(Box::new(Server::new("1WMHH", script)), Carries::AT_ONCE);
    let mut ends = [(link, End::tcp("127.0.0.1:0".parse().unwrap()).unwrap())];
    let device = format!("quest:{}", ends[0].1.address());
    let (bench, stop) = (Mutex::new(bench).into(), AtomicBool::new(false));
    let file = scratch("headset.h5");
    std::thread::scope(|scope| {
        scope.spawn(|| serve(&bench, &mut ends, &stop).unwrap());
        let mut typed = Typed::start(&[ID, "--device", &device, "--record", file.to_str().unwrap()], true);
        typed.wait_for("episode 2  seed 1");
        typed.write("\u{1b}[27u");
        let (status, said) = typed.end();
        stop.store(true, Ordering::Relaxed);
        assert!(status.success() && said.contains("1 episodes kept, 1 succeeded"), "{said}");
    });
    let trace = TraceReader::open(&file).unwrap();
    let recorded = Recorded::read(&trace, "Trial0").unwrap();
    assert!(recorded.actions.row(8).is_some(), "a second of ticks of 0.08 s");
}
