//! A robot over simulated Dynamixel servos: the same motion as in simulation, and what its safety does.

mod rig;

use protocol::dynamixel::{MODELS, address, hardware_error};
use rig::Rig;
use robot::{Clock, Config, Fault, RobotError};
use wire::dynamixel::{Bus, Servo};
use wire::{Bench, Carries, Plant, Rates, VirtualClock};

const ARM: &str = include_str!("rig/arm.xml");

fn config(extra: &str) -> Config {
    let text = format!(
        "[[device]]
         name = 'arm'
         interface = {{ type = 'dynamixel', name = 'bus0', reset_time = 1, {extra} }}
         sensor = [{{ name = 'shoulder_angle', range = [-2, 2], hdr_id = 10, scale = 1, offset = -3.141592653589793 }},
                   {{ name = 'elbow_angle', range = [-2, 2], hdr_id = 11, scale = -1, offset = 3.141592653589793 }},
                   {{ name = 'elbow_speed', range = [-9, 9], hdr_id = 11, scale = -1 }}]
         actuator = [{{ name = 'shoulder', pos_range = [-1, 1], vel_range = [-2, 2], hdr_id = 10, scale = 1, offset = 3.141592653589793 }},
                     {{ name = 'elbow', pos_range = [-1, 1], vel_range = [-2, 2], hdr_id = 11, scale = -1, offset = 3.141592653589793 }}]"
    );
    Config::from_toml(&text, "arm.toml").expect("a sound config")
}

fn on_bus(carries: Carries, prepare: impl FnOnce(&mut [Servo])) -> Rig {
    let model = robohive_mjcf::load_str(ARM).expect("a sound model").model;
    let plant = Plant::new(model.clone()).expect("a sound state");
    let mut servos = Vec::new();
    for (id, name, scale) in [(10, "shoulder", 1.0), (11, "elbow", -1.0)] {
        let mut servo = Servo::new(&MODELS[0], id);
        servo.mount(plant.motor(name).expect("an actuator"), scale, std::f64::consts::PI);
        servos.push(servo);
    }
    prepare(&mut servos);
    let mut bench = Bench::new(plant);
    let Carries::Bytes { each } = carries else { panic!("a serial line carries bytes") };
    let link = bench.connect(Box::new(Bus::new(servos).with_baud(10.0 / each)), carries);
    Rig::new(model, bench, link)
}

/// What a policy might do: two sines.
fn action(k: u32) -> [f64; 2] {
    let t = f64::from(k) * 0.1;
    [0.6 * t.sin(), 0.5 * (1.3 * t).cos() - 0.5]
}

#[test]
fn the_same_policy_ends_within_quantisation_of_the_simulation() {
    let [worst, speeds] =
        on_bus(Carries::AT_ONCE, |_| {}).differences(&config("profile_velocity = 0"), action);
    // A unit of position is 1.5 mrad: half of it for the command, half for the reading that limits the velocity.
    assert!(worst < 1.6e-3, "{worst}");
    assert!(worst > 1e-5, "the servos quantise, so that something must differ");
    assert!(speeds < 0.04, "{speeds}");
}

#[test]
fn nothing_moves_before_it_is_armed_and_a_dry_run_says_what_it_would_send() {
    let mut rig = on_bus(Carries::serial(1e6), |servos| {
        // An earlier user left a goal far away.
        servos[0].set_register(address::GOAL_POSITION, 3000);
    });
    let (config, model) = (config(""), rig.model.clone());
    let mut rng = random::Generator::pcg64(1_u64);
    let data = physics::Data::new(&model);
    rig.setup.armed = false;
    let mut robot = rig.robot(&config).unwrap();
    let error = robot.reset(&model, &data, &mut rng).unwrap_err();
    assert!(error.to_string().contains("nothing moves before it is armed"), "{error}");
    rig.clock().wait(0.5);
    let read = robot.sense(&model, &data, &mut rng).values[0];
    assert!(read > 0.5 && (read - rig.positions()[0]).abs() < 0.02, "it falls, and can be read: {read}");
    robot.close().unwrap();

    rig.setup.dry_run = true;
    let mut robot = rig.robot(&config).unwrap();
    robot.reset(&model, &data, &mut rng).unwrap();
    robot.control(&model, &data, &[0.5, 0.0], 0.1).unwrap();
    rig.clock().wait(0.1);
    robot.close().unwrap();
    let said = rig.said.lock().unwrap();
    assert!(said.last().unwrap().starts_with("arm: would be sent [3.3416"), "{:?}", said.last());
    drop(said);
    // The arm hangs without torque; nothing gave it any.
    let bench = rig.bench.lock().unwrap();
    assert_eq!(bench.plant().effort(0), 0.0);
}

