//! The D'Hand weighs, moves and holds what its motors allow. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::grips::grip;
use measure::{drift, mobility, own, posed, scene, stand};
use physics::model::Disable;

const OPTIONS: &str = "timestep='0.0025' cone='elliptic' impratio='10'";

/// The same angles in all four fingers.
fn all(finger: [f64; 4]) -> [f64; 16] {
    std::array::from_fn(|i| finger[i % 4])
}

#[test]
fn it_consists_of_four_fingers_of_the_dclaw() {
    let m = own("dhand/robot.xml");
    let mass: f64 = m.body_mass.iter().sum();
    // The plate, and four fingers of a base, three servos with their brackets, and a tip.
    assert!((mass - 0.2 - 4.0 * (0.093 + 3.0 * 0.105 + 0.032)).abs() < 1e-9, "{mass}");
    let mut d = posed(&m, &[0.0; 16]);
    physics::forward(&m, &mut d).unwrap();
    for tip in ["thtip", "fftip", "mftip", "rftip"] {
        let up = d.site(m.site(tip).unwrap()).xpos()[2];
        assert!((up - (0.003 + 0.01425 + 0.0675 + 2.0 * 0.068 + 0.084)).abs() < 1e-9, "{tip}: {up}");
    }
}

#[test]
fn it_holds_its_pose_for_ten_seconds() {
    assert!(drift("dhand/scene.xml", &all([0.0, -0.9, 1.0, 0.7]), 0) < 0.03);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let mut m = stand("dhand/robot.xml", "dhand", OPTIONS, "");
    assert_eq!((m.nv, m.nu), (16, 16));
    // Fingers and thumb meet in the middle of their ranges.
    m.options_mut().disableflags |= Disable::CONTACT;
    let (short, off) = mobility(&m, &all([0.0, -0.5, 0.5, 0.4]));
    assert!(short < 0.03);
    assert!(off < 0.2);
}

#[test]
fn fingers_beside_each_other_do_not_touch() {
    let m = stand("dhand/robot.xml", "dhand", OPTIONS, "");
    for sideways in [-0.26, 0.26] {
        // Every other finger is bent outwards, and one beside it leans to either side.
        let mut pose = all([0.0, -0.2, 0.4, 0.4]);
        (pose[5], pose[13]) = (-1.3, -1.3);
        for finger in 0..4 {
            let mut leaning = pose;
            leaning[4 * finger] = sideways;
            let mut d = posed(&m, &leaning);
            physics::forward(&m, &mut d).unwrap();
            assert_eq!(d.contacts().len(), 0, "finger {finger} at {sideways}");
        }
    }
}

#[test]
fn fingers_hold_a_bar_of_300_grams_by_friction() {
    // Fingers down; gravity pulls along the bar.
    let m = scene(&format!(
        "<mujoco><compiler autolimits='true'/><option {OPTIONS} gravity='9.81 0 0'/>
           <asset><model name='robot' file='dhand/robot.xml'/></asset>
           <worldbody><frame pos='0 0 1' quat='0 1 0 0'><attach model='robot' body='dhand' prefix=''/></frame>
             <body name='bar' pos='0 0.0065 0.8'><freejoint/>
               <geom type='cylinder' size='0.03' fromto='-0.12 0 0 0.12 0 0' mass='0.3' condim='4'/></body></worldbody>
         </mujoco>"
    ));
    // The middle finger is bent less: it meets the thumb.
    let mut closed = all([0.0, 0.5, 0.9, 1.1]);
    closed[4..8].copy_from_slice(&[0.0, 0.1, 0.9, 0.7]);
    let found = grip(&m, &all([0.0, -0.7, 0.8, 0.6]), &closed);
    assert!(found.gives < 0.03 && found.slips < 0.005);
}
