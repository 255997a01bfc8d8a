//! An environment whose robot is hardware: simulated Dynamixel servos that carry the arm of `hive/FrankaReach-v0`.

use env::{Env, Hardware, Options, OwnModels};
use protocol::Port;
use protocol::dynamixel::MODELS;
use robohive_hardware::{Services, Setup, TendedClock, registry};
use robot::{Clock, Config};
use std::f64::consts::PI;
use std::fmt::Write;
use std::io;
use std::sync::{Arc, Mutex};
use wire::dynamixel::{Bus, Servo};
use wire::{Bench, Carries, Plant, Shared, VirtualClock, VirtualPort};

const ID: &str = "hive/FrankaReach-v0";
/// The gripper's motion as an angle \[rad/m\].
const GRIPPER: f64 = 50.0;

/// `(actuator, range, range of velocities, scale, offset)` of each joint.
const JOINTS: [(&str, [f64; 2], f64, f64, f64); 8] = [
    ("joint1", [-2.8973, 2.8973], 1.0875, 1.0, PI),
    ("joint2", [-1.7628, 1.7628], 1.0875, -1.0, PI),
    ("joint3", [-2.8973, 2.8973], 1.0875, 1.0, PI),
    ("joint4", [-3.0718, -0.0698], 1.0875, -1.0, 0.0),
    ("joint5", [-2.8973, 2.8973], 1.305, 1.0, PI),
    ("joint6", [-0.0175, 3.7525], 1.305, 1.0, 0.5),
    ("joint7", [-2.8973, 2.8973], 1.305, 1.0, PI),
    ("gripper", [0.0, 0.04], 0.1, GRIPPER, 1.0),
];

fn config() -> Config {
    let mut text = "[[device]]\nname = 'arm'\n\
        interface = { type = 'dynamixel', name = 'bus', profile_velocity = 0, reset_time = 1 }\n"
        .to_owned();
    let mut sensors = String::new();
    let mut actuators = String::new();
    for (k, (name, [low, high], speed, scale, offset)) in JOINTS.into_iter().enumerate() {
        let id = 10 + k;
        let (back, away) = (1.0 / scale, -offset / scale);
        for (quantity, away) in [("position", away), ("velocity", 0.0)] {
            writeln!(
                sensors,
                "{{ name = '{name}_{quantity}', range = [-9, 9], hdr_id = '{id}:{quantity}', scale = {back}, offset = {away} }},"
            )
            .unwrap();
        }
        writeln!(
            actuators,
            "{{ name = '{name}', pos_range = [{low}, {high}], vel_range = [-{speed}, {speed}], hdr_id = {id}, scale = {scale}, offset = {offset} }},"
        )
        .unwrap();
    }
    write!(text, "sensor = [{sensors}]\nactuator = [{actuators}]").unwrap();
    Config::from_toml(&text, "arm.toml").unwrap()
}

/// The environment on servos, and their bench.
fn on_servos(carries: Carries) -> (Env, Shared) {
    let (env, bench, _) = on_tended_servos(carries);
    (env, bench)
}

/// The same with their watchdogs.
fn on_tended_servos(carries: Carries) -> (Env, Shared, Services) {
    // The model as the environment compiles it.
    let model = Env::make(ID, &OwnModels, &Options::default()).unwrap().scene().model.clone();
    let plant = Plant::new(model).unwrap();
    let mut servos = Vec::new();
    for (k, (name, _, _, scale, offset)) in JOINTS.into_iter().enumerate() {
        let mut servo = Servo::new(&MODELS[0], 10 + k as u8);
        servo.mount(plant.motor(name).unwrap(), scale, offset);
        servos.push(servo);
    }
    let mut bench = Bench::new(plant);
    let link = bench.connect(Box::new(Bus::new(servos)), carries);
    let bench: Shared = Arc::new(Mutex::new(bench));
    let services = Services::default();
    let (clocked, opened, placed) = (bench.clone(), bench.clone(), bench.clone());
    let clocks = Arc::new(move || Box::new(VirtualClock::new(clocked.clone())) as _);
    let open = move |_: &str, _: u32| -> io::Result<Box<dyn Port>> {
        Ok(Box::new(VirtualPort::new(opened.clone(), link)))
    };
    let setup = Setup::default().in_virtual_time(clocks, services.clone(), Arc::new(open)).with_armed(true);
    let (ticking, watching) = (bench.clone(), services.clone());
    let hardware = Hardware {
        cameras: None,
        registry: Arc::new(registry(&setup)),
        clock: Arc::new(move || {
            Box::new(TendedClock::new(VirtualClock::new(ticking.clone()), services.clone())) as _
        }),
        // The person between two episodes: everything is where the episode begins, and at rest.
        ready: Arc::new(move |qpos| {
            let mut bench = placed.lock().unwrap();
            let rest = vec![0.0; bench.plant().data().state.qvel.len()];
            Ok(bench.plant_mut().place(qpos, &rest)?)
        }),
        config: Some(config()),
    };
    let options = Options::default().with_seed(3).with_hardware(Some(hardware));
    (Env::make(ID, &OwnModels, &options).unwrap(), bench, watching)
}