#[test]
fn an_old_goal_does_not_make_it_leap() {
    let rig = on_bus(Carries::serial(1e6), |servos| {
        servos.iter_mut().for_each(|servo| servo.set_register(address::GOAL_POSITION, 4000));
    });
    let (config, model) = (config(""), rig.model.clone());
    let mut rng = random::Generator::pcg64(1_u64);
    let mut robot = rig.robot(&config).unwrap();
    let data = physics::Data::new(&model);
    // A reset to where the arm stands: it must stay there.
    robot.reset(&model, &data, &mut rng).unwrap();
    assert!(rig.positions().iter().all(|position| position.abs() < 0.25), "{:?}", rig.positions());
    robot.close().unwrap();
}

#[test]
fn silence_stops_it_and_a_reset_goes_on() {
    let rig = on_bus(Carries::serial(1e6), |_| {});
    let (config, model) = (config(""), rig.model.clone());
    let mut rng = random::Generator::pcg64(1_u64);
    let mut robot = rig.robot(&config).unwrap();
    let data = physics::Data::new(&model);
    robot.reset(&model, &data, &mut rng).unwrap();
    robot.control(&model, &data, &[0.8, 0.0], 1.0).unwrap();
    let mut clock = rig.clock();
    clock.wait(0.2);
    robot.control(&model, &data, &[0.8, 0.0], 1.0).unwrap();
    // The policy hangs. Within a quarter of a second and a period of the watchdog the arm is commanded to hold.
    clock.wait(0.27);
    let held = rig.positions();
    let error = robot.control(&model, &data, &[0.8, 0.0], 1.0).unwrap_err();
    assert!(error.to_string().contains("no command came for 0.25 s"), "{error}");
    clock.wait(1.0);
    let later = rig.positions();
    assert!((held[0] - later[0]).abs() < 0.1, "{held:?} {later:?}");
    robot.reset(&model, &data, &mut rng).unwrap();
    robot.control(&model, &data, &[0.2, 0.0], 0.1).unwrap();
    robot.close().unwrap();
}

#[test]
fn whoever_asks_for_the_end_stops_the_motion_of_a_reset() {
    let mut rig = on_bus(Carries::serial(1e6), |_| {});
    let bench = rig.bench.clone();
    rig.setup.halted = std::sync::Arc::new(move || bench.lock().unwrap().time() > 0.5);
    // It stands where the episode does not begin.
    rig.bench.lock().unwrap().plant_mut().place(&[0.9, -0.9], &[0.0; 2]).unwrap();
    let (config, model) = (config(""), rig.model.clone());
    let mut robot = rig.robot(&config).unwrap();
    let data = physics::Data::new(&model);
    let error = robot.reset(&model, &data, &mut random::Generator::pcg64(1_u64)).unwrap_err();
    assert!(error.to_string().contains("its motion was ended before it was done"), "{error}");
    let ended = rig.clock().now();
    assert!(ended < 0.6, "a second is not waited for: {ended}");
    let stopped = rig.positions();
    rig.clock().wait(1.0);
    let later = rig.positions();
    assert!(stopped[0] > 0.3 && (stopped[0] - later[0]).abs() < 0.1, "{stopped:?} {later:?}");
}

#[test]
fn the_servos_stop_by_themselves_when_the_process_is_killed() {
    let rig = on_bus(Carries::serial(1e6), |_| {});
    let (config, model) = (config(""), rig.model.clone());
    let mut rng = random::Generator::pcg64(1_u64);
    let mut robot = rig.robot(&config).unwrap();
    let data = physics::Data::new(&model);
    robot.reset(&model, &data, &mut rng).unwrap();
    robot.control(&model, &data, &[0.9, 0.0], 2.0).unwrap();
    // Time passes without services: our watchdog does not run any more.
    VirtualClock::new(rig.bench.clone()).wait(0.105);
    let stopped = rig.positions();
    VirtualClock::new(rig.bench.clone()).wait(1.0);
    let later = rig.positions();
    assert!((stopped[0] - later[0]).abs() < 0.1, "{stopped:?} {later:?}");
    std::mem::forget(robot);
}

#[test]
fn a_robot_that_cannot_be_made_safe_when_it_is_closed_says_so() {
    let rig = on_bus(Carries::serial(1e6), |_| {});
    let (config, model) = (config(""), rig.model.clone());
    let mut rng = random::Generator::pcg64(1_u64);
    let mut robot = rig.robot(&config).unwrap();
    robot.reset(&model, &physics::Data::new(&model), &mut rng).unwrap();
    rig.bench.lock().unwrap().set_connected(rig.link, false);
    let error = robot.close().unwrap_err().to_string();
    assert!(error.contains("device 'arm'") && error.contains("the connection is lost"), "{error}");
    let said = rig.said.lock().unwrap();
    assert!(
        said.last().is_some_and(|said| said.contains("arm: it may not be in its safe state")),
        "{said:?}"
    );
}

