//! A simulated glove whose wearer moves a small hand, on a virtual clock and over a pseudo-terminal.

#![cfg(unix)]

use env::{Env, Options, OwnModels, Registry};
use protocol::Port;
use protocol::cyberglove::{COUNT, STREAM, rate};
use robohive_teleop::devices::{Opened, wait};
use robohive_teleop::{
    Axis, Calibration, Control, Device, Event, Glove, Held, Input, Leading, Mapping, Mark, Plan, Session,
};
use std::fmt::Write;
use std::os::fd::AsFd;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use wire::cyberglove::{Glove as Worn, Worn as Script};
use wire::{Bench, Carries, End, Plant, Terminal, VirtualPort, serve};

/// Two fingers of two joints, and a thumb.
const HAND: &str = "<mujoco><compiler angle='radian'/><option timestep='0.004' gravity='0 0 0'/>
    <default><joint damping='.01' armature='.001'/><geom size='.01' mass='.02' contype='0' conaffinity='0'/></default><worldbody>
    <body name='index'><joint name='i1' axis='0 1 0'/><geom/><body pos='0 0 .05'><joint name='i2' axis='0 1 0'/><geom/><site name='tip' pos='0 0 .03'/></body></body>
    <body name='middle' pos='0 .03 0'><joint name='m1' axis='0 1 0'/><geom/><body pos='0 0 .05'><joint name='m2' axis='0 1 0'/><geom/></body></body>
    <body name='thumb' pos='0 -.03 0'><joint name='t' axis='1 0 0'/><geom/></body><site name='target' pos='.05 0 .05'/></worldbody>
    <actuator><position name='I1' joint='i1' kp='2' kv='.05' ctrlrange='0 1.6'/><position name='I2' joint='i2' kp='2' kv='.05' ctrlrange='0 1.6'/>
    <position name='M1' joint='m1' kp='2' kv='.05' ctrlrange='0 1.6'/><position name='M2' joint='m2' kp='2' kv='.05' ctrlrange='0 1.6'/>
    <position name='T' joint='t' kp='2' kv='.05' ctrlrange='-.5 .5'/></actuator></mujoco>";

/// Sensors of the index's inner and middle joint, the middle finger's, and the thumb's roll, by the names of the protocol.
const USED: [(&str, &str, [f64; 2]); 5] = [
    ("index_inner", "I1", [0.0, 1.6]),
    ("index_middle", "I2", [0.0, 1.6]),
    ("middle_inner", "M1", [0.0, 1.6]),
    ("middle_middle", "M2", [0.0, 1.6]),
    ("thumb_roll", "T", [-0.5, 0.5]),
];

/// The place of a sensor in a sample.
fn sensor(name: &str) -> usize {
    protocol::cyberglove::SENSORS.iter().position(|known| *known == name).unwrap()
}

/// 24 joints, of which the small hand has five: each follows one sensor, and the thumb half of one, from a quarter of its range on.
fn calibration() -> String {
    let mut text = format!("min = {:?}\nmax = {:?}\nmatrix = [\n", [50; 22], [200; 22]);
    let (mut ranges, mut names) = (String::new(), String::new());
    for joint in 0..24 {
        let mut row = [0.0; 23];
        let used = USED.get(joint);
        if let Some((name, ..)) = used {
            row[sensor(name)] = 1.0;
            if *name == "thumb_roll" {
                (row[sensor(name)], row[22]) = (0.5, 0.25);
            }
        }
        writeln!(text, "{row:?},").unwrap();
        let (_, actuator, [low, high]) = used.copied().unwrap_or(("", "", [0.0, 1.0]));
        write!(ranges, "[{low:.1}, {high:.1}], ").unwrap();
        write!(names, "'{actuator}', ").unwrap();
    }
    text + &format!("]\nranges = [{ranges}]\nactuators = [{names}]\n")
}

