//! The Sawyer weighs, reaches, moves and carries what the robot does. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::{drift, mobility, own, posed, run, stand};
use physics::Data;
use physics::math::distance;
use physics::model::Disable;

/// Over the table, the gripper down and half open; the key of the scene.
const READY: [f64; 8] = [0.0, -1.18, 0.0, 2.18, 0.0, 0.57, 3.316, 0.011];
const OPTIONS: &str = "timestep='0.002' cone='elliptic' impratio='10'";

#[test]
fn it_has_the_published_mass_and_link_lengths() {
    let m = own("sawyer/robot.xml");
    let mass: f64 = m.body_mass.iter().sum();
    // The description's links, and our gripper.
    assert!((mass - 20.734 - 0.48).abs() < 1e-3, "{mass}");
    let mut d = Data::new(&m);
    physics::forward(&m, &mut d).unwrap();
    let [ahead, aside, up] = *d.body(m.body("gripper").unwrap()).xpos();
    // Stretched out: 81 + 400 + 400 + 110 + 24.5 mm ahead, the bows of the arm leave 160.3 mm to the side.
    assert!((ahead - 1.0155).abs() < 1e-5 && (aside - 0.1603).abs() < 1e-5 && (up - 0.317).abs() < 1e-5);
}

#[test]
fn it_holds_its_pose_for_ten_seconds() {
    assert!(drift("sawyer/scene.xml", &READY, 0) < 1e-3);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let mut m = stand("sawyer/robot.xml", "base", OPTIONS, "");
    assert_eq!((m.nv, m.nu), (9, 8));
    // From the pose over the table, ends of ranges lead through the head.
    m.options_mut().disableflags |= Disable::CONTACT;
    let (short, off) = mobility(&m, &READY);
    assert!(short < 0.01);
    assert!(off < 0.2);
}

#[test]
fn a_stretched_arm_touches_itself_only_where_the_elbow_folds() {
    let m = stand("sawyer/robot.xml", "base", OPTIONS, "");
    let mut d = posed(&m, &[0.0, 0.0, 0.0, 0.3, 0.0, 0.3, 0.0, 0.011]);
    let start = d.state.qpos.clone();
    let mut folded: f64 = 0.0;
    for joint in 0..7 {
        let [low, high] = m.jnt_range[joint];
        for step in 0..=100 {
            let angle = low + (high - low) * f64::from(step) / 100.0;
            d.state.qpos.copy_from_slice(&start);
            d.state.qpos[joint] = angle;
            physics::forward(&m, &mut d).unwrap();
            let touches = d.contacts().len() > 0;
            assert!(!touches || joint == 3, "joint {joint} at {angle}");
            if touches && (folded == 0.0 || angle.abs() < folded) {
                folded = angle.abs();
            }
        }
    }
    println!("the elbow is folded at {folded:.2} rad");
    assert!(folded > 2.5, "{folded}");
}

#[test]
fn gripper_and_arm_carry_four_kilograms_with_the_tool() {
    let block = "<body name='block'><freejoint/>
        <geom type='box' size='.015 .015 .02' mass='3.52' condim='4' friction='1'/></body>";
    let m = stand("sawyer/robot.xml", "base", OPTIONS, block);
    let mut d = posed(&m, &READY);
    physics::forward(&m, &mut d).unwrap();
    let tool = m.site("tool").unwrap();
    let (place, turn) = (*d.site(tool).xpos(), *d.body(m.body("gripper").unwrap()).xquat());
    let start = m.nq - 7;
    d.state.qpos[start..start + 3].copy_from_slice(&place);
    d.state.qpos[start + 3..].copy_from_slice(&turn);
    d.state.qpos[7..9].fill(0.015);
    d.state.ctrl[7] = 0.0;
    run(&m, &mut d, 5.0, |_| ());
    let slip = distance(*d.body(m.body("block").unwrap()).xpos(), *d.site(tool).xpos());
    let sag = distance(*d.site(tool).xpos(), place);
    println!(
        "a block of 3.52 kg is {:.1} mm from the tool's centre after 5 s, which sinks by {:.1} mm",
        1e3 * slip,
        1e3 * sag
    );
    assert!(slip < 0.005 && sag < 0.03, "{slip} {sag}");
}
