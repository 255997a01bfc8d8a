//! The Allegro hand weighs, moves and holds what the hand does. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::grips::grip;
use measure::{drift, mobility, own, posed, stand};

/// Fingers slightly bent, the thumb opposed, as in the key of the scene.
const OPEN: [f64; 16] = [0.0, 0.2, 0.2, 0.2, 0.0, 0.2, 0.2, 0.2, 0.0, 0.2, 0.2, 0.2, 0.9, 0.3, 0.3, 0.3];
/// Round a can.
const CLOSED: [f64; 16] = [0.0, 1.1, 1.0, 0.8, 0.0, 1.1, 1.0, 0.8, 0.0, 1.1, 1.0, 0.8, 1.2, 0.5, 0.7, 0.7];

#[test]
fn it_has_the_published_mass_and_lengths() {
    let m = own("allegro/robot.xml");
    let mass: f64 = m.body_mass.iter().sum();
    assert!((mass - 0.6445).abs() < 1e-3, "{mass}");
    let mut d = posed(&m, &[0.0; 16]);
    physics::forward(&m, &mut d).unwrap();
    let [_, across, along] = *d.site(m.site("mftip").unwrap()).xpos();
    // 0.7 + 16.4 + 54 + 38.4 mm to the last joint, 41 mm to the end of the rubber.
    assert!((along - 0.1505).abs() < 1e-9 && across.abs() < 1e-9, "{along} {across}");
}

#[test]
fn it_holds_its_pose_for_ten_seconds() {
    assert!(drift("allegro/scene.xml", &OPEN, 0) < 0.03);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let m = stand("allegro/robot.xml", "palm", "timestep='0.002' cone='elliptic' impratio='10'", "");
    assert_eq!((m.nv, m.nu), (16, 16));
    let (short, off) = mobility(&m, &OPEN);
    assert!(short < 0.02);
    assert!(off < 0.2);
}

#[test]
fn fingers_hold_a_can_of_300_grams_by_friction() {
    // Gravity pulls along the can, which lies across the palm.
    let can = "<body name='can' pos='0.03 0 1.063'><freejoint/>
        <geom type='cylinder' size='0.025' fromto='0 -0.06 0 0 0.06 0' mass='0.3' condim='4'/></body>";
    let options = "timestep='0.002' cone='elliptic' impratio='10' gravity='0 -9.81 0'";
    let m = stand("allegro/robot.xml", "palm", options, can);
    let found = grip(&m, &OPEN, &CLOSED);
    assert!(found.gives < 0.02 && found.slips < 0.005);
}
