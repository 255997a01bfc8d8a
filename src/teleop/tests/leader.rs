//! A leader arm of simulated servos, on a virtual clock: its weight is carried, and a robot comes to where it is and follows.

use env::{Env, Options, OwnModels};
use hardware::{Services, Setup, TendedClock};
use physics::Model;
use random::Generator;
use robohive_teleop::{
    Control, Event, Gravity, GravitySettings, Held, Input, LeaderArm, LeaderConfig, Leading, Mapping, Mark,
    Plan, Reached, Session,
};
use robot::{Clock, Config};
use std::sync::{Arc, Mutex};
use wire::{Plant, Shared, VirtualClock, VirtualPort, rig};

const ARM: &str = include_str!("leader/arm.xml");
const SERVOS: &str = include_str!("leader/servos.toml");
const LEADER: &str = include_str!("leader/leader.toml");
const JOINTS: usize = 7;
/// Time between two readings of the arm [s].
const TICK: f64 = 0.01;

fn model(arm: &str) -> Model {
    mjcf::load_str(arm).unwrap().model
}

/// Servos on a plant, and the arm that reads them.
struct Bench {
    bench: Shared,
    clock: TendedClock<VirtualClock>,
    arm: LeaderArm,
    motors: Vec<usize>,
}

impl Bench {
    /// An arm as `plant` says; of the weight of [`ARM`] this share is carried.
    fn new(plant: &str, share: f64) -> Bench {
        Bench::of(plant, share, devices())
    }

    /// The same with the servos of a config.
    fn of(plant: &str, share: f64, config: Config) -> Bench {
        let leader = leader();
        let (bench, rigged) = rig(&config, Plant::new(model(plant)).unwrap(), true).unwrap();
        let motors = (1..=JOINTS).map(|k| bench.plant().motor(&format!("joint{k}")).unwrap()).collect();
        let (bench, link) = (Arc::new(Mutex::new(bench)), rigged[0].links[0].1);
        let (services, clocked, opened) = (Services::default(), bench.clone(), bench.clone());
        let open = move |_: &str, _: u32| Ok(Box::new(VirtualPort::new(opened.clone(), link)) as _);
        let clocks = Arc::new(move || Box::new(VirtualClock::new(clocked.clone())) as _);
        let setup =
            Setup::default().in_virtual_time(clocks, services.clone(), Arc::new(open)).with_armed(true);
        let carried = leader
            .gravity
            .clone()
            .filter(|_| share > 0.0)
            .map(|settings| GravitySettings { share, ..settings });
        let gravity = carried.map(|settings| Gravity::new(model(ARM), &config, &settings).unwrap());
        let arm =
            LeaderArm::connect(&leader, &config, gravity, |device| hardware::device(device, &setup)).unwrap();
        let clock = TendedClock::new(VirtualClock::new(bench.clone()), services);
        Bench { bench, clock, arm, motors }
    }

    /// A hand that holds the joints there, and lets go at the end.
    fn hold(&self, joints: &[f64]) {
        let places: Vec<(usize, f64)> = self.motors.iter().copied().zip(joints.iter().copied()).collect();
        self.bench.lock().unwrap().plant_mut().hold(&places).unwrap();
    }

    fn handle(&self) -> [f64; 3] {
        let bench = self.bench.lock().unwrap();
        let (model, data) = (bench.plant().model(), bench.plant().data());
        data.kin.site_xpos[model.site("handle").unwrap().index()]
    }

    fn tend(&mut self) -> Vec<Event> {
        let mut events = Vec::new();
        let now = self.clock.now();
        self.arm.tend(now, &mut events).unwrap();
        self.clock.wait(TICK);
        events
    }
}

fn devices() -> Config {
    Config::from_toml(SERVOS, "servos.toml").unwrap()
}

fn leader() -> LeaderConfig {
    LeaderConfig::from_toml(LEADER, "leader.toml").unwrap()
}

/// A pose, anywhere within the ranges of the joints.
fn pose(rng: &mut Generator<random::Pcg64>) -> Vec<f64> {
    let devices = devices();
    let ranges = devices.devices[0].actuators.iter().map(|actuator| actuator.position_range);
    ranges.map(|[low, high]| low + (high - low) * rng.random()).collect()
}

/// Distance of the handle from where it was released, after two seconds, and at most [m].
fn released(bench: &mut Bench, joints: &[f64]) -> f64 {
    // The servos know the pose before the hand lets go.
    for _ in 0..3 {
        bench.hold(joints);
        bench.tend();
    }
    bench.hold(joints);
    let start = bench.handle();
    let mut largest: f64 = 0.0;
    for _ in 0..200 {
        bench.tend();
        let now = bench.handle();
        largest = largest.max((0..3).map(|k| (now[k] - start[k]).powi(2)).sum::<f64>().sqrt());
    }
    largest
}

/// The largest and the middle of some numbers.
fn summary(mut ways: Vec<f64>) -> (f64, f64) {
    ways.sort_by(f64::total_cmp);
    (ways[ways.len() - 1], ways[ways.len() / 2])
}

