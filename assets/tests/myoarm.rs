//! The arm with 63 muscles: moment arms at elbow and shoulder, strength, mass, and paths outside of bones.

mod measure;

use measure::muscles::{arms_along, arms_over_range, bone, excite, flexed, jump, some_stay_outside};
use physics::{Data, Model};
use std::f64::consts::PI;

/// The muscles of shoulder and elbow, before those of the hand.
const UPPER: usize = 24;

/// Angles of the coordinates \[deg\]: plane of elevation (0 to the side, 90 forward), elevation, rotation (inwards positive), elbow,
/// pronation.
type Angles = [f64; 5];

/// Moment arms at the elbow \[cm\] as polynomials of the angle \[rad\], flexion positive, after Pigeon, Yahia and Feldman, Journal of
/// Biomechanics 29(10), 1996.
const PUBLISHED: [(&str, [f64; 6]); 7] = [
    ("BIClong", BICEPS),
    ("BICshort", BICEPS),
    ("BRA", [1.554, 0.0813, -1.689, 3.523, -1.811, 0.276]),
    ("BRD", [2.015, -0.458, 3.058, -1.081, 0.159, -0.0187]),
    ("TRIlong", TRICEPS),
    ("TRIlat", TRICEPS),
    ("TRImed", TRICEPS),
];
const BICEPS: [f64; 6] = [1.963, -1.44, 3.031, 0.887, -1.418, 0.285];
const TRICEPS: [f64; 6] = [-2.365, -1.015, 1.92, -1.035, 0.257, -0.0262];
/// The largest angle of the elbow \[deg\].
const BENT: f64 = 130.0;

fn arm() -> Model {
    measure::own("myoarm/scene.xml")
}

/// How fast each joint turns when a coordinate does.
fn motion(m: &Model, coordinate: usize) -> Vec<f64> {
    let names = ["elv_angle", "shoulder_elv", "shoulder_rot", "elbow_flexion", "pro_sup"];
    motion_of(m, m.joint(names[coordinate]).unwrap().index())
}

/// How fast each joint turns when one does, which others follow as the model's equalities say.
fn motion_of(m: &Model, joint: usize) -> Vec<f64> {
    let mut motion = vec![0.0; m.nv];
    motion[joint] = 1.0;
    for equality in (0..m.neq).filter(|i| m.eq_obj2id[*i] as usize == joint) {
        motion[m.eq_obj1id[equality] as usize] = m.eq_data[equality][1];
    }
    motion
}

/// The pose with these angles, all joints of the hand at 0.
fn pose(m: &Model, angles: Angles) -> Vec<f64> {
    let mut pose = vec![0.0; m.nq];
    for (coordinate, angle) in angles.iter().enumerate() {
        for (place, speed) in pose.iter_mut().zip(motion(m, coordinate)) {
            *place += speed * angle.to_radians();
        }
    }
    pose
}

/// Moment arms of all muscles about a coordinate \[mm\].
fn about(m: &Model, coordinate: usize, angles: Angles) -> Vec<f64> {
    let arms = arms_along(m, &flexed(m, &pose(m, angles), &vec![0.0; m.na]), &motion(m, coordinate));
    arms.iter().map(|arm| 1e3 * arm).collect()
}

fn of(m: &Model, name: &str) -> usize {
    m.actuator(name).unwrap().index()
}

#[test]
fn moment_arms_at_the_elbow_are_those_published() {
    let m = arm();
    for (name, curve) in PUBLISHED {
        let mut worst = 0.0_f64;
        for tenth in 0..=10 {
            let angle = BENT.to_radians() * f64::from(tenth) / 10.0;
            let published = 10.0 * curve.iter().rev().fold(0.0, |sum, factor| sum * angle + factor);
            let off = about(&m, 3, [0.0, 0.0, 0.0, angle.to_degrees(), 0.0])[of(&m, name)] / published - 1.0;
            worst = if off.abs() > worst.abs() { off } else { worst };
        }
        println!("{name}: {:.1} %", 100.0 * worst);
        assert!(worst.abs() < 0.15, "{name}: {:.1} %", 100.0 * worst);
    }
}

