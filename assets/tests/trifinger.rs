//! TriFinger weighs and does what the robot does. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::{drift, mobility, own, posed, slip, stand};
use physics::Data;

/// How the robot starts: knees outwards, tips near the middle.
const NOMINAL: [f64; 9] = [0.0, 0.9, -1.7, 0.0, 0.9, -1.7, 0.0, 0.9, -1.7];

#[test]
fn its_fingers_have_their_mass_and_length() {
    let m = own("trifinger/scene.xml");
    let fingers: f64 =
        (0..m.nbody).filter(|body| m.body_dofnum[*body] > 0).map(|body| m.body_mass[body]).sum();
    assert!((fingers - 3.0 * 0.62521).abs() < 1e-9, "{fingers}");
    let mut d = posed(&m, &[0.0; 9]);
    physics::forward(&m, &mut d).unwrap();
    for tip in ["finger_tip_0", "finger_tip_120", "finger_tip_240"] {
        let z = d.site(m.site(tip).unwrap()).xpos()[2];
        assert!((0.87 + 0.29 - z - 0.32).abs() < 1e-9, "{tip}: {z}");
    }
}

#[test]
fn a_task_can_turn_the_cubes_target() {
    let mut m = own("trifinger/tasks/reorient.xml");
    let target = m.site("target").unwrap();
    let quat = [0.0, 0.0, 1.0, 0.0];
    m.overwrite(|m| m.site_quat[target.index()] = quat).unwrap();
    let mut d = Data::new(&m);
    physics::forward(&m, &mut d).unwrap();
    assert!((d.site(target).xmat()[0] + 1.0).abs() < 1e-12);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let m = stand("trifinger/robot.xml", "trifinger", "timestep='0.002'", "");
    assert_eq!((m.nv, m.nu), (9, 9));
    let (short, off) = mobility(&m, &NOMINAL);
    // Friction of 2 N m against 20 N m/rad leaves 0.1 rad, and weight adds to it.
    assert!(short < 0.13);
    assert!(off < 0.65);
}

#[test]
fn it_holds_its_pose_for_ten_seconds() {
    let off = drift("trifinger/scene.xml", &NOMINAL, 0);
    assert!(off < 0.05);
}

#[test]
fn fingers_hold_a_cylinder_of_300_grams_by_friction() {
    let cylinder = "<body name='cylinder' pos='0 0 1.04'><freejoint/>
        <geom type='cylinder' size='0.0325 0.05' mass='0.3' condim='4' friction='1'/></body>";
    let options = "timestep='0.002' cone='elliptic' impratio='10'";
    let m = stand("trifinger/robot.xml", "trifinger", options, cylinder);
    let pose = |bent: f64| [0.35, 0.7, bent, 0.35, 0.7, bent, 0.35, 0.7, bent];
    let mut d = posed(&m, &pose(-1.4));
    d.state.ctrl.copy_from_slice(&pose(-1.75));
    let slip = slip(&m, &mut d, 1.04, 2.0);
    assert!(slip < 0.01, "{slip}");
}
