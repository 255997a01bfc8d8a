//! Devices whose recorded bytes come over sockets, as they would from the kernel.

#![cfg(unix)]

use robohive_teleop::devices::{Opened, wait};
use robohive_teleop::{Device, Event, Held, Mapping, TeleopError};
use std::io::Write;
use std::os::fd::AsFd;
use std::os::unix::net::{UnixDatagram, UnixStream};
use std::path::Path;
use std::time::{Duration, Instant};

fn event(kind: u16, code: u16, value: i32) -> Vec<u8> {
    [&[0; 16][..], &kind.to_ne_bytes(), &code.to_ne_bytes(), &value.to_ne_bytes()].concat()
}

fn read(device: &mut Opened) -> Vec<Event> {
    let mut events = Vec::new();
    device.read(&mut events).unwrap();
    events
}

#[test]
fn a_gamepad_is_read_and_one_that_is_gone_releases_everything() {
    let (mut kernel, ours) = UnixStream::pair().unwrap();
    ours.set_nonblocking(true).unwrap();
    let mut gamepad = Opened::of(Device::Gamepad, ours.into());
    assert!(read(&mut gamepad).is_empty(), "nothing is there, and nothing waits");
    let report = [event(3, 1, 32767), event(1, 308, 1), event(0, 0, 0)].concat();
    let (first, rest) = report.split_at(30);
    kernel.write_all(first).unwrap();
    assert_eq!(wait(&[gamepad.as_fd()], 1.0).unwrap(), [true]);
    let (mut held, mut mapping) = (Held::default(), Mapping::default());
    read(&mut gamepad).into_iter().for_each(|event| held.apply(event, 0.0));
    kernel.write_all(rest).unwrap();
    read(&mut gamepad).into_iter().for_each(|event| held.apply(event, 0.0));
    let motion = mapping.read(&held.sample(0.0)).motion;
    assert_eq!((motion.arms[0].along[0], motion.arms[0].gripper), (1.0, Some(-1.0)));
    drop(kernel);
    let mut events = Vec::new();
    let error = gamepad.read(&mut events).unwrap_err();
    assert!(matches!(error, TeleopError::Device { .. }) && error.to_string().contains("gone"), "{error}");
    events.into_iter().for_each(|event| held.apply(event, 0.1));
    assert!(!mapping.read(&held.sample(0.1)).motion.moves());
}

#[test]
fn reports_of_a_six_axis_mouse_are_datagrams() {
    let (kernel, ours) = UnixDatagram::pair().unwrap();
    ours.set_nonblocking(true).unwrap();
    let mut mouse = Opened::of(Device::SpaceMouse, ours.into());
    let (mut held, mut mapping) = (Held::default(), Mapping::default());
    kernel.send(&[1, 0x5e, 1, 0, 0, 0, 0]).unwrap();
    kernel.send(&[2, 0, 0, 0, 0, 0x5e, 1]).unwrap();
    (0..2).flat_map(|_| read(&mut mouse)).for_each(|event| held.apply(event, 0.0));
    assert_eq!(mapping.read(&held.sample(0.05)).motion.arms[0].along, [1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    // No report comes while the cap is at rest; one that was lost must not move the robot on.
    assert!(!mapping.read(&held.sample(0.2)).motion.moves());
}

#[test]
fn lines_of_a_headset_come_over_a_pipe() {
    let (mut log, ours) = UnixStream::pair().unwrap();
    ours.set_nonblocking(true).unwrap();
    let mut quest = Opened::of(Device::Quest, ours.into());
    let line = |z: f64| format!("I wE9ryARX: r:1 0 0 0 0 1 0 0 0 0 1 {z} 0 0 0 1&R,RG,rightTrig 1.0\n");
    let (mut held, mut mapping) = (Held::default(), Mapping::default());
    let mut ways = Vec::new();
    for tick in 0..4 {
        let now = 0.08 * f64::from(tick);
        log.write_all(line(-0.01 * f64::from(tick)).as_bytes()).unwrap();
        read(&mut quest).into_iter().for_each(|event| held.apply(event, now));
        let motion = mapping.read(&held.sample(now)).motion;
        assert_eq!(motion.arms[0].gripper, Some(-1.0));
        ways.extend(motion.arms[0].hand.map(|hand| hand.way[0]));
    }
    // Forward in front of the head is forward from the robot.
    assert!(ways.len() == 3 && ways.iter().all(|way| (way - 0.01).abs() < 1e-12), "{ways:?}");
}

#[test]
fn waiting_ends_in_time() {
    let (_kernel, ours) = UnixStream::pair().unwrap();
    let began = Instant::now();
    assert_eq!(wait(&[ours.as_fd()], 0.03).unwrap(), [false]);
    assert!(began.elapsed() >= Duration::from_millis(29));
}

#[test]
fn what_cannot_be_opened_says_what_to_do() {
    let missing = Path::new("/nonexistent/event7");
    let error = Opened::gamepad(Some(missing), &[]).err().unwrap().to_string();
    assert!(error.contains("/nonexistent/event7") && error.contains("--path"), "{error}");
    let error = Opened::quest(None).err().unwrap().to_string();
    assert!(error.contains("adb logcat"), "{error}");
    if Path::new("/dev/hidraw0").exists() {
        println!("not checked: this machine has devices of hidraw");
        return;
    }
    let error = Opened::space_mouse(None).err().unwrap().to_string();
    assert!(error.contains("there is none") && error.contains("connect one"), "{error}");
}