fn hand() -> Env {
    // Tests run side by side, each with a file of its own.
    static HANDS: AtomicUsize = AtomicUsize::new(0);
    let (process, number) = (std::process::id(), HANDS.fetch_add(1, Ordering::Relaxed));
    let path = std::env::temp_dir().join(format!("robohive-glove-{process}-{number}.xml"));
    std::fs::write(&path, HAND).unwrap();
    let mut registry = Registry::default();
    let table = format!(
        "suite = 'test'\n['hand-v0']\ntask = 'reach'\nmax_episode_steps = 1000\nmodel_path = '{}'\nframe_skip = 10\n\
        robot_site_name = 'tip'\ntarget_site_name = 'target'\ntarget_xyz_range = {{ low = [0, 0, 0], high = [0, 0, 0] }}\n",
        path.display()
    );
    registry.add_table(&table).unwrap();
    Env::build(registry.spec("hand-v0").unwrap(), &OwnModels, &Options::default()).unwrap()
}

/// Raw values of a hand whose index is closed by this part.
fn closed(part: f64) -> Vec<u8> {
    let mut values = vec![50; 22];
    for name in ["index_inner", "index_middle"] {
        values[sensor(name)] = (50.0 + 150.0 * part) as u8;
    }
    values[sensor("thumb_roll")] = 125;
    values
}

fn bench(script: Script) -> (Arc<Mutex<Bench>>, wire::LinkId) {
    let mut bench = Bench::new(Plant::new(hand().scene().model.clone()).unwrap());
    let link = bench.connect(Box::new(Worn::new(22, script)), Carries::serial(115_200.0));
    (Arc::new(Mutex::new(bench)), link)
}

#[test]
fn a_calibration_is_applied_as_robohive_does() {
    let calibration = Calibration::from_toml(&calibration(), "glove.toml").unwrap();
    let raw: Vec<f64> = closed(0.5).into_iter().map(f64::from).collect();
    let joints = calibration.joints(&raw);
    assert_eq!(joints.len(), 24);
    assert!((joints[0] - 0.8).abs() < 1e-12 && (joints[1] - 0.8).abs() < 1e-12, "{joints:?}");
    assert_eq!(
        (joints[2], joints[4]),
        (0.0, 0.0),
        "the middle finger is straight, and the thumb in its middle"
    );
    // Beyond what the person can do counts as the end.
    let far = calibration.joints(&[255.0; 22]);
    assert_eq!((far[0], far[4]), (1.6, 0.25));
    assert_eq!(calibration.joints(&[1.0; 22])[4], -0.25);
}

#[test]
fn a_glove_with_more_sensors_than_its_calibration_leads_nothing() {
    let text = format!(
        "min = {:?}\nmax = {:?}\nmatrix = [{:?}]\nranges = [[0, 1]]\nactuators = ['M2']",
        [0; 18], [255; 18], [0.0; 19]
    );
    let mut mapping = Mapping::default();
    mapping.led = Some(Leading::Glove(Calibration::from_toml(&text, "glove.toml").unwrap()));
    for (sensors, leads) in [(17, false), (18, true), (22, false)] {
        let mut held = robohive_teleop::Held::default();
        (0..sensors).for_each(|k| held.apply(Event::Move(Axis(Device::Glove, k), 100.0), 0.0));
        assert_eq!(mapping.read(&held.sample(0.0)).motion.led.is_some(), leads, "{sensors} sensors");
    }
}

#[test]
fn calibrations_that_do_not_fit_together_are_refused() {
    let whole = calibration();
    for (from, to, says) in [
        ("min = [50, ", "min = [", "18 or 22 values"),
        ("min = [50, ", "min = [200, ", "sensor 0: its least value 200 is not below 200"),
        ("matrix = [\n[0.0, ", "matrix = [\n[", "row 0 of 'matrix' has 22 values, and not 23"),
        ("[0.0, 1.6], ", "", "24 rows of 'matrix' need as many"),
        ("[0.0, 1.6], ", "[1.6, 0.0], ", "24 rows of 'matrix' need as many"),
        ("matrix", "matrices", "it lacks the list 'matrix'"),
        ("max = [200", "max = ['x'", "'max' has something else than numbers"),
    ] {
        assert!(whole.contains(from), "{from}");
        let error =
            Calibration::from_toml(&whole.replacen(from, to, 1), "glove.toml").unwrap_err().to_string();
        assert!(error.starts_with("glove.toml: ") && error.contains(says), "{from}: {error}");
    }
    let mut mapping = Mapping::default();
    mapping.led =
        Some(Leading::Glove(Calibration::from_toml(&whole.replace("'M2'", "'M3'"), "glove.toml").unwrap()));
    let error = Session::new(hand(), Control::Joints, &mapping, Plan::default()).err().unwrap().to_string();
    assert!(error.contains("no actuator \"M3\""), "{error}");
}

