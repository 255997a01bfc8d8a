//! Two arms at once, on a small model: by both controllers of a headset, and by two devices side by side. No environment of RoboHive's
//! has two arms.

use env::{Env, Options, OwnModels, Registry};
use robohive_teleop::{
    Axis, Button, Control, Device, Event, Held, Input, Key, Mapping, Plan, Quest, Session, TeleopError,
};
use std::fmt::Write;
use std::sync::atomic::{AtomicUsize, Ordering};

/// An arm of six joints with a gripper; `y` is where its base stands, and `side` ends its names.
fn arm(side: &str, y: f64) -> [String; 2] {
    // Bent about y where an episode begins.
    let joints = [
        ("0 0 0", "0 0 1", "0 0 0 0 0 .2", 0.0),
        ("0 0 .2", "0 1 0", "0 0 0 .25 0 0", -0.7),
        ("0.25 0 0", "0 1 0", "0 0 0 .25 0 0", 1.4),
        ("0.25 0 0", "0 1 0", "0 0 0 .05 0 0", -0.7),
        ("0.05 0 0", "0 0 1", "0 0 0 .03 0 0", 0.0),
        ("0.03 0 0", "1 0 0", "0 0 0 .03 0 0", 0.0),
    ];
    let (mut bodies, mut actuators) = (format!("<body pos='0 {y} 0'>"), String::new());
    for (k, (pos, axis, fromto, bent)) in joints.iter().enumerate() {
        write!(
            bodies,
            "<body pos='{pos}' euler='0 {bent} 0'><joint name='j{k}{side}' axis='{axis}' range='-3 3'/><geom type='capsule' size='.02' fromto='{fromto}' mass='.3'/>"
        )
        .unwrap();
        write!(
            actuators,
            "<position name='a{k}{side}' joint='j{k}{side}' kp='400' kv='20' ctrlrange='-3 3'/>"
        )
        .unwrap();
    }
    write!(
        bodies,
        "<site name='hand{side}' pos='.08 0 0'/><body pos='.05 0 0'><joint name='f{side}' type='slide' axis='0 1 0' range='0 .04'/><geom size='.01' mass='.02'/></body>{}</body>",
        "</body>".repeat(joints.len())
    )
    .unwrap();
    write!(actuators, "<position name='f{side}' joint='f{side}' kp='100' kv='5' ctrlrange='0 .04'/>")
        .unwrap();
    [bodies, actuators]
}

fn env() -> Env {
    static FILES: AtomicUsize = AtomicUsize::new(0);
    let (process, number) = (std::process::id(), FILES.fetch_add(1, Ordering::Relaxed));
    let path = std::env::temp_dir().join(format!("robohive-arms-{process}-{number}.xml"));
    let [left, right] = [arm("_left", 0.25), arm("_right", -0.25)];
    // The left arm stands first in the model, so that order decides nothing.
    let text = format!(
        "<mujoco><compiler angle='radian'/><option timestep='.004' integrator='implicitfast'/><default><joint damping='.5' armature='.02'/>\
        <geom contype='0' conaffinity='0'/></default><worldbody>{}{}<site name='target'/></worldbody><actuator>{}{}</actuator>\
        </mujoco>",
        left[0], right[0], left[1], right[1]
    );
    std::fs::write(&path, text).unwrap();
    let mut registry = Registry::default();
    let table = format!(
        "suite = 'test'\n['arms-v0']\ntask = 'reach'\nmax_episode_steps = 1000\nmodel_path = '{}'\nframe_skip = 10\n\
        robot_site_name = 'hand_right'\ntarget_site_name = 'target'\ntarget_xyz_range = {{ low = [0.5, 0, 0.2], high = [0.5, 0, 0.2] }}\n",
        path.display()
    );
    registry.add_table(&table).unwrap();
    Env::build(registry.spec("arms-v0").unwrap(), &OwnModels, &Options::default()).unwrap()
}

fn session(mapping: &Mapping) -> Result<Session, TeleopError> {
    Session::new(env(), Control::Hand, mapping, Plan::default())
}

fn two(more: &str) -> Mapping {
    Mapping::from_toml(
        &format!("[arm]\nsites = ['hand_right']\nleft_sites = ['hand_left']\n{more}"),
        "two.toml",
    )
    .unwrap()
}

/// The hands: right, left.
fn hands(session: &Session) -> [[f64; 3]; 2] {
    let scene = session.env().scene();
    ["hand_right", "hand_left"].map(|name| scene.data.kin.site_xpos[scene.model.site(name).unwrap().index()])
}

/// The grippers: right, left [m].
fn grippers(session: &Session) -> [f64; 2] {
    let controls = session.env().robot().last_control();
    [controls[13], controls[6]]
}