#[test]
fn bad_commands_and_failing_hardware_are_named() {
    let rig = on_bus(Carries::serial(1e6), |_| {});
    let (config, model) = (config(""), rig.model.clone());
    let mut rng = random::Generator::pcg64(1_u64);
    let mut robot = rig.robot(&config).unwrap();
    let data = physics::Data::new(&model);
    robot.reset(&model, &data, &mut rng).unwrap();
    assert!(robot.control(&model, &data, &[f64::NAN, 0.0], 0.1).is_err());
    robot.control(&model, &data, &[0.0, 0.0], 0.1).unwrap();
    rig.bench.lock().unwrap().stop_button(true);
    rig.clock().wait(0.3);
    let error = robot.control(&model, &data, &[0.0, 0.0], 0.1).unwrap_err();
    assert!(matches!(error, RobotError::Device { fault: Fault::Stale(90..=130), .. }), "{error:?}");
    let error = robot.reset(&model, &data, &mut rng).unwrap_err().to_string();
    assert!(error.contains("servo 10 does not answer at 1000000 baud on bus0"), "{error}");
    rig.bench.lock().unwrap().stop_button(false);
    robot.reset(&model, &data, &mut rng).unwrap();
    robot.close().unwrap();

    let wrong = on_bus(Carries::AT_ONCE, |servos| {
        servos[1].set_register(address::SHUTDOWN, 0x3F);
        servos[1].break_down(hardware_error::OVERLOAD);
        servos[1].set_register(address::ID, 12);
    });
    let error = wrong.robot(&config).err().unwrap().to_string();
    assert!(error.contains("servo 11 does not answer"), "{error}");
    for (extra, part) in [
        ("baudrate = 5", "'baudrate' of its interface is not known; there are name, safe"),
        ("baud = 1", "'baud' of its interface is 1; it must be from 9600 to 4500000"),
        ("safe = 'sit'", "there are hold, off"),
    ] {
        let error = rig.robot(&self::config(extra)).err().unwrap().to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn a_bus_that_fails_while_it_is_connected_is_named() {
    let rates: Rates = "drop=0.4".parse().unwrap();
    let mut errors = Vec::new();
    for seed in 0..20 {
        let rig = on_bus(Carries::serial(1e6), |_| {});
        rig.bench.lock().unwrap().inject(rig.link, rates, seed);
        errors.extend(rig.robot(&config("")).err().map(|error| error.to_string()));
    }
    println!("{} of 20 fail", errors.len());
    assert!(errors.len() > 10);
    for error in errors {
        assert!(error.contains("it cannot be reached: ") && error.contains("does not answer"), "{error}");
    }
}

#[test]
fn a_thousand_seeded_faults_end_in_errors_or_in_motion_within_limits() {
    rig::strike(|| on_bus(Carries::serial(1e6), |_| {}), &config(""), action);
}

#[test]
fn all_are_read_by_one_packet_where_every_firmware_can() {
    let time = |extra, firmware| {
        let rig = on_bus(Carries::serial(1e6), |servos| servos[1].set_register(address::FIRMWARE, firmware));
        let mut device = robohive_hardware::device(&config(extra).devices[0], &rig.setup).unwrap();
        device.connect().unwrap();
        device.reset(&[3.1, 3.1]).unwrap();
        let begun = rig.clock().now();
        device.read(&mut [0.0; 3]).unwrap();
        let taken = rig.clock().now() - begun;
        device.close().unwrap();
        (taken * 1e6).round()
    };
    // Of 10 µs each: 16 bytes there, 8 and two times 14 back; or two times 21.
    assert_eq!(time("", 45), 520.0);
    assert_eq!(time("", 44), 580.0);
    assert_eq!(time("fast_sync_read = false", 45), 580.0);
}

#[test]
fn simulated_devices_have_no_network_to_a_real_one() {
    let rig = on_bus(Carries::AT_ONCE, |_| {});
    let mut config = config("");
    let interface = &mut config.devices[0].interface;
    interface.kind = Some("robotiq".to_owned());
    interface.parameters.clear();
    interface.parameters.insert("ip_address".to_owned(), robot::Value::Text("127.0.0.1".to_owned()));
    config.devices[0].actuators.truncate(1);
    let error = rig.robot(&config).err().unwrap().to_string();
    assert!(error.contains("no simulated device is at 127.0.0.1"), "{error}");
}
