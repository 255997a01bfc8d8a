//! rustypot, a client that other people wrote, drives simulated Feetech servos through a pseudo-terminal.
#![cfg(unix)]

mod served;

use rustypot::servo::feetech::sts3215::Sts3215Controller;
use served::{MOTORS, Served};
use std::f64::consts::PI;
use std::time::{Duration, Instant};
use wire::feetech::{Bus, Servo};

#[test]
fn rustypot_moves_and_reads_an_arm_of_two() {
    let served = Served::new(|plant| {
        let mut servos = [1, 2].map(Servo::new);
        for (servo, motor) in servos.iter_mut().zip(MOTORS) {
            servo.mount(plant.motor(motor).unwrap(), 1.0, PI);
        }
        Box::new(Bus::new(servos.into()).with_baud(1e6))
    });
    let path = served.path.to_string_lossy();
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
    assert!(served.settles(&goals, 2e-3));
    let here = arm.sync_read_present_position(&ids).unwrap();
    // A step is 1.5 mrad.
    assert!(here.iter().zip(goals).all(|(here, goal)| (here - goal).abs() < 4e-3), "{here:?}");
    let end = Instant::now() + Duration::from_secs(20);
    while arm.sync_read_moving(&ids).unwrap() != [false, false] {
        assert!(Instant::now() < end);
    }
}
