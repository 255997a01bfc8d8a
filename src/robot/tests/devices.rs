//! One flag puts other devices behind a robot; their faults are told and never lost.

use physics::{Data, Model, forward, step};
use random::Generator;
use robohive_robot::{
    Config, Device, DeviceConfig, Fault, Options, Record, Registry, Replay, Robot, RobotError, Units, Value,
};
use std::sync::{Arc, Mutex};

const ARM: &str =
    "<mujoco><worldbody><body><joint name='j' axis='0 1 0'/><geom size='.1'/></body></worldbody>
    <actuator><position name='servo' joint='j'/></actuator>
    <sensor><jointpos name='q' joint='j'/><jointvel name='v' joint='j'/></sensor></mujoco>";

const CONFIG: &str = "
    [[device]]
    name = 'eye'
    interface = { type = 'realsense' }
    cam = [{ name = 'rgb', range = [0, 255] }]
    [[device]]
    name = 'arm'
    interface = { type = 'log', gain = 3 }
    sensor = [{ name = 'q', range = [-1, 1], noise = 0.1, scale = -2, offset = 0.5 }, { name = 'v', range = [-1, 1] }]
    actuator = [{ name = 'servo', pos_range = [-1, 1], vel_range = [-9, 9], scale = 2, offset = -1 }]";

fn arm() -> (Model, Data, Config) {
    let model = robohive_mjcf::load_str(ARM).unwrap().model;
    let mut data = Data::new(&model);
    forward(&model, &mut data).unwrap();
    (model, data, Config::from_toml(CONFIG, "arm.toml").unwrap())
}

fn log(rows: &[(f64, [f64; 2])], units: Units) -> Registry {
    let records: Vec<_> =
        rows.iter().map(|(time, values)| Record { time: *time, values: values.to_vec() }).collect();
    let mut registry = Registry::default();
    registry.register("log", move |_: &DeviceConfig| Ok(Box::new(Replay::new(records.clone(), units))));
    registry
}

fn hardware() -> Options {
    Options::default().with_hardware(true).with_noise_scale(1.0).with_delay_steps(3).with_history(2)
}

#[test]
fn one_option_replays_a_log_instead_of_simulating() {
    let (model, mut data, config) = arm();
    let registry = log(&[(0.0, [0.25, 0.0]), (0.1, [0.5, -4.0])], Units::Hardware);
    let mut rng = Generator::pcg64(1_u64);
    let simulated = Robot::with_devices(&model, Some(&config), Options::default(), &registry)
        .unwrap()
        .reset(&model, &data, &mut rng)
        .unwrap()
        .values
        .clone();
    assert_eq!(simulated, [0.0, 0.0]);

    let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    // Neither range nor noise nor delay of the simulation: what the hardware says, in the model's units.
    let start = robot.reset(&model, &data, &mut rng).unwrap();
    assert_eq!((start.time, &start.values[..], &start.stamps[..]), (0.0, &[0.0, 0.0][..], &[0.0, 0.0][..]));
    assert_eq!(robot.past(1), robot.past(0));
    let readings = robot.sense(&model, &data, &mut rng);
    assert_eq!((readings.time, &readings.values[..]), (0.1, &[-0.5, -4.0][..]));
    assert_eq!(rng, Generator::pcg64(1_u64));
    assert!(robot.write_readings(&mut data));
    assert_eq!((data.time(), data.state.qpos[0], data.state.qvel[0]), (0.1, -0.5, -4.0));

    let registry = log(&[(0.0, [0.25, 0.0])], Units::Model);
    let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    assert_eq!(robot.reset(&model, &data, &mut rng).unwrap().values, [0.25, 0.0]);
}

#[test]
fn the_end_of_a_log_is_a_fault_that_stops_the_robot() {
    let (model, data, config) = arm();
    let registry = log(&[(0.0, [0.25, 0.0]), (0.1, [0.5, 2.0])], Units::Model);
    let mut rng = Generator::pcg64(1_u64);
    let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    robot.reset(&model, &data, &mut rng).unwrap();
    robot.sense(&model, &data, &mut rng);
    assert_eq!(robot.fault(), None);
    assert!(robot.control(&model, &data, &[0.5], 0.1).is_ok());
    let stale = robot.sense(&model, &data, &mut rng).clone();
    assert_eq!((stale.time, &stale.values[..]), (0.1, &[0.5, 2.0][..]), "the last values keep their time");
    let fault = RobotError::Device { device: "arm".to_owned(), fault: Fault::Exhausted };
    assert_eq!(robot.fault(), Some(&fault));
    assert_eq!(fault.to_string(), "device 'arm': its record has ended");
    assert_eq!(robot.control(&model, &data, &[0.5], 0.1), Err(fault.clone()));
    assert_eq!(robot.reset(&model, &data, &mut rng), Err(fault));
}