#[test]
fn a_hand_in_a_glove_closes_the_finger_of_the_robot_and_one_that_is_unplugged_stops_it() {
    // It closes its index in a second, and pulls the glove out after two.
    let (bench, link) = bench(Box::new(|time| closed((time - 0.2).clamp(0.0, 1.0))));
    let mut port = VirtualPort::new(bench.clone(), link);
    port.send(&[&COUNT[..], &rate(80.0), &[STREAM]].concat()).unwrap();
    let (mut glove, mut held, mut mapping) = (Glove::default(), Held::default(), Mapping::default());
    mapping.led = Some(Leading::Glove(Calibration::from_toml(&calibration(), "glove.toml").unwrap()));
    let mut session = Session::new(hand(), Control::Joints, &mapping, Plan::default()).unwrap();
    let mut bytes = [0; 256];
    let mut tick = |session: &mut Session, marks: Vec<Mark>| -> Input {
        let due = port.now() + session.period();
        while port.now() < due {
            let count = port.receive(&mut bytes, due - port.now()).unwrap();
            let mut events: Vec<Event> = Vec::new();
            glove.feed(&bytes[..count], &mut events);
            events.into_iter().for_each(|event| held.apply(event, port.now()));
        }
        let mut input = mapping.read(&held.sample(port.now()));
        input.marks.extend(marks);
        session.tick(&input).unwrap();
        input
    };
    let index = |session: &Session| session.env().scene().data.state.qpos[0];
    // A glove alone begins nothing.
    tick(&mut session, Vec::new());
    let input = tick(&mut session, Vec::new());
    assert!(input.motion.led.is_some() && session.is_paused() && session.steps().0 == 0);
    tick(&mut session, vec![Mark::Pause]);
    let mut largest: f64 = 0.0;
    for _ in 0..45 {
        let before = index(&session);
        tick(&mut session, Vec::new());
        largest = largest.max(index(&session) - before);
    }
    let qpos = session.env().scene().data.state.qpos.clone();
    assert!((qpos[0] - 1.6).abs() < 0.05 && (qpos[1] - 1.6).abs() < 0.05, "the index is closed: {qpos:?}");
    assert!(qpos[2].abs() < 0.05 && qpos[4].abs() < 0.05, "and nothing else: {qpos:?}");
    println!("at most {largest:.3} rad a tick of 0.04 s");
    assert!(largest < 0.2, "{largest}");
    // Without the glove the hand stays as it is.
    bench.lock().unwrap().stop_button(true);
    (0..5).for_each(|_| drop(tick(&mut session, Vec::new())));
    let input = tick(&mut session, Vec::new());
    assert!(input.motion.led.is_none());
    assert!((index(&session) - 1.6).abs() < 0.05);
}

#[test]
fn a_glove_on_a_serial_port_streams_and_says_when_it_is_unplugged() {
    let (bench, link) = bench(Box::new(|_| closed(1.0)));
    let terminal = Terminal::open().unwrap();
    let path = terminal.path().to_owned();
    let mut ends = [(link, End::Terminal(terminal))];
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let served = scope.spawn(|| serve(&bench, &mut ends, &stop));
        let outcome = std::panic::catch_unwind(|| {
            let mut opened = Opened::glove(&path).unwrap();
            let mut events = Vec::new();
            while events.len() < 220 {
                assert_eq!(wait(&[opened.as_fd()], 60.0).unwrap(), [true]);
                opened.read(&mut events).unwrap();
            }
            let index = Axis(Device::Glove, sensor("index_inner") as u16);
            assert!(events.contains(&Event::Move(index, 200.0)));
            bench.lock().unwrap().stop_button(true);
            let error = loop {
                assert_eq!(wait(&[opened.as_fd()], 60.0).unwrap(), [true]);
                if let Err(error) = opened.read(&mut events) {
                    break error.to_string();
                }
            };
            assert!(error.contains("no glove is plugged into the interface"), "{error}");
        });
        stop.store(true, Ordering::Relaxed);
        served.join().unwrap().unwrap();
        outcome.unwrap();
    });
    let missing = Opened::glove("/nonexistent/ttyUSB0".as_ref()).err().unwrap().to_string();
    assert!(missing.contains("--device glove:"), "{missing}");
}
