//! rustypot, a client that other people wrote, drives simulated Dynamixel servos with protocol 1.0 through a pseudo-terminal.
//! (dynamixel2 speaks protocol 2.0 alone.)
#![cfg(unix)]

mod served;

use protocol::dynamixel::v1::{address, error, model};
use rustypot::DynamixelProtocolHandler;
use rustypot::servo::dynamixel::ax::AxController;
use served::{MOTORS, Served};
use std::time::Duration;
use wire::dynamixel::v1::{Bus, Servo};

/// Two AX-12A and an MX-28, each in the middle of its range.
fn served() -> Served {
    Served::new(|plant| {
        let mut servos = [("AX-12A", 1), ("AX-12A", 2), ("MX-28", 3)].map(|(name, id)| {
            let kind = model(name).unwrap();
            (kind.kind, Servo::new(kind, id))
        });
        for ((kind, servo), motor) in servos.iter_mut().zip(MOTORS) {
            let middle = (kind.last + 1) as f64 / 2.0 * kind.position;
            servo.mount(plant.motor(motor).unwrap(), 1.0, middle);
        }
        Box::new(Bus::new(servos.map(|(_, servo)| servo).into()).with_baud(1e6))
    })
}

fn port(served: &Served) -> Box<dyn serialport::SerialPort> {
    let path = served.path.to_string_lossy();
    serialport::new(path, 1_000_000).timeout(Duration::from_secs(2)).open().unwrap()
}

#[test]
fn rustypot_moves_and_reads_an_ax_by_its_own_table() {
    let served = served();
    let mut arm = AxController::new().with_protocol_v1().with_serial_port(port(&served));
    assert!(arm.ping(1).unwrap() && arm.ping(2).unwrap() && !arm.ping(7).unwrap_or(false));
    assert_eq!(arm.read_model_number(1).unwrap(), [12]);
    let limits = [arm.read_cw_angle_limit(1).unwrap()[0], arm.read_ccw_angle_limit(1).unwrap()[0]];
    assert!((limits[0].to_degrees() + 150.0).abs() < 0.01 && (limits[1].to_degrees() - 149.7).abs() < 0.1);
    // 200 units are 22.2 turns a minute.
    arm.sync_write_moving_speed(&[1, 2], &[200, 200]).unwrap();
    arm.sync_write_torque_enable(&[1, 2], &[1, 1]).unwrap();
    // rustypot counts angles from the middle of the 300 degrees.
    let goals = [0.5, -0.75];
    arm.sync_write_goal_position(&[1, 2], &goals).unwrap();
    // A unit is 5.1 mrad, and rustypot rounds down.
    assert!(served.settles(&goals, 6e-3));
    for (id, goal) in [1, 2].into_iter().zip(goals) {
        let here = arm.read_present_position(id).unwrap()[0];
        assert!((here - goal).abs() < 11e-3, "{here} {goal}");
        assert_eq!(arm.read_moving(id).unwrap(), [0]);
    }
    // Torque keeps what outlives a restart.
    arm.write_ccw_angle_limit(1, 0.0).unwrap();
    assert_eq!(arm.read_ccw_angle_limit(1).unwrap()[0], limits[1]);
}

#[test]
fn rustypot_hears_why_a_servo_refuses_and_turns_an_mx_like_a_wheel() {
    let served = served();
    let mut port = port(&served);
    let handler = DynamixelProtocolHandler::v1();
    let number = handler.read(port.as_mut(), 3, address::MODEL_NUMBER as u8, 2).unwrap();
    assert_eq!(number, 29_u16.to_le_bytes());
    handler.write(port.as_mut(), 3, address::CCW_LIMIT as u8, &2000_u16.to_le_bytes()).unwrap();
    let said = handler
        .write_with_error(port.as_mut(), 3, address::GOAL_POSITION as u8, &3000_u16.to_le_bytes())
        .unwrap();
    assert_eq!(said.byte(), error::ANGLE);
    assert_eq!(format!("{:?}", said.v1_conditions()), "[AngleLimit]");
    handler.write(port.as_mut(), 3, address::CCW_LIMIT as u8, &[0, 0]).unwrap();
    handler.write(port.as_mut(), 3, address::TORQUE_ENABLE as u8, &[1]).unwrap();
    // Bit 10: the other way round, at 100 units of 0.114 turns a minute.
    handler.write(port.as_mut(), 3, address::MOVING_SPEED as u8, &(1024_u16 + 100).to_le_bytes()).unwrap();
    assert!(served.settles(&[0.0, 0.0, -2.0], 0.1), "it passes there");
    let speed = handler.read(port.as_mut(), 3, address::PRESENT_SPEED as u8, 2).unwrap();
    let speed = u16::from_le_bytes([speed[0], speed[1]]);
    assert!((1024 + 80..1024 + 105).contains(&speed), "{speed}");
}
