//! What robots are tried with: stands that hold them, and servos that are moved one by one.
#![allow(dead_code, reason = "each test of a robot uses a part")]

pub mod balance;
pub mod coupled;
pub mod grips;
pub mod legs;
pub mod muscles;

use mjcf::Loader;
use mjcf::files::Memory;
use physics::model::TrnType;
use physics::{Data, Model, step};
use robohive_assets as assets;
use std::f64::consts::PI;

/// One of our own models.
pub fn own(path: &str) -> Model {
    Loader::default().files(assets::Own).load(path).unwrap().model
}

/// A model whose text names files of our own.
pub fn scene(text: &str) -> Model {
    let mut files = Memory::default();
    for path in assets::paths() {
        files.insert(&*path, assets::read(&path).unwrap());
    }
    files.insert("test.xml", text.as_bytes());
    Loader::default().files(files).load("test.xml").unwrap().model
}

/// A body of a robot fixed 1 m above the ground, with other options and bodies beside it.
pub fn stand(robot: &str, body: &str, options: &str, beside: &str) -> Model {
    scene(&format!(
        "<mujoco><compiler autolimits='true'/><option {options}/>
           <asset><model name='robot' file='{robot}'/></asset>
           <worldbody><frame pos='0 0 1'><attach model='robot' body='{body}' prefix=''/></frame>{beside}</worldbody>
         </mujoco>"
    ))
}

/// The joints that an actuator moves: one, or those whose angles its tendon adds up.
fn joints(m: &Model, actuator: usize) -> Vec<usize> {
    let moved = m.actuator_trnid[actuator][0] as usize;
    if TrnType::from_code(m.actuator_trntype[actuator]) != Some(TrnType::Tendon) {
        return vec![moved];
    }
    let start = m.tendon_adr[moved] as usize;
    m.wrap_objid[start..start + m.tendon_num[moved] as usize].iter().map(|joint| *joint as usize).collect()
}

/// Where those joints stand in `qpos`.
fn places(m: &Model, actuator: usize) -> Vec<usize> {
    joints(m, actuator).into_iter().map(|joint| m.jnt_qposadr[joint] as usize).collect()
}

/// The angle or the place that an actuator controls.
fn angle(m: &Model, d: &Data, actuator: usize) -> f64 {
    places(m, actuator).into_iter().map(|place| d.state.qpos[place]).sum()
}

/// Steps for some time \[s\], and tells `seen` of every state.
pub fn run(m: &Model, d: &mut Data, seconds: f64, mut seen: impl FnMut(&mut Data)) {
    for _ in 0..(seconds / m.opt.timestep).round() as usize {
        step(m, d).unwrap();
        seen(d);
    }
}

/// Starts where the servos are told to stay, a tendon's joints alike.
pub fn posed(m: &Model, pose: &[f64]) -> Data {
    let mut d = Data::new(m);
    for (actuator, angle) in pose.iter().enumerate() {
        let places = places(m, actuator);
        for place in &places {
            d.state.qpos[*place] = *angle / places.len() as f64;
        }
        d.state.ctrl[actuator] = *angle;
    }
    d
}

/// The largest distance of joints from where their servos are told to be \[rad or m\].
pub fn off(told: &[f64], found: &[f64]) -> f64 {
    told.iter().zip(found).map(|(told, angle)| (told - angle).abs()).fold(0.0, f64::max)
}

/// How far the joints of a model are from the pose in which its servos held it for ten seconds; `first` is the place in `qpos` of the
/// first joint with a servo.
pub fn drift(path: &str, pose: &[f64], first: usize) -> f64 {
    let m = own(path);
    let mut d = posed(&m, pose);
    run(&m, &mut d, 10.0, |_| ());
    let off = off(pose, &d.state.qpos[first..]);
    println!("off by {off:.5} after 10 s");
    off
}

/// What [`sweep`] and [`track`] find of a model, printed.
pub fn mobility(m: &Model, pose: &[f64]) -> (f64, f64) {
    let (short, actuator) = sweep(m, pose);
    let (off, slowest) = track(m, pose);
    println!(
        "short {short:.4} (actuator {actuator}), sine off by {off:.3} of its amplitude (actuator {slowest})"
    );
    (short, off)
}

/// How far a free body, the last in `qpos`, slips in ten seconds, after a hand has closed on it for `closing` seconds while it was held
/// upright at `height` \[m\].
pub fn slip(m: &Model, d: &mut Data, height: f64, closing: f64) -> f64 {
    let (pose, velocity) = (m.nq - 7, m.nv - 6);
    run(m, d, closing, |d| {
        d.state.qpos[pose..].copy_from_slice(&[0.0, 0.0, height, 1.0, 0.0, 0.0, 0.0]);
        d.state.qvel[velocity..].fill(0.0);
    });
    run(m, d, 10.0, |_| ());
    let slip = (height - d.state.qpos[pose + 2]).abs();
    println!("slipped by {:.1} mm in 10 s", slip * 1e3);
    slip
}

/// Steps until nothing moves by more than 1e-5 rad/s or m/s, for 8 s at most.
fn settle(m: &Model, d: &mut Data) {
    for _ in 0..16 {
        run(m, d, 0.5, |_| ());
        if d.state.qvel.iter().all(|speed| speed.abs() < 1e-5) {
            return;
        }
    }
}

/// Sends each servo of `pose` alone to one end of its joint and to the other, at most 8 s each, the others staying in `pose`, and returns the most that
/// a joint stays short of what it was told, as a share of its range, with the actuator's number.
pub fn sweep(m: &Model, pose: &[f64]) -> (f64, usize) {
    let mut worst = (0.0, 0);
    for actuator in 0..pose.len() {
        let ends = joints(m, actuator).into_iter().map(|joint| m.jnt_range[joint]);
        let [low, high] = ends.fold([0.0; 2], |[low, high], [from, to]| [low + from, high + to]);
        let [least, most] = m.actuator_ctrlrange[actuator];
        let (low, high) = (low.max(least), high.min(most));
        let mut d = posed(m, pose);
        for goal in [low, high] {
            d.state.ctrl[actuator] = goal;
            settle(m, &mut d);
            let short = (angle(m, &d, actuator) - goal).abs() / (high - low);
            if short > worst.0 {
                worst = (short, actuator);
            }
        }
    }
    worst
}

/// Moves each servo of `pose` alone by a sine of 0.5 Hz over half of its range, the others staying in `pose`, and returns the largest error in
/// the second period, as a share of the amplitude, with the actuator's number.
pub fn track(m: &Model, pose: &[f64]) -> (f64, usize) {
    let mut worst = (0.0, 0);
    for actuator in 0..pose.len() {
        let [low, high] = m.actuator_ctrlrange[actuator];
        let (middle, amplitude) = ((low + high) / 2.0, (high - low) / 4.0);
        let mut start = pose.to_vec();
        start[actuator] = middle;
        let mut d = posed(m, &start);
        run(m, &mut d, 4.0, |d| {
            let goal = middle + amplitude * (PI * d.time()).sin();
            let off = (angle(m, d, actuator) - goal).abs() / amplitude;
            if d.time() > 2.0 && off > worst.0 {
                worst = (off, actuator);
            }
            d.state.ctrl[actuator] = goal;
        });
    }
    worst
}
