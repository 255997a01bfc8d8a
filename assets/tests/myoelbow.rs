//! The arm with six muscles: moment arms against published curves, strength, range, and paths outside of bones.

mod measure;

use measure::muscles::{arms, arms_over_range, bone, excite, flexed, jump, stay_outside};
use physics::{Data, Model};
use std::f64::consts::PI;

/// Moment arms \[cm\] as polynomials of the angle \[rad\], flexion positive, after Pigeon, Yahia and Feldman, Journal of Biomechanics 29(10),
/// 1996.
const PUBLISHED: [(&str, [f64; 6]); 6] = [
    ("BIClong", BICEPS),
    ("BICshort", BICEPS),
    ("BRA", [1.554, 0.0813, -1.689, 3.523, -1.811, 0.276]),
    ("TRIlong", TRICEPS),
    ("TRIlat", TRICEPS),
    ("TRImed", TRICEPS),
];
const BICEPS: [f64; 6] = [1.963, -1.44, 3.031, 0.887, -1.418, 0.285];
const TRICEPS: [f64; 6] = [-2.365, -1.015, 1.92, -1.035, 0.257, -0.0262];
/// The largest angle of the elbow \[rad\].
const BENT: f64 = 130.0 * PI / 180.0;

fn arm() -> Model {
    measure::own("myoelbow/scene.xml")
}

#[test]
fn moment_arms_are_those_published() {
    let m = arm();
    for (name, curve) in PUBLISHED {
        let muscle = m.actuator(name).unwrap().index();
        for tenth in 0..=10 {
            let angle = BENT * f64::from(tenth) / 10.0;
            let published = curve.iter().rev().fold(0.0, |sum, factor| sum * angle + factor) / 100.0;
            let off = arms(&m, &[angle], 0)[muscle] / published - 1.0;
            assert!(off.abs() < 0.06, "{name} at {angle:.2} rad: {:.1} %", 100.0 * off);
        }
    }
}

#[test]
fn moment_arms_neither_jump_nor_change_sign() {
    let m = arm();
    let rows = arms_over_range(&m, &[0.0], 0);
    assert!((m.jnt_range[0][1] - BENT).abs() < 1e-5 && jump(&rows) < 0.5e-3, "{}", jump(&rows));
    for row in rows {
        assert!(row[..3].iter().all(|arm| *arm < 0.0), "extensors extend: {row:?}");
        assert!(row[3..].iter().all(|arm| *arm > 0.0), "flexors bend: {row:?}");
    }
}

/// Elbow flexors of an adult hold 60 to 80 N m at their best angle, extensors 40 to 50.
#[test]
fn muscles_are_as_strong_as_those_of_an_adult() {
    let m = arm();
    let best = |act: [f64; 6]| {
        let torque =
            |step: i32| flexed(&m, &[BENT * f64::from(step) / 20.0], &act).actuation.qfrc_actuator[0].abs();
        (0..=20).map(torque).fold(0.0, f64::max)
    };
    let (bend, stretch) = (best([0.0, 0.0, 0.0, 1.0, 1.0, 1.0]), best([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]));
    assert!((60.0..80.0).contains(&bend), "flexors: {bend:.1} N m");
    assert!((40.0..50.0).contains(&stretch), "extensors: {stretch:.1} N m");
}

#[test]
fn the_arm_bends_to_the_end_stretches_again_and_rests() {
    let m = arm();
    let mut d = Data::new(&m);
    excite(&m, &mut d, &[0.0, 0.0, 0.0, 0.6, 0.6, 0.6], 2.0);
    assert!(d.state.qpos[0] > 0.9 * BENT, "{}", d.state.qpos[0]);
    excite(&m, &mut d, &[0.5, 0.5, 0.5, 0.0, 0.0, 0.0], 2.0);
    assert!(d.state.qpos[0].abs() < 0.1, "{}", d.state.qpos[0]);
    excite(&m, &mut d, &[0.3; 6], 10.0);
    assert!(d.state.qvel[0].abs() < 1e-3, "{}", d.state.qvel[0]);
}

#[test]
fn muscles_go_round_bones() {
    let m = arm();
    let places = [("humerus", "r_humerus"), ("ulna", "r_ulna_radius_hand"), ("radius", "r_ulna_radius_hand")];
    let bones = places.map(|(name, body)| bone(&m, "myoelbow", name, body));
    let poses = [0.0, 0.5, 1.0, 1.5, 2.0, BENT].map(|angle| vec![angle]);
    let looked = stay_outside(&m, &bones, 0.02, &poses);
    assert!(looked > 3000, "{looked}");
}
