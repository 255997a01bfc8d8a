//! The hand with 39 muscles: moment arms against published means, strength, range, grip, and paths outside of bones.

mod measure;

use measure::muscles::{arms, arms_over_range, bone, excite, flexed, jump, stay_outside};
use measure::run;
use physics::elements::JointId;
use physics::math::{cross, dot, sub};
use physics::{Data, Model};
use std::f64::consts::FRAC_PI_4;

/// Means of moment arms \[mm\], flexion positive, and how near ours are to be: joint, muscle, mean, share. For the index finger two
/// sources differ by up to a half: Ketchum and others, Journal of Hand Surgery 3(6), 1978, and An and others, Journal of Biomechanics
/// 16(6), 1983; for the others there is Ketchum alone.
const PUBLISHED: [(&str, &str, f64, f64); 28] = [
    ("mcp2_flexion", "FDP2", 10.1, 0.25),
    ("mcp2_flexion", "FDP2", 11.1, 0.25),
    ("mcp2_flexion", "FDS2", 12.1, 0.25),
    ("mcp2_flexion", "FDS2", 11.9, 0.25),
    ("mcp2_flexion", "EDC2", -8.6, 0.25),
    ("mcp2_flexion", "EIP", -9.0, 0.25),
    ("pm2_flexion", "FDP2", 9.8, 0.25),
    ("pm2_flexion", "FDP2", 7.9, 0.25),
    ("pm2_flexion", "FDS2", 8.3, 0.25),
    ("pm2_flexion", "FDS2", 6.2, 0.25),
    ("md2_flexion", "FDP2", 6.5, 0.25),
    ("md2_flexion", "FDP2", 4.1, 0.25),
    ("md2_flexion", "EDC2", -2.2, 0.25),
    ("mcp3_flexion", "FDP3", 11.6, 0.15),
    ("mcp3_flexion", "FDS3", 14.0, 0.15),
    ("pm3_flexion", "FDP3", 10.7, 0.15),
    ("pm3_flexion", "FDS3", 8.7, 0.15),
    ("md3_flexion", "FDP3", 7.0, 0.15),
    ("mcp4_flexion", "FDP4", 10.4, 0.15),
    ("mcp4_flexion", "FDS4", 13.0, 0.15),
    ("pm4_flexion", "FDP4", 10.4, 0.15),
    ("pm4_flexion", "FDS4", 8.5, 0.15),
    ("md4_flexion", "FDP4", 6.8, 0.15),
    ("mcp5_flexion", "FDP5", 8.9, 0.15),
    ("mcp5_flexion", "FDS5", 9.8, 0.15),
    ("pm5_flexion", "FDP5", 8.5, 0.15),
    ("pm5_flexion", "FDS5", 7.4, 0.15),
    ("md5_flexion", "FDP5", 6.0, 0.15),
];

/// Muscles by the beginnings of their names, joints with their digits left out, and on which side of the joint's axis the muscles stay in
/// every pose.
const SIDES: [(&[&str], &[&str], f64); 13] = [
    (&["PT", "PQ"], &["pro_sup"], 1.0),
    (&["FCR", "FCU", "PL", "FDS", "FDP", "FPL"], &["flexion"], 1.0),
    (&["EC", "ED", "EIP", "EPL"], &["flexion"], -1.0),
    (&["ECR", "FCR", "EPL", "EPB", "APL"], &["deviation"], 1.0),
    (&["ECU", "FCU"], &["deviation"], -1.0),
    (&["FDS", "FDP"], &["mcp_flexion", "pm_flexion", "md_flexion"], 1.0),
    (&["ED", "EIP"], &["mcp_flexion", "pm_flexion", "md_flexion"], -1.0),
    (&["RI", "LU", "UI"], &["mcp_flexion"], 1.0),
    (&["LU", "UI"], &["pm_flexion"], -1.0),
    (&["RI", "LU"], &["mcp_abduction"], 1.0),
    (&["UI"], &["mcp_abduction"], -1.0),
    (&["EPB", "EPL", "APL"], &["mp_flexion", "ip_flexion"], 1.0),
    (&["FPL"], &["mp_flexion", "ip_flexion", "cmc_abduction"], -1.0),
];

