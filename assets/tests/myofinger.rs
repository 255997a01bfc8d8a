//! The finger with five muscles: moment arms against published means, strength, range, and paths outside of bones.

mod measure;

use measure::muscles::{arms, arms_over_range, bone, excite, flexed, jump, stay_outside};
use physics::math::{dot, sub};
use physics::{Data, Model};

/// How much longer the finger is than an adult's: 270 mm over 81 mm (README.md). Its moment arms are larger by as much.
const SCALE: f64 = 3.3;
/// Joints in their order, and muscles.
const ADB: usize = 0;
const MCP: usize = 1;
const PIP: usize = 2;
const DIP: usize = 3;
const EXTN: usize = 0;
const ADAB_R: usize = 1;
const ADAB_L: usize = 2;
const MFLX: usize = 3;
const DFLX: usize = 4;

/// Means of moment arms of an index finger \[mm\], flexion positive: Ketchum and others, Journal of Hand Surgery 3(6), 1978, for flexors;
/// An and others, Journal of Biomechanics 16(6), 1983.
const PUBLISHED: [(usize, usize, f64); 12] = [
    (MCP, DFLX, 10.1),
    (MCP, DFLX, 11.1),
    (MCP, MFLX, 12.1),
    (MCP, MFLX, 11.9),
    (MCP, EXTN, -8.6),
    (PIP, DFLX, 9.8),
    (PIP, DFLX, 7.9),
    (PIP, MFLX, 8.3),
    (PIP, MFLX, 6.2),
    (DIP, DFLX, 6.5),
    (DIP, DFLX, 4.1),
    (DIP, EXTN, -2.2),
];

fn finger() -> Model {
    measure::own("myofinger/scene.xml")
}

/// All poses in which each joint is at a step of its range, ends included.
fn poses(m: &Model, steps: i32) -> Vec<Vec<f64>> {
    let at = |joint: usize, step: i32| {
        let [low, high] = m.jnt_range[joint];
        low + (high - low) * f64::from(step) / f64::from(steps)
    };
    let count = steps + 1;
    let digits = |number: i32| [0, 1, 2, 3].map(|joint| at(joint, number / count.pow(joint as u32) % count));
    (0..count.pow(4)).map(|number| digits(number).to_vec()).collect()
}

fn middle(m: &Model) -> Vec<f64> {
    m.jnt_range.iter().map(|[low, high]| (low + high) / 2.0).collect()
}

#[test]
fn moment_arms_are_near_the_published_means() {
    let m = finger();
    let middle = middle(&m);
    for (joint, muscle, published) in PUBLISHED {
        let off = 1000.0 * arms(&m, &middle, joint)[muscle] / SCALE / published - 1.0;
        assert!(off.abs() < 0.25, "muscle {muscle} at joint {joint}: {:.1} %", 100.0 * off);
    }
}

#[test]
fn moment_arms_do_not_jump() {
    let m = finger();
    for pose in poses(&m, 1) {
        for joint in ADB..=DIP {
            let jump = jump(&arms_over_range(&m, &pose, joint));
            assert!(jump < 0.5e-3, "joint {joint} at {pose:?}: {jump}");
        }
    }
}

#[test]
fn moment_arms_have_one_sign_in_all_poses() {
    let m = finger();
    for pose in poses(&m, 6) {
        let aside = arms(&m, &pose, ADB);
        assert!(aside[ADAB_R] < -5e-3 && aside[ADAB_L] > 5e-3, "{pose:?}: {aside:?}");
        for joint in [MCP, PIP, DIP] {
            let bend = arms(&m, &pose, joint);
            assert!(bend[EXTN] < -5e-3 && bend[DFLX] > 10e-3, "{joint} at {pose:?}: {bend:?}");
            assert!(joint == DIP || bend[MFLX] > 10e-3, "{joint} at {pose:?}: {bend:?}");
        }
    }
}

/// With these activations, moments at all three joints balance one force on the tip, which is that of an adult's finger, 40 to 60 N.
#[test]
fn the_tip_presses_as_hard_as_that_of_an_adult() {
    let m = finger();
    let d = flexed(&m, &[0.0, 0.5, 0.5, 0.3], &[0.0, 0.09, 0.09, 0.426, 1.0]);
    let tip = m.site("IFtip").unwrap();
    let distal = d.body(m.body("distal").unwrap()).xmat();
    let along = [distal[0], distal[3], distal[6]];
    let force = |joint: usize| {
        let lever = dot(sub(*d.site(tip).xpos(), d.kin.xanchor[joint]), along);
        d.actuation.qfrc_actuator[joint] / lever
    };
    let forces = [MCP, PIP, DIP].map(force);
    assert!(forces.iter().all(|force| (40.0..60.0).contains(force)), "{forces:?} N");
    assert!(forces.iter().all(|force| (force / forces[0] - 1.0).abs() < 0.02), "{forces:?} N");
}

/// Muscles, which only pull, hold the targets of the fixed tasks against gravity: pose and reach.
#[test]
fn muscles_can_hold_the_poses_of_tasks() {
    let m = finger();
    for (pose, act) in [
        ([0.0, 0.0, 0.75, 0.75], [0.186, 0.013, 0.013, 0.0, 0.028]),
        ([0.245, -0.15, 0.646, 0.794], [0.218, 0.082, 0.003, 0.0, 0.029]),
    ] {
        let d = flexed(&m, &pose, &act);
        let short: Vec<f64> =
            d.actuation.qfrc_actuator.iter().zip(&d.vel.qfrc_bias).map(|(a, b)| a - b).collect();
        assert!(short.iter().all(|moment| moment.abs() < 0.01), "{pose:?}: {short:?} N m");
    }
}

/// Each muscle moves its joints to the end of their range, and the finger comes to rest under all of them.
#[test]
fn muscles_move_the_finger_through_its_range() {
    let m = finger();
    let mut d = Data::new(&m);
    let near = |d: &Data, goal: [f64; 4]| goal.iter().zip(&d.state.qpos).all(|(a, b)| (a - b).abs() < 0.05);
    let [low, high] = [0, 1].map(|end| [0, 1, 2, 3].map(|joint| m.jnt_range[joint][end]));
    excite(&m, &mut d, &[0.0, 0.0, 0.0, 1.0, 1.0], 2.0);
    assert!(near(&d, [0.0, high[1], high[2], high[3]]), "flexed: {:?}", d.state.qpos);
    excite(&m, &mut d, &[1.0, 0.0, 0.0, 0.0, 0.0], 2.0);
    assert!(near(&d, [0.0, low[1], 0.0, 0.0]), "extended: {:?}", d.state.qpos);
    for (muscle, side) in [(ADAB_R, low[0]), (ADAB_L, high[0])] {
        let mut excited = [0.3, 0.0, 0.0, 0.0, 0.0];
        excited[muscle] = 1.0;
        excite(&m, &mut d, &excited, 2.0);
        assert!((d.state.qpos[0] - side).abs() < 0.05, "muscle {muscle}: {:?}", d.state.qpos);
    }
    excite(&m, &mut d, &[0.2; 5], 10.0);
    assert!(d.state.qvel.iter().all(|speed| speed.abs() < 1e-3), "{:?}", d.state.qvel);
}

#[test]
fn muscles_go_round_bones() {
    let m = finger();
    let bones = ["hand", "proximal", "middle", "distal"].map(|name| bone(&m, "myofinger", name, name));
    let mut poses = poses(&m, 1);
    poses.push(middle(&m));
    let looked = stay_outside(&m, &bones, 0.02, &poses);
    assert!(looked > 30_000, "{looked}");
}
