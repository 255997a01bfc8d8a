//! Two legs with eighty muscles: moment arms against published ones and those of MyoHub's model, strength, symmetry, and paths
//! outside of bones.

mod measure;

use measure::balance::{Spring, stand};
use measure::coupled::{arms_about, pose, torque_about};
use measure::muscles::{bone, flexed, some_stay_outside};
use physics::Model;
use physics::model::GeomType;

/// Joints of the right leg that muscles move, and their ranges \[degrees\].
const JOINTS: [(&str, f64, f64); 7] = [
    ("hip_flexion_r", -30.0, 120.0),
    ("hip_adduction_r", -50.0, 30.0),
    ("hip_rotation_r", -40.0, 40.0),
    ("knee_angle_r", 0.0, 120.0),
    ("ankle_angle_r", -40.0, 30.0),
    ("subtalar_angle_r", -20.0, 20.0),
    ("mtp_angle_r", -30.0, 30.0),
];

/// Published moment arms: joint, muscles, angle \[degrees\], arm \[mm\]. Of the knee: the effective arm of the quadriceps in ten women and
/// ten men, means of both (Sheehan and others, PMC4662057 and PMC2753825). Of the ankle: the tendon of Achilles at rest (Manal and
/// others, 2013, PMC3871454).
const PUBLISHED: [(&str, &[&str], f64, f64); 4] = [
    ("knee_angle_r", &QUADRICEPS, 10.0, -46.3),
    ("knee_angle_r", &QUADRICEPS, 50.0, -32.2),
    ("ankle_angle_r", &["soleus_r", "gasmed_r", "gaslat_r"], 20.0, -34.6),
    ("ankle_angle_r", &["soleus_r", "gasmed_r", "gaslat_r"], -10.0, -36.9),
];
const QUADRICEPS: [&str; 4] = ["vasint_r", "vaslat_r", "vasmed_r", "recfem_r"];
const PLANTARFLEXORS: [&str; 8] =
    ["soleus_r", "gasmed_r", "gaslat_r", "tibpost_r", "fdl_r", "fhl_r", "perlong_r", "perbrev_r"];

/// Moment arms of MyoHub's legs \[mm\] at eleven angles over the range of a joint, and which of these are compared. Left out are the ends
/// that README.md names.
type Row = (&'static str, &'static str, [f64; 11], std::ops::Range<usize>);
const SOURCE: [Row; 5] = [
    ("knee_angle_r", "semimem_r", [40., 45., 49., 53., 54., 53., 50., 44., 36., 26., 15.], 0..11),
    ("knee_angle_r", "gasmed_r", [14., 18., 22., 24., 26., 27., 26., 24., 20., 14., 6.], 1..10),
    ("ankle_angle_r", "tibant_r", [32., 34., 36., 38., 40., 42., 43., 44., 44., 44., 43.], 0..11),
    ("hip_flexion_r", "psoas_r", [9., 14., 19., 24., 28., 31., 33., 34., 33., 27., 10.], 3..10),
    ("hip_flexion_r", "glmax2_r", [-66., -66., -63., -57., -51., -43., -35., -26., -17., -7., 3.], 0..9),
];

/// What muscles do over the whole range of a joint: to smaller angles, and to larger ones.
const ACTIONS: [(&str, &str, &str); 6] = [
    ("hip_flexion_r", "glmax1 glmax2 glmax3 bflh semimem semiten", "iliacus psoas recfem tfl sart"),
    (
        "hip_adduction_r",
        "glmed1 glmed2 glmed3 glmin1 glmin2 glmin3 tfl piri",
        "addbrev addlong addmagProx addmagMid addmagDist addmagIsch grac",
    ),
    ("knee_angle_r", "recfem vasint vaslat vasmed", "bflh bfsh semimem semiten grac sart gaslat gasmed"),
    ("ankle_angle_r", "soleus gasmed gaslat tibpost fdl fhl perlong perbrev", "tibant edl ehl"),
    ("subtalar_angle_r", "perlong perbrev edl", "tibpost tibant fdl fhl"),
    ("mtp_angle_r", "edl ehl", "fdl fhl"),
];

fn legs() -> Model {
    measure::own("myolegs/scene.xml")
}

fn number(m: &Model, muscle: &str) -> usize {
    m.actuator(muscle).unwrap_or_else(|| panic!("no muscle {muscle}")).index()
}

/// Moment arms of all muscles \[mm\] about a joint at equally spaced angles over its range.
fn sweep(m: &Model, joint: &str, steps: usize) -> Vec<Vec<f64>> {
    let (_, low, high) = JOINTS.into_iter().find(|(name, ..)| *name == joint).unwrap();
    let at = |step: usize| (low + (high - low) * step as f64 / steps as f64).to_radians();
    let arms = |step| arms_about(m, &pose(m, &[(joint, at(step))]), joint);
    (0..=steps).map(|step| arms(step).iter().map(|arm| arm * 1e3).collect()).collect()
}