fn hand() -> Model {
    measure::own("myohand/scene.xml")
}

fn joint(m: &Model, name: &str) -> usize {
    m.joint(name).unwrap().index()
}

/// The joints of fingers that bend.
fn bending(m: &Model) -> Vec<usize> {
    let bends = |(id, name): (JointId, &str)| name.ends_with("flexion").then_some(id.index());
    m.joint_names().filter_map(bends).filter(|joint| *joint > 6).collect()
}

/// A number for each muscle, 0 for those whose names begin as none of these.
fn levels(m: &Model, given: &[(&str, f64)]) -> Vec<f64> {
    let of =
        |name: &str| given.iter().find(|(start, _)| name.starts_with(start)).map_or(0.0, |(_, level)| *level);
    m.actuator_names().map(|(_, name)| of(name)).collect()
}

/// A pose in which fingers are bent by this share of their range, and spread so far that they do not cross.
fn fist(m: &Model, share: f64) -> Vec<f64> {
    let mut pose = vec![0.0; m.nq];
    for joint in bending(m) {
        pose[joint] = share * m.jnt_range[joint][1];
    }
    for (name, angle) in [("mcp2_abduction", 0.1), ("mcp4_abduction", -0.15), ("mcp5_abduction", -0.26)] {
        pose[joint(m, name)] = angle;
    }
    pose
}

/// Poses with every joint at either end of its range or in the middle, in an order that mixes them.
fn mixed(m: &Model, count: u64) -> Vec<Vec<f64>> {
    let mut bits = 0x9E37_79B9_7F4A_7C15_u64;
    let mut draw = || {
        bits ^= bits << 13;
        bits ^= bits >> 7;
        bits ^= bits << 17;
        (bits >> 33) % 3
    };
    let mut angle = |[low, high]: [f64; 2]| low + (high - low) * [0.0, 0.5, 1.0][draw() as usize];
    (0..count).map(|_| m.jnt_range.iter().map(|range| angle(*range)).collect()).collect()
}

#[test]
fn moment_arms_are_near_the_published_means() {
    let m = hand();
    for (name, muscle, published, near) in PUBLISHED {
        let joint = joint(&m, name);
        let mut pose = vec![0.0; m.nq];
        pose[joint] = FRAC_PI_4;
        let off = 1000.0 * arms(&m, &pose, joint)[m.actuator(muscle).unwrap().index()] / published - 1.0;
        assert!(off.abs() < near, "{muscle} at {name}: {:.1} %", 100.0 * off);
    }
}

#[test]
fn moment_arms_do_not_jump() {
    let m = hand();
    let mut poses = mixed(&m, 4);
    poses.extend([vec![0.0; m.nq], fist(&m, 1.0)]);
    for pose in poses {
        for joint in 0..m.nv {
            let jump = jump(&arms_over_range(&m, &pose, joint));
            assert!(jump < 0.5e-3, "joint {joint} at {pose:?}: {jump}");
        }
    }
}

#[test]
fn muscles_stay_on_their_sides_of_joints() {
    let m = hand();
    let plain = |name: &str| name.replace(|letter: char| letter.is_ascii_digit(), "");
    let joints: Vec<_> = m.joint_names().map(|(_, name)| plain(name)).collect();
    let names: Vec<_> = m.actuator_names().map(|(_, name)| name).collect();
    let mut looked = 0;
    for pose in mixed(&m, 150) {
        for (dof, joint) in joints.iter().enumerate() {
            let arms = arms(&m, &pose, dof);
            for (muscles, crossed, side) in &SIDES {
                let listed = |name: &str| muscles.iter().any(|beginning| name.starts_with(beginning));
                for (muscle, arm) in arms.iter().enumerate().filter(|(muscle, _)| listed(names[*muscle])) {
                    if crossed.contains(&joint.as_str()) && *arm != 0.0 {
                        assert!(side * arm > 0.5e-3, "{} at {joint} {dof}: {arm} at {pose:?}", names[muscle]);
                        looked += 1;
                    }
                }
            }
        }
    }
    assert!(looked > 15_000, "{looked}");
}