fn way(from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| to[k] - from[k])
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    way(a, b).iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[test]
fn both_controllers_of_a_headset_lead_an_arm_each() {
    let mut mapping = two("");
    let mut session = session(&mapping).unwrap();
    assert!(session.line().contains("hand ") && session.line().contains("left "), "{}", session.line());
    let start = hands(&session);
    let (mut quest, mut held) = (Quest::default(), Held::default());
    // Behind the robot, in the frame of a headset: x right, y up, z backward. The right hand goes forward by 10 cm, the left one up by 8.
    let (seconds, tick) = (2.0, session.env().dt());
    let line = |time: f64| {
        let share = (time / seconds).clamp(0.0, 1.0);
        let pose = |side: &str, [x, y, z]: [f64; 3]| format!("{side}:1 0 0 {x} 0 1 0 {y} 0 0 1 {z} 0 0 0 1");
        let hands = [pose("l", [-0.2, 0.08 * share, 0.0]), pose("r", [0.2, 0.0, -0.1 * share])];
        format!("I/quest: wE9ryARX: {}&R,RG,L,LG,rightTrig 1.0,leftTrig 0.0\n", hands.join("|"))
    };
    let mut now = 0.0;
    while now < seconds + 1.0 {
        for _ in 0..3 {
            now += tick / 3.0;
            let mut events = Vec::new();
            quest.feed(line(now).as_bytes(), &mut events);
            events.into_iter().for_each(|event| held.apply(event, now));
        }
        session.tick(&mapping.read(&held.sample(now))).unwrap();
    }
    let moved = hands(&session);
    let errors =
        [apart(way(start[0], moved[0]), [0.1, 0.0, 0.0]), apart(way(start[1], moved[1]), [0.0, 0.0, 0.08])];
    println!("two hands at once end {:.4} and {:.4} m from where they were led", errors[0], errors[1]);
    assert!(errors.iter().all(|error| *error < 0.005), "{errors:?}");
    assert_eq!(grippers(&session), [0.0, 0.04], "the right trigger closes the right gripper alone");
}

#[test]
fn a_pad_and_the_keyboard_drive_an_arm_each_and_none_moves_the_other() {
    let mut mapping =
        two("[keyboard]\nd = 'left.+y'\n'[' = 'left.close'\n[gamepad]\nx = '+z'\nwest = 'close'\n");
    let mut session = session(&mapping).unwrap();
    let mut held = Held::default();
    held.tells_releases(true);
    let mut drive = |session: &mut Session, events: &[Event], ticks: usize| {
        events.iter().for_each(|event| held.apply(*event, 0.0));
        for _ in 0..ticks {
            let input: Input = mapping.read(&held.sample(0.0));
            session.tick(&input).unwrap();
        }
    };
    let (key, stick) = (Button::Key(Key::Char('d')), Axis(Device::Gamepad, 0));
    let start = hands(&session);
    drive(&mut session, &[Event::Move(stick, 0.5)], 4);
    drive(&mut session, &[Event::Move(stick, 0.0)], 20);
    let lifted = hands(&session);
    assert!(way(start[0], lifted[0])[2] > 0.05 && apart(start[1], lifted[1]) < 0.002, "{start:?} {lifted:?}");
    drive(&mut session, &[Event::Press(key), Event::Press(Button::Key(Key::Char('[')))], 4);
    drive(&mut session, &[Event::Release(key), Event::Release(Button::Key(Key::Char('[')))], 20);
    let aside = hands(&session);
    println!(
        "the other arm moved by {:.4} and {:.4} m",
        apart(start[1], lifted[1]),
        apart(lifted[0], aside[0])
    );
    assert!(way(lifted[1], aside[1])[1] > 0.1 && apart(lifted[0], aside[0]) < 0.002, "{lifted:?} {aside:?}");
    assert_eq!(grippers(&session), [0.04, 0.0]);
}

#[test]
fn a_left_arm_that_is_not_there_or_the_same_is_refused() {
    let refused = |left: &str| {
        let mapping = Mapping::from_toml(
            &format!("[arm]\nsites = ['hand_right']\nleft_sites = ['{left}']"),
            "two.toml",
        );
        session(&mapping.unwrap()).err().unwrap().to_string()
    };
    assert!(refused("paw").contains("none of the sites paw; name one by --left-site"), "{}", refused("paw"));
    assert!(refused("hand_right").contains("moves both arms"), "{}", refused("hand_right"));
    let wrong = Mapping::from_toml("[keyboard]\nd = 'left.+1'", "two.toml").unwrap_err().to_string();
    assert!(wrong.contains("left.+x"), "{wrong}");
}
