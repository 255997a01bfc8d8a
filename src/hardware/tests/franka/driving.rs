//! A robot over the arm: motion within limits, watchdogs, recovery.

use super::rig::{Rig, START, config};
use protocol::franka::Version;
use robot::{Clock, Fault, Robot, RobotError};
use wire::Rates;

/// A target that moves, from where the arm is ready.
fn action(k: u32) -> Vec<f64> {
    let t = f64::from(k) * 0.04;
    let mut action = START[..8].to_vec();
    for (joint, place) in action.iter_mut().enumerate().take(7) {
        *place += 0.3 * ((1.0 + 0.2 * joint as f64) * t).sin();
    }
    action[7] = if (k / 40).is_multiple_of(2) { 0.04 } else { 0.01 };
    action
}

fn drive(rig: &Rig, robot: &mut Robot, steps: u32) -> Result<(), RobotError> {
    let (data, mut clock) = (rig.data(), rig.clock());
    let mut rng = random::Generator::pcg64(1_u64);
    for k in 0..steps {
        robot.control(&rig.model, &data, &action(k), 0.04)?;
        clock.wait(0.04);
        robot.sense(&rig.model, &data, &mut rng);
    }
    Ok(())
}

#[test]
fn both_arms_follow_in_both_modes_without_a_reflex() {
    for version in [Version::V5, Version::V10] {
        for control in ["position", "impedance"] {
            let rig = Rig::new(version, |arm| arm);
            let mut robot = rig.robot(&config(&format!("control = '{control}'"))).unwrap();
            let mut rng = random::Generator::pcg64(1_u64);
            robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
            drive(&rig, &mut robot, 150)
                .unwrap_or_else(|error| panic!("{version:?} {control}: {error} at {:?}", rig.positions()));
            let last = action(149);
            for _ in 0..100 {
                robot.control(&rig.model, &rig.data(), &last, 10.0).unwrap_or_else(|error| {
                    panic!("{version:?} {control}: {error} at {:?}", rig.positions())
                });
                rig.clock().wait(0.04);
                robot.sense(&rig.model, &rig.data(), &mut rng);
            }
            // Where it is commanded to be it is told so exactly; friction of 0.2 N m keeps a joint with the stiffness of
            // 10 N m/rad up to 0.02 rad away from it.
            let (here, tolerance) = match control {
                "position" => (rig.commanded(), 0.0),
                _ => (rig.positions(), 0.02),
            };
            let away = here.iter().zip(&last).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(away <= tolerance, "{version:?} {control}: {away}");
            let finger = rig.bench.lock().unwrap().plant().position(7);
            assert!((finger - last[7]).abs() < 1e-3, "{finger}");
            robot.close().unwrap();
            rig.check_commands();
            let sent = rig.sent.lock().unwrap();
            assert!(sent.len() > 6500 && sent.last().unwrap().finished, "{}", sent.len());
        }
    }
}

#[test]
fn the_first_command_is_where_the_arm_was_and_silence_brings_it_to_rest() {
    let rig = Rig::new(Version::V5, |arm| arm);
    let mut robot = rig.robot(&config("control = 'position'")).unwrap();
    let mut rng = random::Generator::pcg64(1_u64);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    // Where it was commanded to be, not where gravity has let it sink.
    let first = rig.sent.lock().unwrap()[0].q;
    assert_eq!(first[..], START[..7]);
    drive(&rig, &mut robot, 30).unwrap();
    // The policy hangs: after a quarter of a second the motion comes to rest and ends.
    rig.clock().wait(0.25 + 0.4);
    let error = robot.control(&rig.model, &rig.data(), &action(31), 0.04).unwrap_err().to_string();
    assert!(error.contains("franka") && error.contains("no command came for 0.25 s"), "{error}");
    assert!(rig.sent.lock().unwrap().last().unwrap().finished);
    rig.check_commands();
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    drive(&rig, &mut robot, 10).unwrap();
    robot.close().unwrap();
}

#[test]
fn a_lost_network_stops_the_arm_in_twenty_milliseconds_and_a_reset_recovers() {
    let rig = Rig::new(Version::V5, |arm| arm);
    let mut robot = rig.robot(&config("control = 'position'")).unwrap();
    let mut rng = random::Generator::pcg64(1_u64);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    drive(&rig, &mut robot, 20).unwrap();
    let lost: Rates = "drop=1".parse().unwrap();
    rig.bench.lock().unwrap().inject(rig.arm[1], lost, 1);
    rig.clock().wait(0.0215);
    let error = robot.control(&rig.model, &rig.data(), &action(21), 0.04).unwrap_err();
    assert!(matches!(error, RobotError::Device { fault: Fault::Stale(20..=22), .. }), "{error:?}");
    rig.clock().wait(0.2);
    let held = rig.commanded();
    rig.clock().wait(0.5);
    assert_eq!(held, rig.commanded());
    let error = robot.reset(&rig.model, &rig.data(), &mut rng).unwrap_err().to_string();
    assert!(error.contains("says its state"), "{error}");
    rig.bench.lock().unwrap().inject(rig.arm[1], Rates::default(), 0);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    drive(&rig, &mut robot, 10).unwrap();
    robot.close().unwrap();
    rig.check_commands();
}