#[test]
fn moment_arms_are_those_published() {
    let m = legs();
    for (joint, muscles, angle, published) in PUBLISHED {
        let arms = arms_about(&m, &pose(&m, &[(joint, angle.to_radians())]), joint);
        for muscle in muscles {
            let off = arms[number(&m, muscle)] * 1e3 / published - 1.0;
            println!("{muscle} at {angle}: {:+.1} %", 100.0 * off);
            assert!(off.abs() < 0.15, "{muscle} at {angle}: {:.1} %", 100.0 * off);
        }
    }
}

#[test]
fn moment_arms_are_near_those_of_the_source() {
    let m = legs();
    for (joint, muscle, expected, compared) in SOURCE {
        let rows = sweep(&m, joint, 10);
        let own = rows.iter().map(|row| row[number(&m, muscle)]).collect::<Vec<_>>();
        println!("{muscle}: {}", own.iter().map(|arm| format!("{arm:.0} ")).collect::<String>());
        for step in compared {
            let off = own[step] / expected[step] - 1.0;
            assert!(off.abs() < 0.25, "{muscle}, step {step}: {:.1} mm, {:.0} %", own[step], 100.0 * off);
        }
    }
}

/// Neighbours of 181 angles differ by the slope of the curve; what a jump adds shows in the difference of differences.
#[test]
fn moment_arms_neither_jump_nor_change_sign() {
    let m = legs();
    for (joint, ..) in JOINTS {
        let rows = sweep(&m, joint, 180);
        let change = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let steepest = rows.windows(2).map(|pair| change(&pair[0], &pair[1])).fold(0.0, f64::max);
        let line =
            |i: usize| rows[i - 1].iter().zip(&rows[i + 1]).map(|(a, b)| (a + b) / 2.0).collect::<Vec<_>>();
        let jump = (1..180).map(|i| 2.0 * change(&rows[i], &line(i))).fold(0.0, f64::max);
        println!("{joint}: neighbours differ by {steepest:.2} mm, off a line by {jump:.2} mm");
        assert!(jump < 0.5, "{joint}: {jump:.2} mm");
        for (_, smaller, larger) in ACTIONS.into_iter().filter(|(name, ..)| *name == joint) {
            for (muscles, sign) in [(smaller, -1.0), (larger, 1.0)] {
                for muscle in muscles.split(' ') {
                    let at = number(&m, &format!("{muscle}_r"));
                    let least = rows.iter().map(|row| sign * row[at]).fold(f64::INFINITY, f64::min);
                    assert!(least > 0.0, "{muscle} about {joint}: {least:.1} mm");
                }
            }
        }
    }
}

/// The torque about a joint \[N m\] of muscles with full activation.
fn strength(m: &Model, joint: &str, muscles: &[&str], angles: &[(&str, f64)]) -> f64 {
    let angles: Vec<_> =
        angles.iter().map(|(name, degrees): &(&str, f64)| (*name, degrees.to_radians())).collect();
    let pose = pose(m, &angles);
    let mut act = vec![0.0; m.na];
    muscles.iter().for_each(|muscle| act[number(m, muscle)] = 1.0);
    torque_about(m, &pose, joint, &flexed(m, &pose, &act).actuation.qfrc_actuator).abs()
}

/// An adult's knee stretches with 180 to 250 N m at 60 degrees, seated; the ankle presses down with 120 to 170 N m, the knee straight.
#[test]
fn legs_are_as_strong_as_those_of_an_adult() {
    let m = legs();
    let knee = strength(&m, "knee_angle_r", &QUADRICEPS, &[("hip_flexion_r", 80.0), ("knee_angle_r", 60.0)]);
    let ankle = strength(&m, "ankle_angle_r", &PLANTARFLEXORS, &[]);
    println!("knee {knee:.0} N m, ankle {ankle:.0} N m");
    assert!((180.0..250.0).contains(&knee), "knee: {knee:.1} N m");
    assert!((120.0..170.0).contains(&ankle), "ankle: {ankle:.1} N m");
}

