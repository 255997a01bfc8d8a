//! rustypot, a client that other people wrote, drives simulated Feetech servos through a pseudo-terminal.
#![cfg(unix)]

use rustypot::servo::feetech::sts3215::Sts3215Controller;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use wire::feetech::{Bus, Servo};
use wire::{Bench, Carries, End, Plant, Terminal, serve};

const ARM: &str = "<mujoco><option gravity='0 0 0'/><worldbody>
    <body><joint name='a' damping='.1' armature='.05'/><geom size='.05'/></body>
    <body pos='1 0 0'><joint name='b' damping='.1' armature='.05'/><geom size='.05'/></body></worldbody>
  <actuator><position name='a' joint='a' kp='20' kv='1'/><position name='b' joint='b' kp='20' kv='1'/></actuator></mujoco>";

#[test]
fn rustypot_moves_and_reads_an_arm_of_two() {
    let plant = Plant::new(mjcf::load_str(ARM).unwrap().model).unwrap();
    let mut servos = Vec::new();
    for (id, name) in [(1, "a"), (2, "b")] {
        let mut servo = Servo::new(id);
        servo.mount(plant.motor(name).unwrap(), 1.0, PI);
        servos.push(servo);
    }
    let mut bench = Bench::new(plant);
    let link = bench.connect(Box::new(Bus::new(servos).with_baud(1e6)), Carries::serial(1e6));
    let bench = Arc::new(Mutex::new(bench));
    let terminal = Terminal::open().unwrap();
    let path = terminal.path().to_string_lossy().into_owned();
    let stop = Arc::new(AtomicBool::new(false));
    let serving = {
        let (bench, stop) = (bench.clone(), stop.clone());
        std::thread::spawn(move || serve(&bench, &mut [(link, End::Terminal(terminal))], &stop))
    };
    let port = serialport::new(path, 1_000_000).timeout(Duration::from_secs(2)).open().unwrap();
    let mut arm = Sts3215Controller::new().with_protocol_v1().with_serial_port(port);
    let ids = [1, 2];
    assert!(arm.ping(1).unwrap() && arm.ping(2).unwrap());
    assert_eq!(arm.read_model(1).unwrap(), [777]);
    arm.sync_write_torque_enable(&ids, &[true, true]).unwrap();
    arm.sync_write_acceleration(&ids, &[50, 50]).unwrap();
    // rustypot counts angles from the middle of the turn.
    let goals = [0.5, -0.75];
    arm.sync_write_goal_position(&ids, &goals).unwrap();
    let end = Instant::now() + Duration::from_secs(20);
    loop {
        let here = arm.sync_read_present_position(&ids).unwrap();
        let moving = arm.sync_read_moving(&ids).unwrap();
        let there = {
            let bench = bench.lock().unwrap();
            goals.iter().enumerate().all(|(k, goal)| (bench.plant().position(k) - goal).abs() < 2e-3)
        };
        if there {
            // A step is 1.5 mrad.
            assert!(here.iter().zip(goals).all(|(here, goal)| (here - goal).abs() < 4e-3), "{here:?}");
            assert!(!moving[0] && !moving[1]);
            break;
        }
        assert!(Instant::now() < end, "{here:?}");
    }
    stop.store(true, Ordering::Relaxed);
    serving.join().unwrap().unwrap();
}