#[test]
fn what_a_simulated_robot_read_is_read_again_from_its_log() {
    let (model, mut data, config) = arm();
    let mut rng = Generator::pcg64(1_u64);
    let noisy = Options::default().with_noise_scale(1.0);
    let mut robot = Robot::new(&model, Some(&config), noisy).unwrap();
    let mut records = Vec::new();
    for _ in 0..20 {
        step(&model, &mut data).unwrap();
        let readings = robot.sense(&model, &data, &mut rng).clone();
        let values = robot.values_of("arm", &readings).unwrap().to_vec();
        records.push(Record { time: readings.time, values });
    }
    let (mut registry, log) = (Registry::default(), records.clone());
    registry.register("log", move |_: &DeviceConfig| Ok(Box::new(Replay::new(log.clone(), Units::Model))));
    let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    for Record { time, values } in &records {
        let readings = robot.sense(&model, &data, &mut rng);
        assert_eq!((readings.time, &readings.values), (*time, values));
    }
    assert!(records.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn robots_go_from_thread_to_thread() {
    let (model, data, config) = arm();
    let mut robot = Robot::new(&model, Some(&config), Options::default()).unwrap();
    let control = std::thread::scope(|scope| {
        scope.spawn(|| robot.control(&model, &data, &[0.5], 0.1).unwrap()[0]).join().unwrap()
    });
    assert_eq!(control, 0.5);
}

#[test]
fn bad_readings_are_faults() {
    let (model, data, config) = arm();
    let mut rng = Generator::pcg64(1_u64);
    let registry = log(&[(0.0, [0.25, f64::NAN])], Units::Model);
    let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    let error = robot.reset(&model, &data, &mut rng).unwrap_err();
    assert_eq!(error.to_string(), "device 'arm': its value 1 is no finite number");

    let mut registry = Registry::default();
    let short = Record { time: 0.0, values: vec![1.0] };
    registry
        .register("log", move |_: &DeviceConfig| Ok(Box::new(Replay::new([short.clone()], Units::Model))));
    let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    let error = robot.reset(&model, &data, &mut rng).unwrap_err();
    assert_eq!(error.to_string(), "device 'arm': it gave 1 values instead of 2");
}

#[test]
fn interfaces_that_nothing_drives_are_refused_when_hardware_is_asked_for() {
    let (model, _, config) = arm();
    let refused = |config: Option<&Config>, registry: &Registry| {
        Robot::with_devices(&model, config, hardware(), registry).err().unwrap().to_string()
    };
    assert!(Robot::new(&model, Some(&config), Options::default()).is_ok());
    assert_eq!(
        Robot::new(&model, Some(&config), hardware()).err().unwrap().to_string(),
        "device 'arm': nothing drives an interface of type 'log'; no driver is registered"
    );
    let mut registry = Registry::default();
    for kind in ["dynamixel", "franka"] {
        registry.register(kind, |_| Err(Fault::Unreachable("no port".to_owned())));
    }
    assert_eq!(
        refused(Some(&config), &registry),
        "device 'arm': nothing drives an interface of type 'log'; there are drivers of dynamixel, franka"
    );
    let misspelt = Config::from_toml(&CONFIG.replace("'log'", "'frank'"), "arm.toml").unwrap();
    assert!(refused(Some(&misspelt), &registry).ends_with("of type 'frank'; did you mean 'franka'?"));
    let nameless = Config::from_toml(&CONFIG.replace("type = 'log', ", ""), "arm.toml").unwrap();
    assert!(
        refused(Some(&nameless), &registry)
            .starts_with("device 'arm': its config names no type of interface")
    );
    assert!(refused(None, &registry).starts_with("device 'default_robot': its config names no type"));
    let unreachable = Config::from_toml(&CONFIG.replace("'log'", "'franka'"), "arm.toml").unwrap();
    assert_eq!(refused(Some(&unreachable), &registry), "device 'arm': it cannot be reached: no port");
}

/// A device that writes down what it is asked for, and fails where it is told to.
struct Diary {
    lines: Arc<Mutex<Vec<String>>>,
    failing: &'static str,
}

impl Diary {
    fn note(&self, line: String) -> Result<(), Fault> {
        let fails = !self.failing.is_empty() && line.starts_with(self.failing);
        self.lines.lock().unwrap().push(line);
        if fails { Err(Fault::Refused("told to".to_owned())) } else { Ok(()) }
    }
}

impl Device for Diary {
    fn connect(&mut self) -> Result<(), Fault> {
        self.note("connect".to_owned())
    }

    fn read(&mut self, values: &mut [f64]) -> Result<f64, Fault> {
        values.fill(0.25);
        self.note("read".to_owned()).map(|()| 1.0)
    }

    fn apply(&mut self, time: f64, commands: &[f64]) -> Result<(), Fault> {
        self.note(format!("apply {time} {commands:?}"))
    }

    fn reset(&mut self, targets: &[f64]) -> Result<(), Fault> {
        self.note(format!("reset {targets:?}"))
    }

    fn close(&mut self) -> Result<(), Fault> {
        self.note("close".to_owned())
    }
}

fn diary(failing: &'static str) -> (Registry, Arc<Mutex<Vec<String>>>) {
    let lines = Arc::new(Mutex::new(Vec::new()));
    let (mut registry, kept) = (Registry::default(), lines.clone());
    registry.register("log", move |config: &DeviceConfig| {
        assert_eq!(config.interface.parameters["gain"], Value::Integer(3));
        Ok(Box::new(Diary { lines: kept.clone(), failing }))
    });
    (registry, lines)
}

#[test]
fn devices_get_commands_in_their_units_and_are_closed() {
    let (model, mut data, config) = arm();
    let mut rng = Generator::pcg64(1_u64);
    let (registry, lines) = diary("");
    let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    data.state.qpos[0] = 0.25;
    data.state.time = 0.5;
    robot.reset(&model, &data, &mut rng).unwrap();
    assert_eq!(robot.control(&model, &data, &[0.75], 0.1).unwrap(), [0.75]);
    robot.close().unwrap();
    assert_eq!(*lines.lock().unwrap(), ["connect", "reset [-0.5]", "read", "apply 0.5 [0.5]", "close"]);

    lines.lock().unwrap().clear();
    drop(Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap());
    assert_eq!(*lines.lock().unwrap(), ["connect", "close"]);
}

#[test]
fn devices_are_closed_when_a_later_one_cannot_be_connected() {
    let (model, _, _) = arm();
    let (mut registry, lines) = diary("");
    registry.register("lost", |_| Err(Fault::Unreachable("no port".to_owned())));
    let two = CONFIG.to_owned()
        + "\n[[device]]\nname = 'leg'\ninterface = { type = 'lost' }\nsensor = [{ name = 'v', range = [-1, 1] }]";
    let config = Config::from_toml(&two, "two.toml").unwrap();
    let error = Robot::with_devices(&model, Some(&config), hardware(), &registry).err().unwrap();
    assert_eq!(error.to_string(), "device 'leg': it cannot be reached: no port");
    assert_eq!(*lines.lock().unwrap(), ["connect", "close"]);
}

#[test]
fn every_failure_names_the_device() {
    let (model, data, config) = arm();
    let mut rng = Generator::pcg64(1_u64);
    let expected = "device 'arm': it refused: told to";
    let (registry, _) = diary("connect");
    let error = Robot::with_devices(&model, Some(&config), hardware(), &registry).err().unwrap();
    assert_eq!(error.to_string(), expected);
    for failing in ["reset", "read"] {
        let (registry, _) = diary(failing);
        let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
        assert_eq!(robot.reset(&model, &data, &mut rng).unwrap_err().to_string(), expected);
    }
    let (registry, _) = diary("apply");
    let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    assert_eq!(robot.control(&model, &data, &[0.0], 0.1).unwrap_err().to_string(), expected);
    let (registry, _) = diary("close");
    let robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    assert_eq!(robot.close().unwrap_err().to_string(), expected);
}

#[test]
fn devices_that_are_not_connected_say_so() {
    let mut devices: [Box<dyn Device>; 2] =
        [Box::new(robohive_robot::Simulated::new(1)), Box::new(Replay::new([], Units::Model))];
    for device in &mut devices {
        for connected in [false, true, false] {
            let expected = if connected { Ok(()) } else { Err(Fault::NotConnected) };
            assert_eq!(device.apply(0.0, &[]), expected);
            assert_eq!(device.reset(&[]), expected);
            assert_eq!(device.read(&mut [0.0; 2]) == Err(Fault::NotConnected), !connected);
            if connected { device.close().unwrap() } else { device.connect().unwrap() }
        }
    }
}

#[test]
fn what_the_hardware_does_not_have_stays_as_the_mirror_has_it() {
    let (model, mut data, _) = arm();
    // The velocity has no place on the hardware, nor has an object that only the simulation observes.
    let text = CONFIG
        .replace("{ name = 'v', range = [-1, 1] }", "{ name = 'v', range = [-1, 1], hdr_id = -1 }")
        + "
    [[device]]
    name = 'object'
    sensor = [{ name = 'q', range = [-1, 1] }]";
    let config = Config::from_toml(&text, "arm.toml").unwrap();
    let mut registry = Registry::default();
    registry.register("log", |device: &DeviceConfig| {
        assert_eq!((device.sensors.len(), device.actuators.len()), (1, 1));
        let records = vec![Record { time: 0.0, values: vec![0.25] }];
        Ok(Box::new(Replay::new(records, Units::Hardware)) as Box<dyn Device>)
    });
    data.state.qpos[0] = 0.75;
    data.state.qvel[0] = 0.5;
    forward(&model, &mut data).unwrap();
    let mut robot = Robot::with_devices(&model, Some(&config), hardware(), &registry).unwrap();
    let readings = robot.reset(&model, &data, &mut Generator::pcg64(1_u64)).unwrap();
    assert_eq!(readings.values, [0.0, 0.5, 0.75]);
}