#[test]
fn servos_carry_the_arm_wherever_it_is_let_go_of() {
    let mut rng = Generator::pcg64(7_u64);
    let poses: Vec<Vec<f64>> = (0..20).map(|_| pose(&mut rng)).collect();
    let fall = |plant: &str, share: f64| {
        summary(poses.iter().map(|joints| released(&mut Bench::new(plant, share), joints)).collect())
    };
    let (carried, fallen) = (fall(ARM, 1.0), fall(ARM, 0.0));
    println!("handle after release, largest and median [m]: carried {carried:.4?}, without {fallen:.3?}");
    assert!(carried.0 < 0.002, "carried, it stays: {carried:?} m");
    assert!(fallen.1 > 0.1, "otherwise it falls: {fallen:?} m");
    // Every part weighs a tenth more than the model says.
    let heavier = [["0.082", "0.0902"], ["0.04", "0.044"], ["0.06", "0.066"]]
        .iter()
        .fold(ARM.to_owned(), |arm, [own, more]| {
            arm.replace(&format!("mass=\"{own}\""), &format!("mass=\"{more}\""))
        });
    let (sinking, told) = (fall(&heavier, 1.0), fall(&heavier, 1.1));
    println!("a tenth heavier than its model {sinking:.3?}, with share = 1.1 {told:.4?}");
    assert!(sinking.1 < fallen.1 && told.0 < 0.002, "{sinking:?} {told:?}");
}

fn led_mapping() -> Mapping {
    let mut mapping = Mapping::default();
    mapping.led = Some(Leading::Arm(leader()));
    mapping
}

/// A session on hive/FrankaReach-v0, whose arm the leader leads.
struct Led {
    session: Session,
    mapping: Mapping,
    held: Held,
    bench: Bench,
}

impl Led {
    fn new() -> Led {
        let env = Env::make("hive/FrankaReach-v0", &OwnModels, &Options::default()).unwrap();
        let mapping = led_mapping();
        let session = Session::new(env, Control::Joints, &mapping, Plan::default()).unwrap();
        Led { session, mapping, held: Held::default(), bench: Bench::new(ARM, 1.0) }
    }

    /// Where the robot's joints are.
    fn robot(&self) -> Vec<f64> {
        self.session.env().scene().data.state.qpos[..JOINTS].to_vec()
    }

    /// Where they are sent.
    fn sent(&self) -> Vec<f64> {
        self.session.env().robot().last_control()[..JOINTS].to_vec()
    }

    /// A tick of the session, in which the arm is read as often as it is due.
    fn tick(&mut self, marks: Vec<Mark>) -> (bool, Option<Reached>) {
        for _ in 0..8 {
            for event in self.bench.tend() {
                let now = self.bench.clock.now();
                self.held.apply(event, now);
            }
        }
        let mut input: Input = self.mapping.read(&self.held.sample(self.bench.clock.now()));
        input.marks = marks;
        let ticked = self.session.tick(&input).unwrap();
        (ticked.stepped, ticked.refused)
    }
}

fn furthest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn feetech_servos_lead_too_and_are_read_alone() {
    let feetech = SERVOS
        .replace("dynamixel", "feetech")
        .replace("mode = \"current\", ", "")
        .replace(", safe = \"off\"", "");
    let mut bench = Bench::of(ARM, 0.0, Config::from_toml(&feetech, "servos.toml").unwrap());
    let place = [0.3, -0.4, 0.5, -1.2, -0.6, 1.1, 0.7];
    bench.hold(&place);
    let read: Vec<f64> = bench
        .tend()
        .iter()
        .map(|event| match event {
            Event::Lead(_, angle) => *angle,
            other => panic!("{other:?}"),
        })
        .collect();
    let off = furthest(&read, &place);
    println!("seven STS3215 read to {off:.5} rad");
    assert!(
        off < std::f64::consts::TAU / 4096.0 && read.len() == JOINTS,
        "half a step is rounding: {read:?}"
    );
    // Nothing holds the arm.
    bench.hold(&place);
    let start = bench.handle();
    for _ in 0..100 {
        bench.tend();
    }
    let end = bench.handle();
    assert!((0..3).map(|k| (end[k] - start[k]).powi(2)).sum::<f64>().sqrt() > 0.1, "{start:?} {end:?}");
}