#[test]
fn a_killed_process_leaves_an_arm_that_stops_and_the_next_one_recovers() {
    let mut rig = Rig::new(Version::V10, |arm| arm);
    let mut robot = rig.robot(&config("control = 'impedance'")).unwrap();
    let mut rng = random::Generator::pcg64(1_u64);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    drive(&rig, &mut robot, 20).unwrap();
    // Time that nobody tends.
    wire::VirtualClock::new(rig.bench.clone()).wait(0.1);
    let error = drive(&rig, &mut robot, 2).unwrap_err().to_string();
    assert!(error.contains("communication_constraints_violation") || error.contains("ms old"), "{error}");
    std::mem::forget(robot);
    rig.restart();
    let mut robot = rig.robot(&config("control = 'impedance'")).unwrap();
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    drive(&rig, &mut robot, 10).unwrap();
    robot.close().unwrap();
}

#[test]
fn the_stop_button_is_named_and_obeyed() {
    let rig = Rig::new(Version::V5, |arm| arm);
    let mut robot = rig.robot(&config("control = 'position'")).unwrap();
    let mut rng = random::Generator::pcg64(1_u64);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    drive(&rig, &mut robot, 20).unwrap();
    rig.bench.lock().unwrap().stop_button(true);
    let error = drive(&rig, &mut robot, 3).unwrap_err().to_string();
    assert!(error.contains("franka") && error.contains("its stop button is pressed"), "{error}");
    let error = robot.reset(&rig.model, &rig.data(), &mut rng).unwrap_err().to_string();
    assert!(error.contains("its stop button is pressed"), "{error}");
    rig.bench.lock().unwrap().stop_button(false);
    robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
    drive(&rig, &mut robot, 10).unwrap();
    robot.close().unwrap();
}

#[test]
fn what_a_config_says_wrongly_is_named() {
    let rig = Rig::new(Version::V5, |arm| arm);
    for (parameters, part) in [
        (
            "gain = 1",
            "'gain' of its interface is not known; there are ip_address, control, interpolation, version",
        ),
        ("gain_scale = 7", "'gain_scale' of its interface is 7; it must be from 0 to 2"),
        ("control = 'torque'", "is 'torque'; there are impedance, position"),
        ("version = 7", "version = 7; there are 5 and 10"),
        ("version = 10", "the arm speaks version 5 of its interface, and not 10"),
        ("hand_port = 9", "nobody listens there"),
    ] {
        let error = rig.robot(&config(parameters)).err().expect(parameters).to_string();
        assert!(error.contains(part), "{error}");
    }
    // The file that people copy is one that the driver takes as it is.
    let text = include_str!("../../../../assets/franka/tasks/hardware.toml");
    let copied = robot::Config::from_toml(text, "hardware.toml").unwrap();
    rig.robot(&copied).unwrap().close().unwrap();
    let mut elsewhere = config("interpolation = 'none'");
    let address = robot::Value::Text("172.16.0.2".to_owned());
    elsewhere.devices[0].interface.parameters.insert("ip_address".to_owned(), address);
    let error = rig.robot(&elsewhere).err().unwrap().to_string();
    assert!(error.contains("only a simulated one at a loopback address"), "{error}");
}

#[test]
fn single_packets_that_are_lost_stop_no_motion() {
    for (seed, control) in [(1, "position"), (2, "position"), (3, "impedance")] {
        let rig = Rig::new(Version::V5, |arm| arm);
        let mut robot = rig.robot(&config(&format!("control = '{control}'"))).unwrap();
        let mut rng = random::Generator::pcg64(1_u64);
        // Three a second in each direction, for seven seconds.
        let lossy: Rates = "drop=0.003".parse().unwrap();
        rig.bench.lock().unwrap().inject(rig.arm[1], lossy, seed);
        robot.reset(&rig.model, &rig.data(), &mut rng).unwrap();
        drive(&rig, &mut robot, 150).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        assert!(rig.bench.lock().unwrap().struck(rig.arm[1]) > 25);
        robot.close().unwrap();
        rig.check_commands();
    }
}