/// Where RoboHive's hand has its tips and the middle of its palm in the initial pose \[m\]: targets of the tasks are given in the room.
#[test]
fn tips_are_where_the_tasks_expect_them() {
    let m = hand();
    let d = flexed(&m, &vec![0.0; m.nq], &vec![0.0; m.na]);
    for (name, place) in [
        ("THtip", [-0.1609, -0.5466, 1.4845]),
        ("IFtip", [-0.2217, -0.6116, 1.4525]),
        ("MFtip", [-0.2208, -0.6194, 1.4272]),
        ("RFtip", [-0.2107, -0.6088, 1.4008]),
        ("LFtip", [-0.1907, -0.5909, 1.3888]),
        ("S_grasp", [-0.1642, -0.5261, 1.4258]),
    ] {
        let off = sub(*d.site(m.site(name).unwrap()).xpos(), place);
        assert!(dot(off, off).sqrt() < 1e-3, "{name}: {off:?}");
    }
}

/// With these activations, moments at the four joints of the index finger balance one force on its tip, which is that of an adult's, 40 to
/// 60 N.
#[test]
fn the_index_finger_presses_as_hard_as_that_of_an_adult() {
    let m = hand();
    let mut pose = vec![0.0; m.nq];
    for (name, angle) in [("mcp2_flexion", 0.5), ("pm2_flexion", 0.5), ("md2_flexion", 0.3)] {
        pose[joint(&m, name)] = angle;
    }
    let act = levels(&m, &[("FDP2", 1.0), ("FDS2", 0.515), ("LU_RB2", 0.673), ("UI_UB2", 0.369)]);
    let d = flexed(&m, &pose, &act);
    let distal = d.body(m.body("distph2").unwrap()).xmat();
    let back = [distal[2], distal[5], distal[8]];
    let tip = *d.site(m.site("IFtip").unwrap()).xpos();
    // What a newton that presses the tip to the back does at a joint.
    let moment = |joint: usize| dot(cross(sub(tip, d.kin.xanchor[joint]), back), d.kin.xaxis[joint]);
    let force = |name: &str| -d.actuation.qfrc_actuator[joint(&m, name)] / moment(joint(&m, name));
    let forces = ["mcp2_flexion", "pm2_flexion", "md2_flexion"].map(force);
    println!("{forces:.1?} N");
    assert!(forces.iter().all(|force| (40.0..60.0).contains(force)), "{forces:?} N");
    assert!(forces.iter().all(|force| (force / forces[0] - 1.0).abs() < 0.02), "{forces:?} N");
    let aside = joint(&m, "mcp2_abduction");
    let left = d.actuation.qfrc_actuator[aside] + forces[0] * moment(aside);
    assert!(left.abs() < 0.01, "{left} N m");
}

/// Muscles, which only pull, hold the target of a task of poses, a fist, against gravity; in joints at an end of their range, its bone does.
#[test]
fn muscles_can_hold_a_fist() {
    let m = hand();
    let pose = [
        0.0, 0.0, 0.0, 0.5624, 0.28272, -0.75573, -1.309, 1.30045, -0.006982, 1.45492, 0.998897, 1.26466,
        0.0, 1.40604, 0.227795, 1.07614, -0.020944, 1.46103, 0.06284, 0.83263, -0.14399, 1.571, 1.38248,
    ];
    let d = flexed(&m, &pose, &levels(&m, &FIST));
    let inner = (0..m.nv).filter(|dof| {
        let [low, high] = m.jnt_range[*dof];
        pose[*dof] > low + 0.02 && pose[*dof] < high - 0.02
    });
    for dof in inner {
        let short = d.actuation.qfrc_actuator[dof] - d.vel.qfrc_bias[dof];
        assert!(short.abs() < 2e-3, "joint {dof}: {short} N m");
    }
}