/// Where the brachioradialis pulls best, and how well; Murray, Buchanan and Delp (Journal of Biomechanics 33(8), 2000) found 77 mm on average.
#[test]
fn the_brachioradialis_pulls_best_when_the_elbow_is_well_bent() {
    let m = arm();
    let at = |angle: u32| about(&m, 3, [0.0, 0.0, 0.0, f64::from(angle), 0.0])[of(&m, "BRD")];
    let best = (0..=130).max_by(|a, b| at(*a).total_cmp(&at(*b))).unwrap();
    println!("brachioradialis: {:.1} mm at {best} degrees", at(best));
    assert!((100..130).contains(&best) && (58.0..90.0).contains(&at(best)));
}

#[test]
fn moment_arms_of_elbow_and_forearm_neither_jump_nor_change_sign() {
    let m = arm();
    let [elbow, forearm] = ["elbow_flexion", "pro_sup"].map(|name| m.joint(name).unwrap().index());
    let flexors = ["BIClong", "BICshort", "BRA", "BRD"].map(|name| of(&m, name));
    let extensors = ["TRIlong", "TRIlat", "TRImed", "ANC"].map(|name| of(&m, name));
    let supinators = ["SUP", "BIClong", "BICshort"].map(|name| of(&m, name));
    for turn in [0.0, -60.0, 60.0] {
        let rows = arms_over_range(&m, &pose(&m, [0.0, 0.0, 0.0, 0.0, turn]), elbow);
        let rows: Vec<Vec<f64>> = rows.into_iter().map(|row| row[..UPPER].to_vec()).collect();
        println!("elbow, turned by {turn}: jump {:.2} mm", 1e3 * jump(&rows));
        assert!(jump(&rows) < 0.5e-3, "{turn}: {}", jump(&rows));
        for row in rows {
            assert!(flexors.iter().all(|i| row[*i] > 0.0), "flexors bend: {row:?}");
            assert!(extensors.iter().all(|i| row[*i] < 0.0), "extensors extend: {row:?}");
        }
    }
    for bend in [0.0, 90.0] {
        let rows = arms_over_range(&m, &pose(&m, [0.0, 0.0, 0.0, bend, 0.0]), forearm);
        let rows: Vec<Vec<f64>> = rows.into_iter().map(|row| row[..UPPER].to_vec()).collect();
        println!("forearm, bent by {bend}: jump {:.2} mm", 1e3 * jump(&rows));
        assert!(jump(&rows) < 0.5e-3, "{bend}: {}", jump(&rows));
        for row in rows {
            assert!(supinators.iter().all(|i| row[*i] < 0.0), "supinators turn outwards: {row:?}");
        }
    }
}

