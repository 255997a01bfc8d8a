//! What the Adroit hand weighs, reaches, holds and follows, at the stiffness that its tasks set.

use mjcf::Loader;
use mjcf::files::{FileError, FileProvider};
use physics::{Data, Model, forward, step};
use robohive_assets::Own;
use std::f64::consts::TAU;
use std::sync::Arc;

/// The hand without a floor, upright, with a bar before the palm whose axis is that of the knuckles.
const GRIP: &str = r#"
<mujoco>
  <compiler autolimits="true"/>
  <option iterations="20" noslip_iterations="20"/>
  <asset><model name="adroit" file="adroit/robot.xml"/></asset>
  <worldbody>
    <attach model="adroit" body="forearm" prefix=""/>
    <body name="bar" pos="0 -0.032 0.515">
      <freejoint/>
      <geom type="cylinder" size="0.02" fromto="-0.07 0 0 0.07 0 0" mass="0.3" condim="4"/>
    </body>
  </worldbody>
</mujoco>"#;

/// Our own files, and the scene with the bar.
struct WithBar;

impl FileProvider for WithBar {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        if path == "grip.xml" { Ok(GRIP.as_bytes().into()) } else { Own.read(path) }
    }

    fn exists(&self, path: &str) -> bool {
        path == "grip.xml" || Own.exists(path)
    }
}

fn load(path: &str) -> Model {
    Loader::default().files(WithBar).load(path).expect("own models load").model
}

fn run(m: &Model, d: &mut Data, seconds: f64) {
    let steps = (seconds / m.opt.timestep).round() as usize;
    (0..steps).for_each(|_| step(m, d).expect("the hand moves on"));
}

/// What the commands of the servos are named after: the joint, for the four like fingers without the finger.
fn kind(name: &str) -> &str {
    let joint = name.trim_start_matches("A_");
    ["FF", "MF", "RF", "LF"].iter().find_map(|finger| joint.strip_prefix(finger)).unwrap_or(joint)
}

/// The servos in groups that move together: each alone, but the coupled ends of a finger, and the spreads of all fingers, which would
/// run into each other.
fn groups(m: &Model) -> Vec<Vec<usize>> {
    let mut found: Vec<(String, Vec<usize>)> = Vec::new();
    for (actuator, name) in m.actuator_names() {
        let group = match kind(name) {
            "J3" => "spread".into(),
            "J0" | "J1" if name.len() == 6 && !name.contains("WR") => format!("{} ends", &name[2..4]),
            _ => name.to_owned(),
        };
        match found.iter_mut().find(|(known, _)| *known == group) {
            Some((_, members)) => members.push(actuator.index()),
            None => found.push((group, vec![actuator.index()])),
        }
    }
    found.into_iter().map(|(_, members)| members).collect()
}

fn name_of(m: &Model, actuator: usize) -> String {
    m.actuator_names()
        .find(|(id, _)| id.index() == actuator)
        .map(|(_, name)| name.to_owned())
        .unwrap_or_default()
}

/// The joint of a servo: its place among the positions, and its range.
fn joint(m: &Model, actuator: usize) -> (usize, [f64; 2]) {
    let joint = m.actuator_trnid[actuator][0] as usize;
    (m.jnt_qposadr[joint] as usize, m.jnt_range[joint])
}

#[test]
fn weight_and_reach_are_those_of_the_source() {
    let m = load("adroit/robot.xml");
    let mass = |body: &str| m.body_subtreemass[m.body(body).unwrap().index()];
    assert!((mass("wrist") - 0.911).abs() < 1e-9 && (mass("forearm") - 4.911).abs() < 1e-9);
    let mut d = Data::new(&m);
    forward(&m, &mut d).unwrap();
    let tip = d.site(m.site("S_mftip").unwrap()).xpos()[2];
    let wrist = d.body(m.body("wrist").unwrap()).xpos()[2];
    // 34 + 99 + 45 + 25 mm to the last joint; the capsule ends 24 mm and its radius behind it, the site 26 mm.
    assert!((tip - wrist - 0.229).abs() < 1e-9, "{}", tip - wrist);
}

#[test]
fn an_open_hand_stays_open() {
    let m = load("adroit/scene.xml");
    let mut d = Data::new(&m);
    let mut farthest: f64 = 0.0;
    for _ in 0..100 {
        run(&m, &mut d, 0.1);
        farthest = d.state.qpos.iter().fold(farthest, |most, angle| most.max(angle.abs()));
    }
    println!("farthest from open: {farthest:.4} rad");
    assert!(farthest < 0.011, "{farthest}");
}