const FIST: [(&str, f64); 21] = [
    ("ECRL", 0.0016),
    ("ECRB", 0.1362),
    ("FCU", 0.0763),
    ("FDS5", 0.0009),
    ("FDP5", 0.0016),
    ("FDP4", 0.0054),
    ("FDP3", 0.0047),
    ("FDP2", 0.0064),
    ("EDC5", 0.0072),
    ("EDC4", 0.0187),
    ("EDC3", 0.0228),
    ("EDC2", 0.0507),
    ("EPL", 0.0037),
    ("EPB", 0.0033),
    ("FPL", 0.0009),
    ("APL", 0.0018),
    ("RI2", 0.0169),
    ("RI3", 0.0072),
    ("LU_RB3", 0.0046),
    ("LU_RB4", 0.0105),
    ("RI5", 0.0088),
];

/// Muscles bend and stretch all fingers, thumb and wrist to the ends of their ranges.
#[test]
fn muscles_move_the_hand_through_its_range() {
    let m = hand();
    let mut d = Data::new(&m);
    let goal = |d: &mut Data, excited: &[(&str, f64)], joints: &[(usize, usize)]| {
        excite(&m, d, &levels(&m, excited), 3.0);
        for &(joint, end) in joints {
            let off = d.state.qpos[joint] - m.jnt_range[joint][end];
            assert!(off.abs() < 0.08, "{excited:?}, joint {joint} of {:?}", d.state.qpos);
        }
    };
    let (fingers, wrist) = (bending(&m), joint(&m, "flexion"));
    let at = |end: usize| fingers.iter().map(move |joint| (*joint, end)).collect::<Vec<_>>();
    let thumb = |end: usize| ["mp_flexion", "ip_flexion"].map(|name| (joint(&m, name), end));
    goal(&mut d, &[("FD", 0.2), ("ECR", 0.5), ("ECU", 0.5), ("EPL", 0.5)], &at(1));
    goal(&mut d, &[("ED", 1.0), ("EIP", 1.0), ("FC", 0.5), ("EPL", 0.5)], &at(0));
    goal(&mut d, &[("FPL", 0.5)], &thumb(0));
    goal(&mut d, &[("EPL", 0.5), ("EPB", 0.5)], &thumb(1));
    goal(&mut d, &[("FC", 0.4)], &[(wrist, 1)]);
    goal(&mut d, &[("EC", 0.4)], &[(wrist, 0)]);
    goal(&mut d, &[("PT", 0.5), ("PQ", 0.5)], &[(joint(&m, "pro_sup"), 1)]);
}

/// A hand and an upright bar of 0.3 kg, 50 mm thick, which is held in its place at first.
const BAR: &str = "<mujoco><compiler autolimits='true'/><option cone='elliptic' impratio='10'/>
  <asset><model name='hand' file='myohand/robot.xml'/></asset>
  <worldbody>
    <frame pos='-0.0095 0.6389 0.9655' quat='1 0 -1 0'><attach model='hand' body='humerus' prefix=''/></frame>
    <body name='bar' pos='0 0 1'><freejoint/><geom type='cylinder' size='0.025 0.06' mass='0.3' condim='4'/></body>
  </worldbody>
  <equality><weld body1='bar' solref='0.004 1' solimp='0.99 0.999 0.001'/></equality></mujoco>";
