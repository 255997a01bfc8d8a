//! A leader arm on a pseudo-terminal: a hand moves its servos, and the robot of a session follows.

#![cfg(unix)]

mod command;
mod typing;

use command::{ROOT, robohive, scratch, text};
use dataset::trace::TraceReader;
use record::Recorded;
use robot::Config;
use rustix::termios::tcgetattr;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use typing::Typed;
use wire::{End, Plant, Shared, Terminal, rig, serve};

const ID: &str = "hive/FrankaReach-v0";
const JOINTS: usize = 7;

/// The leader of the tests of `robohive-teleop`, its servos at the end of a line of this test's own; its config.
fn leader(name: &str, port: &Path) -> std::path::PathBuf {
    let folder = scratch(name);
    std::fs::create_dir_all(&folder).unwrap();
    let files = Path::new(ROOT).join("src/teleop/tests/leader");
    for file in ["arm.xml", "servos.toml", "leader.toml"] {
        // A machine that others use lets a session wait now and then.
        let text =
            std::fs::read_to_string(files.join(file)).unwrap().replace("safe = ", "watchdog = 5.0, safe = ");
        std::fs::write(folder.join(file), text.replace("/dev/ttyUSB0", &port.display().to_string())).unwrap();
    }
    folder.join("leader.toml")
}

/// A hand that holds the joints there.
fn hold(bench: &Shared, joints: &[f64]) {
    let mut bench = bench.lock().unwrap();
    let places: Vec<(usize, f64)> = (1..=JOINTS)
        .map(|k| bench.plant().motor(&format!("joint{k}")).unwrap())
        .zip(joints.iter().copied())
        .collect();
    bench.plant_mut().hold(&places).unwrap();
}

fn torque(bench: &Shared) -> f64 {
    let bench = bench.lock().unwrap();
    (0..JOINTS).map(|motor| bench.plant().effort(motor).abs()).sum()
}

/// Ends the serving, whatever ends the test.
struct Stops<'a>(&'a AtomicBool);

impl Drop for Stops<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[test]
fn a_robot_follows_a_leader_on_a_serial_line_which_carries_its_weight() {
    let end = End::Terminal(Terminal::open().unwrap());
    let config = leader("leader", Path::new(&end.address()));
    let devices = Config::read(config.with_file_name("servos.toml")).unwrap();
    let model = mjcf::Loader::default().load(config.with_file_name("arm.xml")).unwrap().model;
    let (bench, rigged) = rig(&devices, Plant::new(model).unwrap(), true).unwrap();
    let mut ends = [(rigged[0].links[0].1, end)];
    let bench: Shared = Arc::new(Mutex::new(bench));
    let stop = AtomicBool::new(false);
    let file = scratch("led.h5");
    let start = [0.0, 0.0, 0.0, -FRAC_PI_2, 0.0, 1.8675, 0.0];
    let device = format!("leader:{}", config.display());
    std::thread::scope(|scope| {
        let _stops = Stops(&stop);
        scope.spawn(|| serve(&bench, &mut ends, &stop).unwrap());
        let arguments = [ID, "--device", &device, "--arm", "--record", file.to_str().unwrap()];
        let mut typed = Typed::start(&arguments, true);
        assert!(typed.all().contains("the leader arm drives"), "{}", typed.all());
        // Until now nothing carried the arm.
        hold(&bench, &start);
        typed.write(" ");
        (0..10).for_each(|_| typed.pause());
        // Released, it stays where it is.
        assert!(!typed.line().contains("PAUSED") && !typed.line().contains("far away"), "{}", typed.line());
        assert!(torque(&bench) > 0.5, "the servos carry the arm: {} N m", torque(&bench));
        let mut led = start;
        for _ in 0..20 {
            led[6] += 0.02;
            hold(&bench, &led);
            typed.pause();
        }
        typed.write("\r");
        typed.wait_for("episode 2");
        let single = tcgetattr(&typed.slave).unwrap();
        typed.write("\u{1b}[27u");
        let (status, said) = typed.end();
        assert!(status.success(), "{said}");
        let after = tcgetattr(&typed.slave).unwrap();
        assert!(single.local_modes != after.local_modes, "the terminal edits lines again");
    });
    let trace = TraceReader::open(&file).unwrap();
    let recorded = Recorded::read(&trace, "Trial0").unwrap();
    let last = recorded.part("qpos").unwrap().last().unwrap().to_vec();
    println!("led to 0.4 rad, the robot is at {:.3} rad", last[6]);
    assert!((last[6] - 0.4).abs() < 0.1, "{last:?}");
}

#[test]
fn a_leader_that_is_not_there_is_named() {
    let config = leader("no_leader", Path::new("/nonexistent/tty"));
    let says = |device: &str, expected: &str| {
        let out = robohive(&["teleop", ID, "--device", device]);
        assert!(!out.status.success());
        assert!(text(&out.stderr).contains(expected), "{}", text(&out.stderr));
    };
    says(&format!("leader:{}", config.display()), "/nonexistent/tty");
    says("leader:/nonexistent/leader.toml", "/nonexistent/leader.toml");
    says("leader:Cargo.toml", "the file has the unknown entry '");
}
