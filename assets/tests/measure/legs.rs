//! What robots on legs are tried with: standing in the key of their scene, loads, pushes, and joints that move while the robot hangs.

use super::{off, posed, run};
use mjcf::Loader;
use mjcf::files::Memory;
use physics::model::ObjType;
use physics::{Data, Model, forward};
use robohive_assets as assets;
use std::collections::BTreeSet;
use std::f64::consts::PI;

/// A robot, its root held 2 m above the ground: the text of the model without the free joint.
pub fn hung(robot: &str, options: &str) -> Model {
    let mut files = Memory::default();
    for path in assets::paths() {
        files.insert(&*path, assets::read(&path).unwrap());
    }
    let path = format!("{robot}/robot.xml");
    let free = assets::text(&path).unwrap();
    let held = free.replace("<freejoint name=\"root\"/>", "");
    assert_ne!(held, free, "{path} has a free root");
    files.insert(&*path, held.as_bytes());
    let scene = format!(
        "<mujoco><compiler autolimits='true'/><option {options}/><asset><model name='robot' file='{path}'/></asset>
           <worldbody><frame pos='0 0 2'><attach model='robot' prefix=''/></frame></worldbody></mujoco>"
    );
    files.insert("hung.xml", scene.as_bytes());
    Loader::default().files(files).load("hung.xml").unwrap().model
}

/// How a robot stood.
#[derive(Clone, Copy, Debug)]
pub struct Stood {
    /// Height of the root at the end, and the lowest on the way \[m\].
    pub height: [f64; 2],
    /// Cosine of the largest tilt of the root.
    pub upright: f64,
    /// The largest distance of a joint from its nominal angle at the end \[rad\].
    pub sag: f64,
    /// How far the root moved over the ground \[m\].
    pub moved: f64,
}

/// Starts in key 0 of a scene and stands under forces on the root's centre of mass, each for some time \[s, N\].
fn trial(m: &Model, root: &str, forces: &[(f64, [f64; 3])]) -> Stood {
    let root = m.body(root).unwrap();
    let mut d = Data::new(m);
    d.reset_to_key(m, 0).unwrap();
    let pose = d.state.qpos[7..].to_vec();
    let (mut lowest, mut upright) = (f64::INFINITY, f64::INFINITY);
    for (seconds, [x, y, z]) in forces {
        d.state.xfrc_applied[root.index()] = [*x, *y, *z, 0.0, 0.0, 0.0];
        run(m, &mut d, *seconds, |d| {
            lowest = lowest.min(d.body(root).xpos()[2]);
            upright = upright.min(d.body(root).xmat()[8]);
        });
    }
    let [x, y, height] = *d.body(root).xpos();
    let stood =
        Stood { height: [height, lowest], upright, sag: off(&pose, &d.state.qpos[7..]), moved: x.hypot(y) };
    println!("{forces:?}: {stood:.4?}");
    stood
}

/// Stands for some time \[s\] under a load \[N\].
pub fn stands(m: &Model, root: &str, seconds: f64, load: f64) -> Stood {
    trial(m, root, &[(seconds, [0.0, 0.0, -load])])
}

/// Stands for five seconds, in the second of which an impulse along x and y \[N s\] acts for 0.1 s.
pub fn pushed(m: &Model, root: &str, [x, y]: [f64; 2]) -> Stood {
    trial(m, root, &[(1.0, [0.0; 3]), (0.1, [10.0 * x, 10.0 * y, 0.0]), (3.9, [0.0; 3])])
}

/// Leads each servo of a hanging robot whose joint's name ends with `of` alone from one end of its range to the other in two seconds, the others
/// staying in `pose`. Returns the most that a joint stays short of an end, as a share of its range, and the pairs of bodies that touch each other on the way.
pub fn ranges(m: &Model, pose: &[f64], of: &str) -> (f64, BTreeSet<String>) {
    let (mut short, mut clashes) = (0.0f64, BTreeSet::new());
    let joint_of = |actuator: usize| m.actuator_trnid[actuator][0] as usize;
    let named = |actuator: &usize| m.name_of(ObjType::Joint, joint_of(*actuator)).ends_with(of);
    for actuator in (0..m.nu).filter(named) {
        let joint = joint_of(actuator);
        let [low, high] = m.jnt_range[joint];
        let at = m.jnt_qposadr[joint] as usize;
        let mut start = pose.to_vec();
        start[actuator] = low;
        let mut d = posed(m, &start);
        let mut miss = |d: &Data, end: f64| short = short.max((d.state.qpos[at] - end).abs() / (high - low));
        let mut touch = |d: &mut Data| {
            let share = ((d.time() - 0.5) / 2.0).clamp(0.0, 1.0);
            d.state.ctrl[actuator] = low + share * (high - low);
            for contact in d.con.contact.iter().filter(|contact| contact.dist < 0.0) {
                let body = |side: usize| m.geom_bodyid[contact.geom[side] as usize] as usize;
                let names = [0, 1].map(|side| m.name_of(ObjType::Body, body(side)));
                clashes.insert(format!(
                    "{} moves {} into {}",
                    m.name_of(ObjType::Joint, joint),
                    names[0],
                    names[1]
                ));
            }
        };
        run(m, &mut d, 0.5, &mut touch);
        miss(&d, low);
        run(m, &mut d, 2.7, &mut touch);
        miss(&d, high);
    }
    println!("short of an end by {short:.4} of the range; {clashes:?}");
    (short, clashes)
}

/// Moves each servo of a hanging robot alone by a sine of 0.5 Hz over half of its range, the others staying in `pose`. Returns the largest error
/// in the second period as a share of the amplitude, with the name of its joint.
pub fn sines(m: &Model, pose: &[f64]) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for actuator in 0..m.nu {
        let joint = m.actuator_trnid[actuator][0] as usize;
        let [low, high] = m.jnt_range[joint];
        let at = m.jnt_qposadr[joint] as usize;
        let (middle, amplitude) = ((low + high) / 2.0, (high - low) / 4.0);
        let mut start = pose.to_vec();
        start[actuator] = middle;
        let mut d = posed(m, &start);
        run(m, &mut d, 4.0, |d| {
            let goal = middle + amplitude * (PI * d.time()).sin();
            let error = (d.state.qpos[at] - goal).abs() / amplitude;
            if d.time() > 2.0 && error > worst.0 {
                worst = (error, m.name_of(ObjType::Joint, joint).to_string());
            }
            d.state.ctrl[actuator] = goal;
        });
    }
    println!("sine off by {:.3} of its amplitude ({})", worst.0, worst.1);
    worst
}

/// Distance between the origins of two bodies with all joints at 0 \[m\].
pub fn apart(m: &Model, from: &str, to: &str) -> f64 {
    let mut d = Data::new(m);
    d.state.qpos[..].fill(0.0);
    forward(m, &mut d).unwrap();
    let at = |name: &str| *d.body(m.body(name).unwrap()).xpos();
    physics::math::distance(at(from), at(to))
}

/// Mass of all bodies \[kg\].
pub fn mass(m: &Model) -> f64 {
    m.body_mass.iter().sum()
}
