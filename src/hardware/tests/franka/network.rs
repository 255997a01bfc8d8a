//! The driver with real sockets and a thread of its own, against an arm that is served on the loopback network.

use super::rig::{JOINTS, START};
use env::{Env, Options as EnvOptions, OwnModels};
use protocol::franka::Version;
use robohive_hardware::{Setup, registry};
use robot::{Config, Options, Robot};
use std::net::SocketAddr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use wire::franka::Arm;
use wire::{Bench, Carries, End, Plant, serve};

#[test]
fn a_thread_answers_a_served_arm_in_both_versions() {
    let model = Env::make(super::rig::ID, &OwnModels, &EnvOptions::default()).unwrap().scene().model.clone();
    for version in [Version::V5, Version::V10] {
        let mut plant = Plant::new(model.clone()).unwrap();
        let mut qpos: Vec<f64> = model.key_qpos.iter().take(model.nq).copied().collect();
        qpos[..9].copy_from_slice(&START);
        plant.place(&qpos, &vec![0.0; model.nv]).unwrap();
        let arm = Arm::new(version, &plant, JOINTS).unwrap().patient();
        let mut bench = Bench::new(plant);
        let [commands, states] = bench.connect_all(Box::new(arm), [Carries::AT_ONCE, Carries::Datagrams]);
        let bench = Arc::new(Mutex::new(bench));
        let free = SocketAddr::from(([127, 0, 0, 1], 0));
        let mut ends = vec![(commands, End::tcp(free).unwrap()), (states, End::udp(free, None).unwrap())];
        let address = ends[0].1.address();
        let stop = Arc::new(AtomicBool::new(false));
        let served = {
            let (bench, stop) = (bench.clone(), stop.clone());
            std::thread::spawn(move || serve(&bench, &mut ends, &stop))
        };

        let mut config = super::rig::config("control = 'position', watchdog = 10");
        only_joints(&mut config, &address);
        let mut setup = Setup::default().with_armed(true);
        setup.locks = false;
        let options = Options::default().with_hardware(true).with_normalized(false);
        let mut data = physics::Data::new(&model);
        data.state.qpos.copy_from_slice(&qpos);
        data.state.ctrl.copy_from_slice(&START[..8]);
        physics::forward(&model, &mut data).unwrap();
        let mut rng = random::Generator::pcg64(1_u64);
        let mut action = START[..8].to_vec();
        action[0] += 0.2;
        // A machine that has others to serve may let a thread wait for longer than the driver lets an arm wait: then the
        // device is made safe, as it should be, and begins again.
        let end = Instant::now() + Duration::from_secs(100);
        let mut robot = loop {
            match Robot::with_devices(&model, Some(&config), options.clone(), &registry(&setup)) {
                Ok(robot) => break robot,
                Err(error) => assert!(Instant::now() < end, "{error}"),
            }
        };
        let (mut ready, mut arrived) = (false, f64::INFINITY);
        while (arrived - action[0]).abs() >= 1e-6 && Instant::now() < end {
            if !ready {
                ready = robot.reset(&model, &data, &mut rng).is_ok();
                continue;
            }
            ready = robot.control(&model, &data, &action, 1.0).is_ok();
            std::thread::sleep(Duration::from_millis(20));
            robot.sense(&model, &data, &mut rng);
            arrived = bench.lock().unwrap().plant().data().state.ctrl[0];
        }
        // Version 10 rounds what the arm was commanded before; the target is sent as it is.
        assert!((arrived - action[0]).abs() < 1e-6, "{version:?}: {arrived}");
        robot.close().unwrap_or_default();
        stop.store(true, Ordering::Relaxed);
        served.join().unwrap().unwrap();
    }
}

/// The arm at an address, without the hand.
fn only_joints(config: &mut Config, address: &str) {
    let device = &mut config.devices[0];
    device.actuators.truncate(7);
    device.sensors.retain(|sensor| sensor.name != "gripper_position");
    device.interface.parameters.insert("ip_address".to_owned(), robot::Value::Text(address.to_owned()));
    device.interface.parameters.insert("hand".to_owned(), robot::Value::Bool(false));
}
