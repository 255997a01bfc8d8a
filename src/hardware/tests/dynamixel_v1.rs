//! A robot over simulated Dynamixel servos with protocol 1.0: the same motion as in simulation, alarms, seeded faults.

mod rig;

use protocol::dynamixel::v1::{address, error, model};
use rig::Rig;
use robot::{Clock, Config, Fault, RobotError};
use std::sync::{Arc, Mutex};
use wire::dynamixel::v1::{Bus, Servo};
use wire::{Bench, Carries, Device, Moment, Plant};

const ARM: &str = include_str!("rig/arm.xml");

/// Angle of the middle of 300 degrees.
const MIDDLE: f64 = 150.0 / 180.0 * std::f64::consts::PI;

fn config(extra: &str, elbow: &str) -> Config {
    let text = format!(
        "[[device]]
         name = 'arm'
         interface = {{ type = 'dynamixel', name = 'bus', reset_time = 1, {extra} }}
         sensor = [{{ name = 'shoulder_angle', range = [-2, 2], hdr_id = 10, offset = -{MIDDLE} }},
                   {{ name = 'elbow_angle', range = [-2, 2], hdr_id = 11, scale = -1, offset = {MIDDLE} }},
                   {{ name = 'elbow_speed', range = [-9, 9], hdr_id = 11, scale = -1 }}]
         actuator = [{{ name = 'shoulder', pos_range = [-1, 1], vel_range = [-2, 2], hdr_id = 10, offset = {MIDDLE} }},
                     {{ name = 'elbow', pos_range = [-1, 1], vel_range = [-2, 2], hdr_id = 11, scale = -1, offset = {MIDDLE}, {elbow} }}]"
    );
    Config::from_toml(&text, "arm.toml").expect("a sound config")
}

/// A bus that the test reaches too.
struct Reached(Arc<Mutex<Bus>>);

impl Device for Reached {
    fn receive(&mut self, moment: &mut Moment<'_>, channel: usize, bytes: &[u8]) {
        self.0.lock().unwrap().receive(moment, channel, bytes);
    }

    fn tick(&mut self, moment: &mut Moment<'_>) {
        self.0.lock().unwrap().tick(moment);
    }

    fn stop_button(&mut self, pressed: bool) {
        self.0.lock().unwrap().stop_button(pressed);
    }
}

/// Two servos of a model on a line, and the bus.
fn on_bus(name: &str, carries: Carries) -> (Rig, Arc<Mutex<Bus>>) {
    let arm = robohive_mjcf::load_str(ARM).expect("a sound model").model;
    let plant = Plant::new(arm.clone()).expect("a sound state");
    let servos = [(10, "shoulder", 1.0), (11, "elbow", -1.0)].map(|(id, motor, scale)| {
        let mut servo = Servo::new(model(name).unwrap(), id);
        servo.mount(plant.motor(motor).unwrap(), scale, MIDDLE);
        servo
    });
    let bus = Arc::new(Mutex::new(Bus::new(servos.into())));
    let mut bench = Bench::new(plant);
    let link = bench.connect(Box::new(Reached(bus.clone())), carries);
    (Rig::new(arm, bench, link), bus)
}

fn action(k: u32) -> [f64; 2] {
    let t = f64::from(k) * 0.1;
    [0.6 * t.sin(), 0.5 * (1.3 * t).cos() - 0.5]
}

#[test]
fn the_same_policy_ends_within_quantisation_of_the_simulation() {
    let (rig, _) = on_bus("AX-12A", Carries::AT_ONCE);
    let [worst, speeds] = rig.differences(&config("model = 'AX-12A', profile_velocity = 0", ""), action);
    // A unit of position is 5.1 mrad: half of it for the command, half for the reading that limits the velocity.
    assert!(worst < 5.2e-3 && worst > 1e-4, "{worst}");
    assert!(speeds < 0.04, "{speeds}");
}

#[test]
fn an_alarm_is_named_and_the_reset_after_it_gives_the_torque_back() {
    let (rig, bus) = on_bus("AX-12A", Carries::serial(1e6));
    let (config, model) = (config("protocol = 1", ""), rig.model.clone());
    let (mut rng, mut data) = (random::Generator::pcg64(1_u64), physics::Data::new(&rig.model));
    // Somebody let the elbow turn like a wheel, and the shoulder no farther than 0.5 rad below its middle.
    bus.lock().unwrap().servos_mut()[1].set_register(address::CCW_LIMIT, 0);
    bus.lock().unwrap().servos_mut()[0].set_register(address::CW_LIMIT, 414);
    let mut robot = rig.robot(&config).unwrap();
    robot.reset(&model, &data, &mut rng).unwrap();
    assert_eq!(bus.lock().unwrap().servos_mut()[1].register(address::CCW_LIMIT), 1023);
    for _ in 0..30 {
        robot.control(&model, &data, &[-0.9, 0.0], 0.1).unwrap();
        rig.clock().wait(0.1);
        robot.sense(&model, &data, &mut rng);
        robot.write_readings(&mut data);
    }
    // The limit of the servo is kept before the wire: a goal beyond it would be refused in silence.
    assert_eq!(bus.lock().unwrap().servos_mut()[0].register(address::GOAL_POSITION), 414);

    bus.lock().unwrap().servos_mut()[1].set_alarm(error::OVERLOAD);
    rig.clock().wait(0.1);
    let fault = robot.control(&model, &data, &[0.0, 0.0], 0.1).unwrap_err();
    assert!(
        matches!(&fault, RobotError::Device { fault: Fault::Hardware(why), .. } if why == "servo 11: overload"),
        "{fault:?}"
    );
    let text = robot.reset(&model, &data, &mut rng).unwrap_err().to_string();
    assert!(text.contains("device 'arm'") && text.contains("it reports: servo 11: overload"), "{text}");
    bus.lock().unwrap().servos_mut()[1].set_alarm(0);
    assert_eq!(bus.lock().unwrap().servos_mut()[1].register(address::TORQUE_LIMIT), 0);
    robot.reset(&model, &data, &mut rng).unwrap();
    assert_eq!(bus.lock().unwrap().servos_mut()[1].register(address::TORQUE_LIMIT), 1023);
    robot.control(&model, &data, &[0.0, 0.0], 0.1).unwrap();
    robot.close().unwrap();
}