#[test]
fn the_robot_comes_to_the_leader_slowly_and_follows_it_then() {
    let mut led = Led::new();
    let start = led.robot();
    let mut place = start.clone();
    place[0] += 0.6;
    place[3] += 0.4;
    led.bench.hold(&place);
    assert!(!led.tick(vec![]).0, "time stands still until it is let go on");
    // It comes at half a radian a second.
    let dt = led.session.env().dt();
    led.tick(vec![Mark::Pause]);
    let (mut last, mut fastest, mut ticks) = (led.sent(), 0.0_f64, 1);
    while furthest(&led.sent(), &place) > 0.01 {
        led.bench.hold(&place);
        led.tick(vec![]);
        fastest = fastest.max(furthest(&led.sent(), &last) / dt);
        last = led.sent();
        ticks += 1;
        assert!(ticks < 60, "it comes: {:?} {place:?}", led.robot());
    }
    println!("0.6 rad away, caught up with after {:.2} s, {fastest:.2} rad/s at most", f64::from(ticks) * dt);
    assert!((0.45..0.55).contains(&fastest), "{fastest} rad/s");
    for _ in 0..10 {
        led.tick(vec![]);
    }
    // Led about, it follows; the handle is held by a hand that moves.
    let mut behind: f64 = 0.0;
    for k in 0..75 {
        let time = f64::from(k) * dt;
        let mut moved = place.clone();
        for joint in [4, 6] {
            moved[joint] += 0.25 * (1.0 - (1.5 * time).cos());
        }
        let seen = led.robot();
        led.bench.hold(&moved);
        led.tick(vec![]);
        assert_eq!(led.session.counts().0, 0, "the episode goes on");
        if k > 3 {
            behind = behind.max(furthest(&seen, &moved));
        }
    }
    println!("led at up to 0.375 rad/s, the robot is up to {behind:.3} rad behind");
    assert!(behind < 0.12, "{behind}");
}

#[test]
fn a_leader_that_is_far_away_moves_nothing_and_is_caught_up_with_after_a_pause() {
    let mut led = Led::new();
    let start = led.robot();
    let mut place = start.clone();
    place[0] += 1.4;
    led.bench.hold(&place);
    led.tick(vec![Mark::Pause]);
    for _ in 0..10 {
        led.bench.hold(&place);
        let (stepped, refused) = led.tick(vec![]);
        assert!(stepped && refused == Some(Reached::Apart));
    }
    assert!(furthest(&led.sent(), &start) < 1e-9, "{:?} {start:?}", led.sent());
    // Brought near, and caught.
    for _ in 0..30 {
        led.bench.hold(&start);
        assert_eq!(led.tick(vec![]).1, None);
    }
    // During a pause the leader goes somewhere else.
    led.tick(vec![Mark::Pause]);
    place[0] = start[0] + 0.5;
    led.bench.hold(&place);
    led.tick(vec![Mark::Pause]);
    let before = led.sent();
    led.bench.hold(&place);
    led.tick(vec![]);
    let moved = furthest(&led.sent(), &before);
    assert!((0.03..0.045).contains(&moved), "half a radian a second, {moved} rad in a tick of 0.08 s");
}

#[test]
fn configs_that_are_wrong_say_where() {
    let cases = [
        ("", "lacks the text 'devices'"),
        ("devices = 'a.toml'", "no [[joint]]"),
        ("devices = 'a.toml'\n[[joint]]\nsensor = 'a'", "joint 1 lacks the text 'actuator'"),
        ("devices = 'a.toml'\n[[joint]]\nsensor = 'a'\nactuator = 'b'\nscale = 0", "scale must not be 0"),
        ("devices = 'a.toml'\n[[joint]]\nsensor = 'a'\nactuator = 'b'\nsign = -1", "'sign'; the entries are"),
        ("devices = 'a.toml'\n[catch_up]\nspeed = 'fast'\n[[joint]]\nsensor = 'a'\nactuator = 'b'", "speed"),
        (
            "devices = 'a.toml'\n[gravity]\nmodel = 'm'\n[[joint]]\nsensor = 'a'\nactuator = 'b'",
            "'torque_constant'",
        ),
        (
            "devices = 'a.toml'\ngravity = true\n[[joint]]\nsensor = 'a'\nactuator = 'b'",
            "gravity is a section",
        ),
        (
            "devices = 'a.toml'\n[[joint]]\nsensor = 'a'\nactuator = 'b'\n[[joint]]\nsensor = 'c'\nactuator = 'b'",
            "two joints lead the actuator 'b'",
        ),
        ("devices = 'a.toml'\n[[joint]]\nsensor = 'a'\nactuator = 'b'\noffset = nan", "no number from -1.79"),
        ("devices =", "leader.toml"),
    ];
    for (text, says) in cases {
        let error = LeaderConfig::from_toml(text, "leader.toml").unwrap_err().to_string();
        assert!(error.contains(says) && error.contains("leader.toml"), "{text}: {error}");
    }
    let settings = leader().gravity.unwrap();
    for (from, to, says) in [
        ("\"current\"", "\"position\"", "mode = \"current\""),
        ("name = \"joint3\",", "name = \"j3\",", "'j3'"),
    ] {
        let config = Config::from_toml(&SERVOS.replace(from, to), "servos.toml").unwrap();
        let error = Gravity::new(model(ARM), &config, &settings).err().unwrap().to_string();
        assert!(error.contains(says), "{error}");
    }
    let other = LeaderConfig::from_toml(&LEADER.replace("joint5_position", "elbow"), "leader.toml").unwrap();
    let error = LeaderArm::connect(&other, &devices(), None, |_| unreachable!()).err().unwrap().to_string();
    assert!(error.contains("'elbow'") && error.contains("joint5_position"), "{error}");
    let env = Env::make("hive/ElbowPose-v0", &OwnModels, &Options::default()).unwrap();
    let mapping = led_mapping();
    let error = Session::new(env, Control::Joints, &mapping, Plan::default()).err().unwrap().to_string();
    assert!(error.contains("joint1"), "{error}");
}