/// A policy that leads the arm to a pose above the table, and there waves with its wrist.
fn act(k: usize) -> [f64; 8] {
    let wave = 0.2 * (0.2 * k as f64).sin();
    [0.1, -0.2, 0.05, -0.1, wave, 0.1, -wave, 0.5]
}

#[test]
fn an_episode_through_the_driver_ends_where_the_simulation_does() {
    let mut simulated = Env::make(ID, &OwnModels, &Options::default().with_seed(3)).unwrap();
    let (mut real, bench) = on_servos(Carries::AT_ONCE);
    simulated.reset(Some(3)).unwrap();
    real.reset(Some(3)).unwrap();
    let (mut worst, mut rewards) = ([0.0_f64; 2], [0.0; 2]);
    for k in 0..50 {
        rewards[0] += simulated.step(&act(k)).unwrap().reward;
        rewards[1] += real.step(&act(k)).unwrap().reward;
        let bench = bench.lock().unwrap();
        let (here, there) = (&bench.plant().data().state.qpos, &simulated.scene().data.state.qpos);
        let away = here.iter().zip(there.iter()).take(7).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        worst[usize::from(k > 40)] = worst[usize::from(k > 40)].max(away);
    }
    assert!(
        (real.scene().data.time() - simulated.scene().data.time()).abs() < 1e-6,
        "{}",
        real.scene().data.time()
    );
    // On the way, where the limit of velocity begins each step from what was measured, the rounding of one step adds to that
    // of the next. At the end the command is rounded to a unit of 1.5 mrad, and friction (0.2 N m on a servo of 200 N m/rad)
    // lets the wrist rest up to 1 mrad to either side of it.
    let friction = 0.2 / 200.0;
    let unit = protocol::dynamixel::Model::POSITION_UNIT;
    assert!(worst[0] < 10e-3 && worst[1] < unit / 2.0 + 2.0 * friction, "{worst:?}");
    assert!((rewards[0] - rewards[1]).abs() < 0.05 * rewards[0].abs(), "{rewards:?}");
}

#[test]
fn the_mirror_shows_what_the_servos_measure_and_a_fault_names_the_device() {
    let (mut real, bench) = on_servos(Carries::serial(4e6));
    assert!(real.step(&[0.0; 8]).unwrap_err().to_string().contains("nothing moves before it is armed"));
    real.reset(Some(1)).unwrap();
    real.step(&[0.3; 8]).unwrap();
    let away = {
        let bench = bench.lock().unwrap();
        let plant = bench.plant().data().state.qpos.clone();
        real.scene()
            .data
            .state
            .qpos
            .iter()
            .zip(plant.iter())
            .take(7)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max)
    };
    assert!(away < 0.02, "{away}");
    bench.lock().unwrap().stop_button(true);
    let error = (0..5).find_map(|_| real.step(&[0.3; 8]).err()).expect("the servos are gone").to_string();
    assert!(error.contains("arm") && error.contains("ms old"), "{error}");
}

#[test]
fn a_held_episode_keeps_the_watchdogs_quiet_and_silence_does_not() {
    let (mut real, bench, services) = on_tended_servos(Carries::serial(4e6));
    assert!(real.is_live());
    real.reset(Some(1)).unwrap();
    // Before the first command the servos rest, however long.
    (0..10).for_each(|_| real.hold().unwrap());
    for _ in 0..5 {
        real.step(&[0.2; 8]).unwrap();
    }
    let (before, told) = (bench.lock().unwrap().time(), real.robot().last_control().to_vec());
    for _ in 0..20 {
        real.hold().unwrap();
    }
    let passed = bench.lock().unwrap().time() - before;
    assert!((passed - 20.0 * real.dt()).abs() < 1e-6, "{passed}");
    assert_eq!((real.steps(), real.robot().last_control()), (5, &told[..]), "no step, and no other command");
    // The observation is what is measured now.
    let away = |real: &Env| {
        let bench = bench.lock().unwrap();
        let (here, there) = (&real.scene().data.state.qpos, &bench.plant().data().state.qpos);
        here.iter().zip(there).take(7).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    assert!(away(&real) < 5e-3, "{}", away(&real));
    // What an action would become is told to nobody.
    let [low, high] = [-1.0, 1.0].map(|end| real.controls_of(&[end; 8]).unwrap());
    assert!(low.iter().zip(&high).all(|(low, high)| low < high));
    real.hold().unwrap();
    assert_eq!(real.robot().last_control(), &told[..]);
    real.step(&[0.2; 8]).unwrap();
    // Nobody says anything for longer than the watchdog waits.
    TendedClock::new(VirtualClock::new(bench.clone()), services).wait(0.4);
    let error = real.hold().unwrap_err().to_string();
    assert!(error.contains("its watchdog stopped it: no command came for 0.25 s"), "{error}");
    assert!(real.step(&[0.2; 8]).is_err());
    real.reset(Some(1)).unwrap();
    real.step(&[0.2; 8]).unwrap();
}