/// A muscle, a coordinate, the sign of the moment arm about it, and the planes of elevation and elevations at which it holds.
type Statement = (&'static str, usize, f64, &'static [f64], &'static [f64]);

/// What anatomy says of each muscle of the shoulder.
const ANATOMY: &[Statement] = &[
    // Front: lifts forward, and swings forward.
    ("DELT1", 1, 1.0, &[90.0], &[10.0, 40.0, 70.0, 100.0]),
    ("DELT1", 0, 1.0, &[0.0, 45.0, 90.0], &[40.0, 70.0, 100.0]),
    // Side: lifts.
    ("DELT2", 1, 1.0, &[0.0, 45.0, 90.0], &[10.0, 40.0, 70.0, 100.0, 130.0]),
    ("SUPSP", 1, 1.0, &[0.0, 45.0], &[10.0, 40.0, 70.0, 100.0]),
    // Back: swings backward.
    ("DELT3", 0, -1.0, &[0.0, 45.0, 90.0], &[40.0, 70.0, 100.0]),
    ("DELT3", 1, -1.0, &[90.0], &[10.0, 40.0]),
    // Turn outwards.
    ("INFSP", 2, -1.0, &[0.0, 45.0, 90.0], &[0.0, 40.0, 70.0, 100.0]),
    ("TMIN", 2, -1.0, &[0.0, 45.0, 90.0], &[0.0, 40.0, 70.0, 100.0]),
    // Turns inwards.
    ("SUBSC", 2, 1.0, &[0.0, 45.0, 90.0], &[0.0, 40.0, 70.0, 100.0]),
    // Draw down and back, and turn inwards.
    ("TMAJ", 1, -1.0, &[0.0, 45.0, 90.0], &[40.0, 70.0, 100.0, 130.0]),
    ("TMAJ", 2, 1.0, &[0.0, 45.0, 90.0], &[0.0, 40.0, 70.0, 100.0]),
    ("LAT1", 1, -1.0, &[0.0, 45.0, 90.0], &[40.0, 70.0, 100.0, 130.0]),
    ("LAT2", 1, -1.0, &[0.0, 45.0, 90.0], &[40.0, 70.0, 100.0, 130.0]),
    ("LAT3", 1, -1.0, &[0.0, 45.0, 90.0], &[40.0, 70.0, 100.0, 130.0]),
    ("LAT1", 2, 1.0, &[0.0, 45.0, 90.0], &[0.0, 40.0, 70.0, 100.0]),
    ("LAT2", 2, 1.0, &[0.0, 45.0, 90.0], &[0.0, 40.0, 70.0, 100.0]),
    ("LAT3", 2, 1.0, &[0.0, 45.0, 90.0], &[0.0, 40.0, 70.0, 100.0]),
    // Upper part lifts forward; all swing forward and turn inwards; the lower parts draw down.
    ("PECM1", 1, 1.0, &[90.0], &[10.0, 40.0, 70.0]),
    ("PECM1", 0, 1.0, &[0.0, 45.0], &[40.0, 70.0, 100.0]),
    ("PECM2", 0, 1.0, &[0.0, 45.0], &[40.0, 70.0, 100.0]),
    ("PECM3", 0, 1.0, &[0.0, 45.0], &[40.0, 70.0, 100.0]),
    ("PECM1", 2, 1.0, &[0.0, 45.0], &[0.0, 40.0, 70.0]),
    ("PECM2", 2, 1.0, &[0.0, 45.0], &[0.0, 40.0, 70.0]),
    ("PECM3", 2, 1.0, &[0.0, 45.0], &[0.0, 40.0, 70.0]),
    ("PECM2", 1, -1.0, &[0.0], &[10.0, 40.0, 70.0, 100.0]),
    ("PECM3", 1, -1.0, &[0.0], &[10.0, 40.0, 70.0, 100.0]),
    // Swing forward, and lift a hanging arm forward.
    ("CORB", 0, 1.0, &[0.0, 45.0], &[40.0, 70.0, 100.0]),
    ("CORB", 1, 1.0, &[90.0], &[10.0]),
    ("BICshort", 1, 1.0, &[90.0], &[10.0]),
    ("BIClong", 1, 1.0, &[45.0, 90.0], &[10.0, 40.0, 70.0]),
    // Draws down and back.
    ("TRIlong", 1, -1.0, &[0.0, 45.0, 90.0], &[10.0, 40.0, 70.0, 100.0]),
];

#[test]
fn shoulder_muscles_pull_where_anatomy_says() {
    let m = arm();
    let mut weakest = f64::INFINITY;
    for (name, coordinate, sign, planes, elevations) in ANATOMY {
        for (plane, elevation) in planes.iter().flat_map(|plane| elevations.iter().map(move |e| (*plane, *e)))
        {
            let arm = sign * about(&m, *coordinate, [plane, elevation, 0.0, 20.0, 0.0])[of(&m, name)];
            weakest = weakest.min(arm);
            assert!(arm > 0.0, "{name} about coordinate {coordinate} at {plane}, {elevation}: {arm:.1} mm");
        }
    }
    println!("the smallest is {weakest:.1} mm");
}

/// The rotator cuff turns the arm the same way whether it is turned inwards or outwards already.
#[test]
fn the_rotator_cuff_turns_the_arm_at_every_rotation() {
    let m = arm();
    let places = [0.0, 45.0, 90.0].into_iter().flat_map(|plane| [[plane, 0.0], [plane, 60.0]]);
    for [plane, elevation] in places {
        for rotation in [-60.0, -30.0, 0.0, 30.0, 60.0] {
            let arms = about(&m, 2, [plane, elevation, rotation, 20.0, 0.0]);
            for (name, sign) in [("INFSP", -1.0), ("TMIN", -1.0), ("SUBSC", 1.0)] {
                let arm = sign * arms[of(&m, name)];
                assert!(arm > 2.0, "{name} at {plane}, {elevation}, {rotation}: {arm:.1} mm");
            }
        }
    }
}

/// Elbow flexors of an adult hold 60 to 80 N m at their best angle, extensors 40 to 50.
#[test]
fn elbow_muscles_are_as_strong_as_those_of_an_adult() {
    let m = arm();
    let elbow = m.joint("elbow_flexion").unwrap().index();
    let best = |names: &[&str]| {
        let mut act = vec![0.0; m.na];
        names.iter().for_each(|name| act[of(&m, name)] = 1.0);
        let torque = |step: i32| {
            let pose = pose(&m, [0.0, 0.0, 0.0, BENT * f64::from(step) / 20.0, 0.0]);
            flexed(&m, &pose, &act).actuation.qfrc_actuator[elbow].abs()
        };
        (0..=20).map(torque).fold(0.0, f64::max)
    };
    let (bend, stretch) =
        (best(&["BIClong", "BICshort", "BRA", "BRD"]), best(&["TRIlong", "TRIlat", "TRImed", "ANC"]));
    println!("flexors {bend:.1} N m, extensors {stretch:.1} N m");
    assert!((60.0..80.0).contains(&bend), "flexors: {bend:.1} N m");
    assert!((40.0..50.0).contains(&stretch), "extensors: {stretch:.1} N m");
}

/// Masses of an adult of 75 kg after de Leva, Journal of Biomechanics 29(9), 1996: upper arm, forearm and hand in parts of the body's.
#[test]
fn segments_are_as_heavy_as_those_of_an_adult() {
    let m = arm();
    let below = |name: &str| m.body_subtreemass[m.body(name).unwrap().index()];
    let segments = [
        ("upper arm", below("humerus") - below("ulna"), 0.0271),
        ("forearm", below("ulna") - below("lunate"), 0.0162),
        ("hand", below("lunate"), 0.0061),
        ("arm", below("humerus"), 0.0494),
    ];
    for (name, mass, part) in segments {
        let off = mass / (75.0 * part) - 1.0;
        println!("{name}: {mass:.3} kg, {:.0} %", 100.0 * off);
        assert!(off.abs() < 0.25, "{name}: {mass:.3} kg");
    }
}

/// Planes of elevation from the side to the front, elevations to above the shoulder.
#[test]
fn muscles_of_shoulder_and_elbow_go_round_bones() {
    let m = arm();
    // As the model's `myoarm_torso` is scaled and placed.
    let torso = robohive_assets::mesh("myoelbow/torso.obj").unwrap();
    let torso = torso.mapped(|[x, y, z]| [0.95 * x - 0.035, z - 0.01, -0.9 * y]);
    let bones = [
        ("torso", m.body("thorax").unwrap(), torso),
        bone(&m, "myoarm", "clavicle", "clavicle"),
        bone(&m, "myoarm", "scapula", "scapula"),
        bone(&m, "myoarm", "humerus", "humerus"),
        bone(&m, "myohand", "humerus", "humerus"),
        bone(&m, "myohand", "ulna", "ulna"),
        bone(&m, "myohand", "radius", "radius"),
    ];
    let poses: [Angles; 18] = [
        [0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 60.0, -60.0],
        [0.0, 0.0, 0.0, 130.0, 60.0],
        [0.0, 40.0, 0.0, 20.0, 0.0],
        [0.0, 90.0, 0.0, 90.0, 0.0],
        [45.0, 60.0, 0.0, 30.0, 40.0],
        [45.0, 100.0, 20.0, 30.0, 0.0],
        [90.0, 30.0, 0.0, 90.0, 0.0],
        [90.0, 70.0, 0.0, 60.0, 0.0],
        [90.0, 100.0, 0.0, 0.0, 0.0],
        [0.0, 20.0, -60.0, 0.0, 0.0],
        [0.0, 20.0, 60.0, 0.0, 0.0],
        [45.0, 60.0, 60.0, 30.0, 0.0],
        [45.0, 60.0, -60.0, 30.0, 0.0],
        [-30.0, 30.0, 0.0, 30.0, 0.0],
        [0.0, 110.0, 0.0, 20.0, 0.0],
        [45.0, 110.0, 0.0, 20.0, 0.0],
        [90.0, 110.0, 0.0, 20.0, 0.0],
    ];
    let poses = poses.map(|angles| pose(&m, angles));
    let looked = some_stay_outside(&m, 0..UPPER, &bones, 0.02, &poses);
    assert!(looked > 20_000, "{looked}");
}

/// The arm hangs at rest without excitation, is lifted by muscles of the shoulder, and bent by those of the elbow.
#[test]
fn muscles_lift_and_bend_the_arm() {
    let m = arm();
    let [lifted, bent] = ["shoulder_elv", "elbow_flexion"].map(|name| m.joint(name).unwrap().index());
    let mut d = Data::new(&m);
    let rest = vec![0.0; m.nu];
    excite(&m, &mut d, &rest, 3.0);
    println!("hangs: elevation {:.2}, elbow {:.2}", d.state.qpos[lifted], d.state.qpos[bent]);
    assert!(d.state.qpos[lifted] < 0.5 && d.state.qpos[bent] < 0.7);
    assert!(d.state.qvel[..=bent].iter().all(|speed| speed.abs() < 0.05), "{:?}", d.state.qvel);
    let mut excited = rest.clone();
    ["DELT1", "DELT2", "SUPSP"].iter().for_each(|name| excited[of(&m, name)] = 0.8);
    excite(&m, &mut d, &excited, 2.0);
    println!("lifts to {:.2}", d.state.qpos[lifted]);
    assert!(d.state.qpos[lifted] > 1.0, "{}", d.state.qpos[lifted]);
    let mut excited = rest;
    ["BIClong", "BICshort", "BRA"].iter().for_each(|name| excited[of(&m, name)] = 0.6);
    excite(&m, &mut d, &excited, 2.0);
    assert!(d.state.qpos[bent] > 0.8 * BENT * PI / 180.0, "{}", d.state.qpos[bent]);
}

/// The weakest activations, by least squares, with which muscles hold the arm of a pose against gravity.
fn holding(m: &Model, pose: &[f64]) -> Vec<f64> {
    let followers: Vec<usize> = (0..m.neq).map(|i| m.eq_obj1id[i] as usize).collect();
    let free =
        (0..m.body_dofadr[m.body("Object").unwrap().index()] as usize).filter(|i| !followers.contains(i));
    let motions: Vec<Vec<f64>> = free.map(|joint| motion_of(m, joint)).collect();
    let along = |force: &[f64]| -> Vec<f64> {
        motions.iter().map(|motion| motion.iter().zip(force).map(|(a, b)| a * b).sum()).collect()
    };
    let mut act = vec![0.0; m.na];
    let slack = flexed(m, pose, &act);
    let lacking: Vec<f64> = slack
        .vel
        .qfrc_bias
        .iter()
        .zip(&slack.actuation.qfrc_actuator)
        .map(|(bias, pull)| bias - pull)
        .collect();
    let mut lacking = along(&lacking);
    let pulls: Vec<Vec<f64>> = (0..m.na)
        .map(|muscle| {
            act[muscle] = 1.0;
            let pull = along(&flexed(m, pose, &act).actuation.qfrc_actuator);
            act[muscle] = 0.0;
            pull.iter().zip(along(&slack.actuation.qfrc_actuator)).map(|(a, b)| a - b).collect()
        })
        .collect();
    // One muscle after another takes what it can of what is lacking.
    for _ in 0..1000 {
        for (muscle, pull) in pulls.iter().enumerate() {
            let [dot, square] =
                [&lacking, pull].map(|other| pull.iter().zip(other).map(|(a, b)| a * b).sum::<f64>());
            let step = (dot - 4e-6 * act[muscle]) / (square + 4e-6);
            let next = (act[muscle] + step).clamp(0.0, 1.0);
            lacking.iter_mut().zip(pull).for_each(|(lacking, pull)| *lacking -= pull * (next - act[muscle]));
            act[muscle] = next;
        }
    }
    act
}

/// With constant activations, muscles hold the hand over the cube and drawn back, as the key frames of the task have it.
#[test]
fn muscles_hold_the_hand_over_the_cube() {
    let m = measure::own("myoarm/tasks/relocate.xml");
    for key in 0..2 {
        let pose = &m.key_qpos[key * m.nq..(key + 1) * m.nq];
        let act = holding(&m, pose);
        let mut d = flexed(&m, pose, &act);
        let palm = |d: &Data| *d.site(m.site("S_grasp").unwrap()).xpos();
        let start = palm(&d);
        excite(&m, &mut d, &act, 0.5);
        let moved = palm(&d).iter().zip(start).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        let most = act.iter().copied().fold(0.0, f64::max);
        println!("key frame {key}: largest activation {most:.2}, palm moves by {:.1} mm", 1e3 * moved);
        assert!(most < 0.5 && moved < 0.01, "{key}: {most}, {moved}");
    }
}

/// All muscles that lift, pulling at once, turn the arm held to the side or forward by four times what its weight does.
#[test]
fn the_shoulder_lifts_more_than_the_arm() {
    let m = arm();
    for plane in [0.0, 90.0] {
        let pose = pose(&m, [plane, 90.0, 0.0, 17.0, 0.0]);
        let about = |force: &[f64]| motion(&m, 1).iter().zip(force).map(|(a, b)| a * b).sum::<f64>();
        let slack = flexed(&m, &pose, &vec![0.0; m.na]);
        let weight = about(&slack.vel.qfrc_bias);
        let pull = |muscle: usize| {
            let mut act = vec![0.0; m.na];
            act[muscle] = 1.0;
            let pulled = about(&flexed(&m, &pose, &act).actuation.qfrc_actuator);
            pulled - about(&slack.actuation.qfrc_actuator)
        };
        let pulls: Vec<f64> = (0..UPPER).map(pull).collect();
        let [lift, lower] =
            [1.0, -1.0].map(|sign| pulls.iter().map(|pull| (sign * pull).max(0.0)).sum::<f64>());
        println!("plane {plane}: lift {lift:.0} N m, lower {lower:.0}, weight {weight:.1}");
        assert!(lift > 4.0 * weight && lower > lift, "{plane}: {lift}, {lower}, {weight}");
    }
}

/// Moment arms of the shoulder change steadily with the elevation, to the side and forward, up to 120 degrees: by no more than 1.05 mm a
/// degree, and over half a degree by half of that, as they would not where a path jumps.
#[test]
fn moment_arms_of_the_shoulder_do_not_jump() {
    let m = arm();
    for plane in [0.0, 90.0] {
        let at = |half: i32| about(&m, 1, [plane, f64::from(half) / 2.0, 0.0, 20.0, 0.0])[..UPPER].to_vec();
        let rows: Vec<Vec<f64>> = (0..=240).map(at).collect();
        let degrees: Vec<Vec<f64>> = rows.iter().step_by(2).cloned().collect();
        println!("plane {plane}: {:.2} mm a degree, {:.2} mm a half", jump(&degrees), jump(&rows));
        assert!(jump(&degrees) < 1.05 && jump(&rows) < 0.525, "{plane}: {}, {}", jump(&degrees), jump(&rows));
    }
}
