//! The Shadow hand weighs, moves and holds what the hand does. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::grips::grip;
use measure::{mobility, off, own, posed, run, stand};

/// Places of the actuators of a finger's spread, root and end, in the order FF, MF, RF, LF, after those of the wrist and the thumb.
const FINGERS: [[usize; 3]; 4] = [[7, 8, 9], [10, 11, 12], [13, 14, 15], [17, 18, 19]];
const OPTIONS: &str = "timestep='0.002' cone='elliptic' impratio='10'";

/// A pose of wrist and thumb (seven actuators), of all fingers' roots and ends, and of the bone of the little finger.
fn pose(thumb: [f64; 5], [root, end, metacarpal]: [f64; 3]) -> [f64; 20] {
    let mut pose = [0.0; 20];
    pose[2..7].copy_from_slice(&thumb);
    pose[16] = metacarpal;
    for [_, knuckle, last] in FINGERS {
        (pose[knuckle], pose[last]) = (root, end);
    }
    pose
}

#[test]
fn it_has_the_published_mass_and_lengths() {
    let m = own("shadow/robot.xml");
    let mass = |body: &str| m.body_subtreemass[m.body(body).unwrap().index()];
    assert!((mass("forearm") - 3.794).abs() < 1e-9 && (mass("wrist") - 0.794).abs() < 1e-9);
    assert_eq!((m.nv, m.nu), (24, 20));
    let mut d = posed(&m, &[0.0; 20]);
    physics::forward(&m, &mut d).unwrap();
    let along = d.site(m.site("mftip").unwrap()).xpos()[2] - d.body(m.body("palm").unwrap()).xpos()[2];
    // 99 + 45 + 25 mm to the last joint, 31.3 mm to the end of the pad.
    assert!((along - 0.2003).abs() < 1e-9, "{along}");
}

#[test]
fn a_ball_stays_in_its_palm_for_ten_seconds() {
    let m = own("shadow/scene.xml");
    let told = pose([0.3, 0.5, 0.0, 0.0, 0.2], [0.55, 1.1, 0.35]);
    let mut d = posed(&m, &told);
    let start = d.state.qpos.clone();
    run(&m, &mut d, 1.0, |_| ());
    let rested = d.state.qpos.clone();
    run(&m, &mut d, 9.0, |_| ());
    let moved = off(&rested[24..27], &d.state.qpos[24..27]);
    let joints = off(&start[..24], &d.state.qpos[..24]);
    println!("joints off by {joints:.4} rad, the ball rolls by {:.1} mm", moved * 1e3);
    assert!(joints < 0.03 && moved < 0.003);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let m = stand("shadow/robot.xml", "forearm", OPTIONS, "");
    // Every other finger is bent, so that one beside it may lean to either side.
    let mut aside = pose([0.0, 0.3, 0.0, 0.0, 0.0], [0.0, 0.2, 0.0]);
    (aside[FINGERS[1][1]], aside[FINGERS[3][1]]) = (1.2, 1.2);
    let (short, off) = mobility(&m, &aside);
    assert!(short < 0.03);
    assert!(off < 0.2);
}

#[test]
fn the_middle_joint_leads_the_last() {
    let m = stand("shadow/robot.xml", "forearm", OPTIONS, "");
    let mut d = posed(&m, &pose([0.0; 5], [0.0; 3]));
    let at = |name: &str| m.joint(m.joint(name).unwrap()).qpos_range().start;
    let (middle, last) = (at("FFJ2"), at("FFJ1"));
    let mut behind: f64 = 0.0;
    d.state.ctrl[9] = m.actuator_ctrlrange[9][1];
    run(&m, &mut d, 3.0, |d| behind = behind.max(d.state.qpos[last] - d.state.qpos[middle]));
    println!("the last joint is at most {behind:.4} rad before the middle one");
    assert!(behind < 0.02 && d.state.qpos[middle] > 1.55 && d.state.qpos[last] > 1.55);
}

#[test]
fn fingers_hold_a_can_of_300_grams_by_friction() {
    // Gravity pulls along the can, which lies across the palm.
    let can = "<body name='can' pos='0 -0.055 1.327'><freejoint/>
        <geom type='cylinder' size='0.025' fromto='-0.06 0 0 0.06 0 0' mass='0.3' condim='4'/></body>";
    let options = format!("{OPTIONS} gravity='-9.81 0 0'");
    let m = stand("shadow/robot.xml", "forearm", &options, can);
    let open = pose([1.0, 0.6, 0.0, 0.0, 0.0], [0.4, 0.6, 0.0]);
    let closed = pose([1.0, 1.1, 0.0, 0.6, 0.8], [1.4, 2.2, 0.0]);
    let found = grip(&m, &open, &closed);
    assert!(found.gives < 0.02 && found.slips < 0.01);
}
