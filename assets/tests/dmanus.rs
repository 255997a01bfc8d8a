//! D'Manus weighs, moves and holds what the hand does, alone and on the Panda. The numbers of the README are printed by
//! `-- --nocapture`.

mod measure;

use measure::{own, posed, run, stand, sweep, track};
use physics::Data;
use physics::math::{norm, sub};
use physics::model::Disable;

/// Fingers half bent, the thumb aside.
const REST: [f64; 10] = [-0.3, 0.5, 0.5, 0.5, 0.0, 0.6, 0.6, 0.0, 0.6, 0.6];
/// The arm over the table.
const READY: [f64; 7] = [0.0, 0.2, 0.0, -1.9, 0.0, 2.1, 0.785];

#[test]
fn it_has_its_mass_and_moves_through_its_ranges() {
    let mut m = stand("dmanus/hand.xml", "ee_mount", "timestep='0.002'", "");
    let mass = m.body_subtreemass[m.body("ee_mount").unwrap().index()];
    assert!((mass - 1.504).abs() < 0.001, "{mass}");
    // Fingers and thumb meet in the middle of their ranges.
    m.options_mut().disableflags |= Disable::CONTACT;
    let (short, actuator) = sweep(&m, &REST);
    let (off, slowest) = track(&m, &REST);
    println!(
        "{mass:.3} kg, short {short:.4} (actuator {actuator}), sine off by {off:.3} (actuator {slowest})"
    );
    assert!(short < 0.05);
    // The servos damp the absolute velocity by 1 N m s/rad to 5 N m/rad: a lag of 0.2 s, which is 0.53 of the amplitude.
    assert!(off < 0.7);
}

#[test]
fn on_the_panda_it_holds_its_pose_for_ten_seconds() {
    let m = own("dmanus/scene.xml");
    let pose: Vec<f64> = READY.into_iter().chain(REST).collect();
    let mut d = posed(&m, &pose);
    run(&m, &mut d, 10.0, |_| ());
    let off = |joints: std::ops::Range<usize>| {
        joints.map(|joint| (pose[joint] - d.state.qpos[joint]).abs()).fold(0.0, f64::max)
    };
    println!("the arm is off by {:.4} rad after 10 s, the hand by {:.4} rad", off(0..7), off(7..17));
    assert!(off(0..7) < 0.01 && off(7..17) < 0.08);
}

#[test]
fn two_fingers_hold_a_cylinder_of_300_grams_by_friction() {
    // Gravity pulls along the cylinder, which lies across the palm. The mount is turned by -45 degrees, as on the Panda's flange.
    let cylinder = "<body name='cylinder' pos='-0.0375 -0.0375 1.203'><freejoint/>
        <geom type='cylinder' size='0.024' fromto='-0.0566 0.0566 0 0.0566 -0.0566 0' mass='0.3' condim='4'/></body>";
    let options = "timestep='0.002' cone='elliptic' impratio='10' gravity='6.937 -6.937 0'";
    let m = stand("dmanus/hand.xml", "ee_mount", options, cylinder);
    let cylinder = m.body("cylinder").unwrap();
    let mut d = Data::new(&m);
    d.state.ctrl.copy_from_slice(&[0.0, 0.0, 0.0, 0.0, 0.0, 1.1, 1.65, 0.0, 1.1, 1.65]);
    let place = d.state.qpos.len() - 7;
    let start = m.body_pos[cylinder.index()];
    run(&m, &mut d, 1.5, |d| {
        d.state.qpos[place..place + 3].copy_from_slice(&start);
        d.state.qpos[place + 3..].copy_from_slice(&[1.0, 0.0, 0.0, 0.0]);
        d.state.qvel[place..].fill(0.0);
    });
    run(&m, &mut d, 1.0, |_| ());
    let grasped = *d.body(cylinder).xpos();
    run(&m, &mut d, 10.0, |_| ());
    let slip = norm(sub(*d.body(cylinder).xpos(), grasped));
    println!(
        "grasped {:.1} mm from where it was held, the cylinder slips by {:.2} mm in 10 s",
        norm(sub(grasped, start)) * 1e3,
        slip * 1e3
    );
    assert!(norm(sub(grasped, start)) < 0.03 && slip < 0.005);
}