#[test]
fn joints_reach_the_ends_of_their_ranges() {
    let m = load("adroit/robot.xml");
    for group in groups(&m) {
        let mut d = Data::new(&m);
        for end in [0, 1] {
            for &actuator in &group {
                d.state.ctrl[actuator] = m.actuator_ctrlrange[actuator][end];
            }
            run(&m, &mut d, 3.0);
            for &actuator in &group {
                let (at, range) = joint(&m, actuator);
                let missing = (d.state.qpos[at] - range[end]).abs();
                let name = name_of(&m, actuator);
                println!("{name} end {end}: {missing:.4} rad missing");
                let allowed = match kind(&name) {
                    // The coupling ends these early: 7.05 mm / 8.05 mm of the last joint's range, and 1 mm of play.
                    "J1" => 1.571 * (1.0 - 7.05 / 8.05) - 0.001 / 0.00805,
                    // Fingers side by side, 22 mm apart and one 4 mm higher, lean by 0.27 rad until their capsules touch.
                    "J3" => 0.436 - 0.27,
                    // The servo's own range ends at 1 rad.
                    "THJ4" => 1.047 - 1.0,
                    _ => 0.0,
                };
                // Limits give way from a margin of 0.01 rad before them.
                assert!(missing < allowed + 0.011, "{name}: {missing}");
            }
        }
    }
}

#[test]
fn servos_follow_a_sine() {
    let m = load("adroit/robot.xml");
    let mut worst = (0.0, String::new());
    for group in groups(&m) {
        let mut d = Data::new(&m);
        let period = (2.0 / m.opt.timestep).round() as usize;
        for now in 0..2 * period {
            let phase = TAU * now as f64 / period as f64;
            let target = |actuator: usize| {
                let (at, [low, high]) = joint(&m, actuator);
                let amplitude = 0.25 * (high - low);
                (at, amplitude, 0.5 * (low + high) + amplitude * phase.sin())
            };
            group.iter().for_each(|&actuator| d.state.ctrl[actuator] = target(actuator).2);
            step(&m, &mut d).unwrap();
            for &actuator in group.iter().filter(|_| now >= period) {
                let (at, amplitude, wanted) = target(actuator);
                let error = (d.state.qpos[at] - wanted).abs() / amplitude;
                if error > worst.0 {
                    worst = (error, name_of(&m, actuator));
                }
            }
        }
    }
    println!("greatest error: {:.3} of the amplitude, {}", worst.0, worst.1);
    assert!(worst.0 < 0.25, "{worst:?}");
}

#[test]
fn friction_holds_a_bar_of_300_grams() {
    for pull in [-9.81, 9.81] {
        let mut m = load("grip.xml");
        m.edit(|m| m.opt.gravity = [0.0; 3]).unwrap();
        let mut d = Data::new(&m);
        let closed = [
            ("J2", 1.3),
            ("J1", 1.4),
            ("J0", 1.4),
            ("THJ4", 0.9),
            ("THJ3", 0.9),
            ("THJ1", 0.3),
            ("THJ0", -1.0),
        ];
        let servos: Vec<_> =
            m.actuator_names().map(|(actuator, name)| (actuator.index(), name.to_owned())).collect();
        for part in 1..=100 {
            for (actuator, name) in &servos {
                let command =
                    closed.iter().find(|(joint, _)| *joint == kind(name)).map_or(0.0, |(_, angle)| *angle);
                d.state.ctrl[*actuator] = command * f64::from(part) / 100.0;
            }
            run(&m, &mut d, 0.01);
        }
        let bar = m.body("bar").unwrap();
        let along = |d: &Data| d.body(bar).xpos()[0];
        let grasped = along(&d);
        m.edit(|m| m.opt.gravity = [pull, 0.0, 0.0]).unwrap();
        run(&m, &mut d, 0.5);
        let hanging = along(&d);
        run(&m, &mut d, 5.0);
        println!("gives {:.4} m, then {:.5} m in 5 s", hanging - grasped, along(&d) - hanging);
        assert!((hanging - grasped).abs() < 0.015 && (along(&d) - hanging).abs() < 0.001);
    }
}
