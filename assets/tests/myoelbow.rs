//! The arm with six muscles: moment arms against published curves, strength, range, and paths outside of bones.

use mjcf::Loader;
use physics::math::{add_scaled, cross, dot, mul_mat_t_vec, sub};
use physics::{Data, Model, forward, step};
use std::f64::consts::PI;
use workshop::Mesh;

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
    Loader::default().files(robohive_assets::Own).load("myoelbow/scene.xml").unwrap().model
}

/// The arm at rest at an angle, its muscles with these activations.
fn posed(m: &Model, angle: f64, act: [f64; 6]) -> Data {
    let mut d = Data::new(m);
    d.state.qpos[0] = angle;
    d.state.act.copy_from_slice(&act);
    forward(m, &mut d).unwrap();
    d
}

/// The tendon that a muscle pulls.
fn tendon(m: &Model, muscle: usize) -> usize {
    m.actuator_trnid[muscle][0] as usize
}

/// Moment arms of all muscles at an angle \[m\].
fn arms(m: &Model, angle: f64) -> Vec<f64> {
    let d = posed(m, angle, [0.0; 6]);
    (0..6).map(|muscle| -d.ten.ten_J[tendon(m, muscle)]).collect()
}

#[test]
fn moment_arms_are_those_published() {
    let m = arm();
    for (name, curve) in PUBLISHED {
        let muscle = m.actuator(name).unwrap().index();
        for tenth in 0..=10 {
            let angle = BENT * f64::from(tenth) / 10.0;
            let published = curve.iter().rev().fold(0.0, |sum, factor| sum * angle + factor) / 100.0;
            let off = arms(&m, angle)[muscle] / published - 1.0;
            assert!(off.abs() < 0.06, "{name} at {angle:.2} rad: {:.1} %", 100.0 * off);
        }
    }
}

#[test]
fn moment_arms_neither_jump_nor_change_sign() {
    let m = arm();
    let mut before = arms(&m, 0.0);
    for step in 1..=180 {
        let here = arms(&m, BENT * f64::from(step) / 180.0);
        for (muscle, (a, b)) in before.iter().zip(&here).enumerate() {
            assert!((a - b).abs() < 0.5e-3 && a * b > 0.0, "muscle {muscle} at step {step}: {a} and {b}");
        }
        before = here;
    }
    assert!(before[0] < 0.0 && before[3] > 0.0, "extensors extend, flexors bend");
}

/// Elbow flexors of an adult hold 60 to 80 N m at their best angle, extensors 40 to 50.
#[test]
fn muscles_are_as_strong_as_those_of_an_adult() {
    let m = arm();
    let best = |act: [f64; 6]| {
        let torque =
            |step: i32| posed(&m, BENT * f64::from(step) / 20.0, act).actuation.qfrc_actuator[0].abs();
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
    let mut drive = |excited: [f64; 6], seconds: f64| {
        d.state.ctrl.copy_from_slice(&excited);
        (0..(seconds / m.opt.timestep) as usize).for_each(|_| step(&m, &mut d).unwrap());
        d.state.qpos[0]
    };
    let bent = drive([0.0, 0.0, 0.0, 0.6, 0.6, 0.6], 2.0);
    assert!(bent > 0.9 * BENT, "{bent}");
    let straight = drive([0.5, 0.5, 0.5, 0.0, 0.0, 0.0], 2.0);
    assert!(straight.abs() < 0.1, "{straight}");
    drive([0.3; 6], 10.0);
    assert!(d.state.qvel[0].abs() < 1e-3, "{}", d.state.qvel[0]);
}

/// How often a surface goes round a point: 0 outside, 1 inside (van Oosterom and Strackee, IEEE Transactions on Biomedical
/// Engineering 30(2), 1983, for the solid angle of a triangle).
fn winding(mesh: &Mesh, point: [f64; 3]) -> f64 {
    let corners = mesh.faces().iter().map(|face| face.map(|vertex| sub(mesh.vertices()[vertex], point)));
    let solid = corners.map(|[a, b, c]| {
        let [la, lb, lc] = [a, b, c].map(|v| dot(v, v).sqrt());
        let volume = dot(a, cross(b, c));
        2.0 * volume.atan2(la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb)
    });
    solid.sum::<f64>() / (4.0 * PI)
}

/// Muscles are drawn as lines. Near where they are fixed to a bone they may be below its surface.
#[test]
fn muscles_go_round_bones() {
    const NEAR: f64 = 0.02;
    let m = arm();
    let bones = ["humerus", "ulna", "radius"].map(|name| {
        let body = if name == "humerus" { "r_humerus" } else { "r_ulna_radius_hand" };
        (name, m.body(body).unwrap(), robohive_assets::mesh(&format!("myoelbow/{name}.obj")).unwrap())
    });
    let mut looked = 0;
    for angle in [0.0, 0.5, 1.0, 1.5, 2.0, BENT] {
        let d = posed(&m, angle, [0.0; 6]);
        let points = d.ten.wrap_xpos.as_flattened().as_chunks::<3>().0;
        for muscle in 0..6 {
            let tendon = tendon(&m, muscle);
            let start = d.ten.ten_wrapadr[tendon] as usize;
            let path = &points[start..start + d.ten.ten_wrapnum[tendon] as usize];
            let ends = [path[0], path[path.len() - 1]];
            // A stretch round a cylinder is shown by its two ends alone; the cylinders are thicker than the bones in them.
            let round = &d.ten.wrap_obj.as_flattened()[start..];
            let straight = path.windows(2).enumerate().filter(|(i, _)| round[*i] < 0 || round[i + 1] < 0);
            for (_, pair) in straight {
                for step in 0..20 {
                    let point = add_scaled(pair[0], sub(pair[1], pair[0]), f64::from(step) / 20.0);
                    if ends.iter().any(|end| dot(sub(point, *end), sub(point, *end)) < NEAR * NEAR) {
                        continue;
                    }
                    for (name, body, mesh) in &bones {
                        let local = mul_mat_t_vec(d.body(*body).xmat(), sub(point, *d.body(*body).xpos()));
                        looked += 1;
                        assert!(
                            winding(mesh, local) < 0.5,
                            "muscle {muscle} in the {name} at {angle} rad: {local:?}"
                        );
                    }
                }
            }
        }
    }
    assert!(looked > 3000, "{looked}");
}