/// How the wrist's muscles answer when the forearm turns too far inwards and the wrist too far aside and too far bent.
const ANSWERS: [(&str, [f64; 3]); 7] = [
    ("ECRL", [0.0, -1.0, 1.0]),
    ("ECRB", [0.0, -0.5, 1.0]),
    ("ECU", [0.0, 1.0, 0.5]),
    ("FCR", [0.0, -0.3, -1.0]),
    ("FCU", [0.0, 0.6, -1.0]),
    ("PT", [-1.0, 0.0, 0.0]),
    ("PQ", [-1.0, 0.0, 0.0]),
];

/// Fingers press with constant activations; muscles of the wrist keep it straight.
#[test]
fn the_hand_holds_a_bar_by_its_muscles() {
    let m = measure::scene(BAR);
    let mut d = Data::new(&m);
    d.state.qpos[3..7].copy_from_slice(&[-0.3, 0.65, 0.0, -0.2]);
    for finger in 0..4 {
        for (joint, angle) in [(7, 0.6), (9, 0.9), (10, 0.5)] {
            d.state.qpos[4 * finger + joint] = angle;
        }
    }
    let grip = [
        ("FD", 0.15),
        ("FPL", 0.1),
        ("OP", 0.85),
        ("APL", 0.1),
        ("RI", 0.15),
        ("LU", 0.25),
        ("UI", 0.1),
        ("EDC", 0.03),
    ];
    d.state.ctrl.copy_from_slice(&levels(&m, &grip));
    let answer = |d: &mut Data| {
        for (name, factors) in ANSWERS {
            let too_far = |joint: usize| 2.5 * d.state.qpos[joint] + 0.2 * d.state.qvel[joint];
            let more: f64 = (0..3).map(|joint| factors[joint] * too_far(joint)).sum();
            d.state.ctrl[m.actuator(name).unwrap().index()] = (0.15 + more).clamp(0.0, 1.0);
        }
    };
    run(&m, &mut d, 1.0, answer);
    d.state.eq_active[0] = false;
    let mut heights = vec![d.state.qpos[m.nq - 5]];
    for seconds in [1.0, 5.0] {
        run(&m, &mut d, seconds, answer);
        heights.push(d.state.qpos[m.nq - 5]);
    }
    let [sunk, slipped] = [0, 1].map(|time| 1e3 * (heights[time] - heights[time + 1]));
    println!("sank by {sunk:.1} mm when let go, then slipped by {slipped:.1} mm in 5 s");
    assert!(sunk.abs() < 3.0 && slipped.abs() < 3.0, "{sunk} and {slipped} mm");
}

#[test]
fn muscles_go_round_bones() {
    let m = hand();
    let fixed = [
        ("humerus", "humerus"),
        ("ulna", "ulna"),
        ("radius", "radius"),
        ("wrist", "lunate"),
        ("thumb_metacarpal", "firstmc"),
        ("thumb_proximal", "proximal_thumb"),
        ("thumb_distal", "distal_thumb"),
        ("metacarpal2", "secondmc"),
        ("proximal2", "proxph2"),
        ("middle2", "midph2"),
        ("distal2", "distph2"),
        ("metacarpal3", "thirdmc"),
        ("proximal3", "proxph3"),
        ("middle3", "midph3"),
        ("distal3", "distph3"),
        ("metacarpal4", "fourthmc"),
        ("proximal4", "proxph4"),
        ("middle4", "midph4"),
        ("distal4", "distph4"),
        ("metacarpal5", "fifthmc"),
        ("proximal5", "proxph5"),
        ("middle5", "midph5"),
        ("distal5", "distph5"),
    ];
    let bones = fixed.map(|(name, body)| bone(&m, "myohand", name, body));
    let mut poses = vec![vec![0.0; m.nq], fist(&m, 0.5), fist(&m, 1.0)];
    for joint in 0..m.nv {
        for end in m.jnt_range[joint] {
            let mut pose = vec![0.0; m.nq];
            pose[joint] = end;
            poses.push(pose);
        }
    }
    let looked = stay_outside(&m, &bones, 0.006, &poses);
    assert!(looked > 1_000_000, "{looked}");
}