#[test]
fn the_body_has_its_mass_and_two_equal_legs() {
    let m = legs();
    let mass: f64 = m.body_mass.iter().sum();
    assert!((mass - 75.7).abs() < 0.05, "{mass:.3} kg");
    let angles = [0.5, -0.2, 0.15, 0.9, -0.2, 0.1, 0.1];
    for bent in [angles, angles.map(|angle: f64| 0.7 * angle), [0.0; 7]] {
        let both = JOINTS.iter().zip(bent).flat_map(|((name, ..), angle)| {
            let name = name.strip_suffix("_r").unwrap();
            ["r", "l"].map(|side| (format!("{name}_{side}"), angle))
        });
        let both: Vec<_> = both.collect();
        let both: Vec<_> = both.iter().map(|(name, angle)| (name.as_str(), *angle)).collect();
        let d = flexed(&m, &pose(&m, &both), &vec![0.0; m.na]);
        for muscle in 0..m.nu / 2 {
            let [right, left] = [muscle, muscle + m.nu / 2].map(|muscle| d.trn.actuator_length[muscle]);
            assert!((right - left).abs() < 1e-9, "muscle {muscle}: {right} and {left} m");
            let [right, left] = [muscle, muscle + m.nu / 2].map(|muscle| m.actuator_gainprm[muscle]);
            assert!(right == left, "muscle {muscle}");
        }
    }
}

/// The kneecap is left out: the tendons of the quadriceps are fixed to it and run on through it.
#[test]
fn muscles_go_round_bones() {
    let m = legs();
    let places = [
        ("pelvis", "pelvis"),
        ("femur", "femur_r"),
        ("tibia", "tibia_r"),
        ("fibula", "tibia_r"),
        ("talus", "talus_r"),
        ("foot", "calcn_r"),
    ];
    let bones = places.map(|(name, body)| bone(&m, "myolegs", name, body));
    let bent = |hip: f64, knee: f64, more: &[(&str, f64)]| {
        let mut angles = vec![("hip_flexion_r", hip), ("knee_angle_r", knee)];
        angles.extend(more);
        pose(&m, &angles)
    };
    let poses = [
        bent(0.0, 0.0, &[]),
        bent(-0.5, 0.0, &[]),
        bent(1.0, 1.0, &[]),
        bent(2.0, 2.0, &[]),
        bent(0.0, 0.1, &[("hip_adduction_r", -0.8), ("ankle_angle_r", 0.5), ("subtalar_angle_r", 0.3)]),
        bent(0.0, 0.1, &[("hip_adduction_r", 0.45), ("ankle_angle_r", -0.65), ("subtalar_angle_r", -0.3)]),
        bent(1.0, 0.5, &[("hip_rotation_r", 0.6)]),
        bent(0.0, 1.5, &[("hip_rotation_r", -0.6)]),
    ];
    let looked = some_stay_outside(&m, 0..m.nu / 2, &bones, 0.02, &poses);
    assert!(looked > 50_000, "{looked}");
}

/// Springs that hold a standing body.
const SPRINGS: [Spring; 7] = [
    ("hip_flexion", 600.0, 30.0),
    ("hip_adduction", 600.0, 30.0),
    ("hip_rotation", 150.0, 30.0),
    ("knee_angle", 600.0, 30.0),
    ("ankle_angle", 500.0, 30.0),
    ("subtalar_angle", 100.0, 10.0),
    ("mtp_angle", 20.0, 3.0),
];

/// Muscles alone hold the body up, free to fall, with bent knees, under one and a half times its weight.
#[test]
fn legs_carry_more_than_the_body() {
    let heavy = "<mujoco><include file='myolegs/scene.xml'/><option gravity='0 0 -14.715'/></mujoco>";
    let (moved, most) = stand(&measure::scene(heavy), &SPRINGS, 3.0);
    println!("pelvis moved by {:.1} mm in 3 s, largest activation {most:.2}", moved * 1e3);
    assert!(moved < 0.02, "{moved:.3} m");
}

/// Keyframes obey the equalities; in the first two the soles are on the floor, in the steps 5 cm over it.
#[test]
fn poses_fit_the_knees_and_the_floor() {
    let m = legs();
    for (key, over) in [0.0, 0.0, 0.05, 0.05].into_iter().enumerate() {
        let qpos = &m.key_qpos[key * m.nq..(key + 1) * m.nq];
        let angle = |name: &'static str| (name, qpos[m.jnt_qposadr[m.joint(name).unwrap().index()] as usize]);
        let expected = pose(&m, &["knee_angle_r", "knee_angle_l"].map(angle));
        for follower in m.eq_obj1id.iter() {
            let place = m.jnt_qposadr[*follower as usize] as usize;
            assert!((qpos[place] - expected[place]).abs() < 1e-4, "key {key}, joint {follower}");
        }
        let d = flexed(&m, qpos, &vec![0.0; m.na]);
        let bottom = |geom: usize| {
            let [radius, half, _] = m.geom_size[geom];
            d.kin.geom_xpos[geom][2] - (half * d.kin.geom_xmat[geom][8]).abs() - radius
        };
        let feet = (0..m.ngeom)
            .filter(|geom| m.geom_contype[*geom] == 1 && m.geom_type[*geom] == GeomType::Capsule as i32);
        let lowest = feet.map(bottom).fold(f64::INFINITY, f64::min);
        assert!((lowest - over).abs() < 2e-3, "key {key}: {lowest:.4} m");
    }
}
