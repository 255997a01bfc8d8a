//! Clients that other people wrote (dynamixel2, rustypot) drive simulated servos through a pseudo-terminal.
#![cfg(unix)]

mod served;

use protocol::dynamixel::{MODELS, address, hardware_error};
use rustypot::DynamixelProtocolHandler;
use served::{MOTORS, Served};
use std::time::{Duration, Instant};
use wire::dynamixel::{Bus, Servo};

/// Three servos, prepared.
fn served(prepare: impl FnOnce(&mut [Servo])) -> Served {
    Served::new(|plant| {
        let mut servos = [10, 11, 20].map(|id| Servo::new(&MODELS[0], id));
        for (servo, motor) in servos.iter_mut().zip(MOTORS) {
            servo.mount(plant.motor(motor).expect("an actuator"), 1.0, std::f64::consts::PI);
        }
        prepare(&mut servos);
        Box::new(Bus::new(servos.into()).with_baud(1e6))
    })
}

#[test]
fn dynamixel2_reads_writes_and_hears_alerts() {
    let served = served(|servos| servos[2].break_down(hardware_error::OVERLOAD));
    let mut bus = dynamixel2::Bus::open(&served.path, 57_600).unwrap();
    let found: Vec<_> = bus.scan().unwrap().into_iter().map(|ping| ping.unwrap()).collect();
    assert_eq!(found.iter().map(|ping| ping.motor_id).collect::<Vec<_>>(), [10, 11, 20]);
    assert!(found.iter().all(|ping| ping.data.model == 1020));
    assert_eq!(found.iter().map(|ping| ping.alert).collect::<Vec<_>>(), [false, false, true]);

    // Torque stays off where the hardware has an error, and locks the registers that outlive a reboot.
    bus.write_u8(10, address::TORQUE_ENABLE, 1).unwrap();
    bus.write_u8(11, address::TORQUE_ENABLE, 1).unwrap();
    assert!(bus.write_u8(20, address::TORQUE_ENABLE, 1).is_err());
    assert!(bus.write_u8(10, address::OPERATING_MODE, 1).is_err());
    // 2048 + 512 units are 45 degrees; beyond the limit of positions it refuses.
    assert!(bus.write_u32(10, address::GOAL_POSITION, 5000).is_err());
    assert!(bus.write_u32(10, 300, 1).is_err());
    let goals = [(10, 2560_u32), (11, 1536)];
    let goals = goals.map(|(motor_id, data)| dynamixel2::instructions::SyncWriteData { motor_id, data });
    bus.sync_write_u32(address::GOAL_POSITION, &goals).unwrap();
    let eighth = std::f64::consts::FRAC_PI_4;
    assert!(served.settles(&[eighth, -eighth, 0.0], 5e-4));
    let read = bus.sync_read_u32(&[10, 11, 20], address::PRESENT_POSITION).unwrap();
    for (response, wanted) in read.iter().zip([2560_i64, 1536, 2048]) {
        assert!((i64::from(response.data) - wanted).abs() <= 1, "{response:?}");
    }

    bus.reboot(20).unwrap();
    let end = Instant::now() + Duration::from_secs(10);
    let ping = loop {
        match bus.ping(20) {
            Ok(ping) => break ping,
            Err(error) => assert!(Instant::now() < end, "{error}"),
        }
    };
    assert!(!ping.alert);
    bus.reg_write(20, address::TORQUE_ENABLE, &[1]).unwrap();
    assert_eq!(bus.read_u8(20, address::TORQUE_ENABLE).unwrap().data, 0);
    bus.action(20).unwrap();
    assert_eq!(bus.read_u8(20, address::TORQUE_ENABLE).unwrap().data, 1);
}

#[test]
fn rustypot_reads_all_at_once() {
    let served = served(|_| {});
    let path = served.path.to_string_lossy().into_owned();
    let port = serialport::new(path, 57_600).timeout(Duration::from_secs(2));
    let mut port = port.open().unwrap();
    let handler = DynamixelProtocolHandler::v2();
    let ids = [10, 11, 20];
    assert!(handler.ping(port.as_mut(), 11).unwrap());
    handler
        .sync_write(port.as_mut(), &ids, address::TORQUE_ENABLE as u8, &[vec![1], vec![1], vec![1]])
        .unwrap();
    // Profile acceleration and velocity, and the goal, lie next to each other.
    let command =
        |goal: u32| [50_u32, 200, goal].iter().flat_map(|value| value.to_le_bytes()).collect::<Vec<_>>();
    let goals = [2048, 2304, 1792].map(command);
    handler.sync_write(port.as_mut(), &ids, address::PROFILE_ACCELERATION as u8, &goals).unwrap();
    let sixteenth = std::f64::consts::FRAC_PI_8;
    assert!(served.settles(&[0.0, sixteenth, -sixteenth], 5e-4));
    // Current, velocity, position: 10 bytes of each.
    let from = address::PRESENT_CURRENT as u8;
    let slow = handler.sync_read(port.as_mut(), &ids, from, 10).unwrap();
    let fast = handler.fast_sync_read(port.as_mut(), &ids, from, 10).unwrap();
    for reads in [slow, fast] {
        for (bytes, wanted) in reads.iter().zip([2048_i32, 2304, 1792]) {
            let position = i32::from_le_bytes(bytes[6..10].try_into().unwrap());
            assert!((position - wanted).abs() <= 1, "{position} {wanted}");
        }
    }
}
