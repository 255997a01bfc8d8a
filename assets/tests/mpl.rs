//! The MPL's arm and hand weigh, move and hold what their sources say. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::grips::grip;
use measure::{drift, mobility, own, posed, run, stand};
use physics::model::Disable;

const OPTIONS: &str = "timestep='0.002' cone='elliptic' impratio='10'";
/// The forearm level, the hand open, the thumb opposed; the key of the scene.
const READY: [f64; 17] =
    [0.1, -0.1, 0.0, 1.5, 0.0, 0.0, 0.0, 1.2, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// The roots of the four fingers among the actuators.
const ROOTS: [usize; 4] = [12, 13, 14, 16];

#[test]
fn it_has_the_masses_and_lengths_of_its_sources() {
    let m = own("mpl/robot.xml");
    let mass = |body: &str| m.body_subtreemass[m.body(body).unwrap().index()];
    let arm: f64 = [0.4303, 0.2496, 0.9367, 0.3892, 0.9306, 0.171, 0.08467, 0.03295].iter().sum();
    assert!((mass("shoulder_mount") - mass("palm") - arm).abs() < 1e-6, "{}", mass("shoulder_mount"));
    // Palm, thumb, three like fingers and the little one.
    let hand = 0.119867 + 0.0213249 + 3.0 * 0.0139299 + 0.0116046;
    assert!((mass("palm") - hand).abs() < 1e-6, "{}", mass("palm"));
    assert_eq!((m.nv, m.nu), (26, 17));
    let mut d = posed(&m, &[0.0; 17]);
    d.state.qpos[3] = 0.0;
    physics::forward(&m, &mut d).unwrap();
    let down = -d.site(m.site("middle_tip").unwrap()).xpos()[2];
    // 150.1 + 144.4 + 188.9 + 44.1 + 30 mm to the wrist's last axis, 77.9 + 18 + 43.5 + 24.5 + 25 mm to the fingertip.
    assert!((down - 0.7465).abs() < 2e-3, "{down}");
}

#[test]
fn it_holds_its_pose_for_ten_seconds() {
    assert!(drift("mpl/scene.xml", &READY, 0) < 0.02);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let mut m = stand("mpl/robot.xml", "shoulder_mount", OPTIONS, "");
    // A thumb that is swung past the palm meets the fingers.
    m.options_mut().disableflags |= Disable::CONTACT;
    let (short, off) = mobility(&m, &READY);
    assert!(short < 0.02);
    assert!(off < 0.2);
}

#[test]
fn the_arm_does_not_touch_itself() {
    let m = stand("mpl/robot.xml", "shoulder_mount", OPTIONS, "");
    for joint in 0..7 {
        let [low, high] = m.jnt_range[joint];
        for step in 0..=100 {
            let mut d = posed(&m, &READY);
            d.state.qpos[joint] = low + (high - low) * f64::from(step) / 100.0;
            physics::forward(&m, &mut d).unwrap();
            assert_eq!(d.contacts().len(), 0, "joint {joint} at {}", d.state.qpos[joint]);
        }
    }
}

#[test]
fn one_motor_bends_all_joints_of_a_finger() {
    let m = stand("mpl/robot.xml", "shoulder_mount", OPTIONS, "");
    let mut d = posed(&m, &READY);
    let at = |name: &str| m.joint(m.joint(name).unwrap()).qpos_range().start;
    let joints = ["middle_mcp", "middle_pip", "middle_dip"].map(at);
    let mut off: f64 = 0.0;
    run(&m, &mut d, 2.0, |d| {
        d.state.ctrl[ROOTS[1]] = (0.7 * d.time()).min(1.2);
        let [root, middle, end] = joints.map(|joint| d.state.qpos[joint]);
        off = off.max((middle - root).abs()).max((end - 0.7 * root).abs());
    });
    println!("coupled joints are off by at most {off:.4} rad");
    assert!(off < 0.02 && d.state.qpos[joints[0]] > 1.1);
}

#[test]
fn fingers_hold_a_can_of_300_grams_by_friction() {
    let can = "<body name='can' pos='0.358 0.003 0.722'><freejoint/>
        <geom type='cylinder' size='0.025 0.06' mass='0.3' condim='4'/></body>";
    let m = stand("mpl/robot.xml", "shoulder_mount", OPTIONS, can);
    let (mut open, mut closed) = (READY, READY);
    ROOTS.iter().for_each(|root| (open[*root], closed[*root]) = (0.3, 1.3));
    closed[7..11].copy_from_slice(&[1.5, 0.9, 0.9, 0.8]);
    let found = grip(&m, &open, &closed);
    assert!(found.gives < 0.03 && found.slips < 0.01);
}