#[test]
fn an_adapter_that_echoes_is_no_servo_that_answers() {
    let (rig, bus) = on_bus("AX-12A", Carries::serial(1e6));
    let plain = std::mem::replace(&mut *bus.lock().unwrap(), Bus::new(Vec::new()));
    *bus.lock().unwrap() = plain.with_echo(true).with_baud(1e6);
    let (model, mut rng) = (rig.model.clone(), random::Generator::pcg64(1_u64));
    let data = physics::Data::new(&model);
    let mut robot = rig.robot(&config("protocol = 1", "")).unwrap();
    robot.reset(&model, &data, &mut rng).unwrap();
    for k in 0..20 {
        robot.control(&model, &data, &action(k), 0.1).unwrap();
        rig.clock().wait(0.1);
        let read = robot.sense(&model, &data, &mut rng).values[..2].to_vec();
        let away = read.iter().zip(rig.positions()).map(|(read, is)| (read - is).abs());
        // A unit of position is 5.1 mrad, and it moves while it is read.
        assert!(away.fold(0.0, f64::max) < 10e-3, "{read:?} {:?}", rig.positions());
    }
    robot.close().unwrap();
    assert!(rig.said.lock().unwrap().is_empty(), "all went well");
}

#[test]
fn what_these_servos_cannot_do_is_named() {
    let (rig, _) = on_bus("AX-12A", Carries::serial(1e6));
    for (extra, elbow, part) in [
        (
            "",
            "",
            "servo 10 does not answer at 1000000 baud on bus; check its power, its id, its baud rate and its protocol",
        ),
        ("protocol = 1", "mode = 'velocity'", "servo 11, an AX-12A, has no mode 'velocity'"),
        ("protocol = 1, profile_acceleration = 2", "", "servos with protocol 1 do not support"),
        ("protocol = 1, model = 'XM430-W350'", "", "which the model 'XM430-W350' does not support"),
        ("protocol = 1.5", "", "its interface has protocol = 1.5; there are 1 and 2"),
        ("protocol = 0", "", "it must be from 1 to 2"),
        ("model = 'MX-28'", "", "servo 10 is an AX-12A, and the config says MX-28"),
        ("model = 'AX-12'", "", "has the unknown model 'AX-12'; the models are XM430-W350, XL430-W250"),
    ] {
        let text = rig.robot(&config(extra, elbow)).err().unwrap().to_string();
        assert!(text.contains(part), "{text}");
    }
    let mut current = config("protocol = 1", "");
    current.devices[0].sensors[2].hardware = robot::HardwareId::Name("11:current".to_owned());
    let text = rig.robot(&current).err().unwrap().to_string();
    assert!(text.contains("servo 11, an AX-12A, measures no current"), "{text}");
}

#[test]
fn an_mx_turns_like_a_wheel_at_the_velocity_that_it_is_told() {
    let (rig, bus) = on_bus("MX-28", Carries::serial(1e6));
    let wheel = "[[device]]
         name = 'wheels'
         interface = { type = 'dynamixel', name = 'bus', protocol = 1 }
         sensor = [{ name = 'elbow_speed', range = [-9, 9], hdr_id = '11:velocity', scale = -1 }]
         actuator = [{ name = 'elbow', pos_range = [-2, 2], vel_range = [-9, 9], hdr_id = 11, scale = -1, mode = 'velocity' }]";
    let config = Config::from_toml(wheel, "wheels.toml").unwrap();
    let setup = rig.setup.clone();
    let mut device = robohive_hardware::device(&config.devices[0], &setup).unwrap();
    device.connect().unwrap();
    device.reset(&[0.0]).unwrap();
    let mut values = [0.0];
    for _ in 0..100 {
        device.apply(0.0, &[-1.5]).unwrap();
        rig.clock().wait(0.02);
        device.read(&mut values).unwrap();
    }
    // Its unit is 0.012 rad/s. The servo sits the other way round, and gravity and friction hold it back.
    let turned = rig.bench.lock().unwrap().plant().velocity(1);
    assert!((values[0] + turned).abs() < 0.012 && turned > 0.8, "{values:?} {turned}");
    assert!(rig.positions()[1] > 1.0, "{:?}", rig.positions());
    device.close().unwrap();
    assert_eq!(
        bus.lock().unwrap().servos_mut()[1].register(address::MOVING_SPEED),
        0,
        "it is commanded to stop"
    );
}

#[test]
fn seeded_faults_end_in_errors_or_in_motion_within_limits() {
    rig::strike(|| on_bus("AX-12A", Carries::serial(1e6)).0, &config("protocol = 1", ""), action);
}
