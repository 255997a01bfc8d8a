//! The Fetch weighs and does what the robot does. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::{drift, mobility, own, run, stand};
use physics::Data;
use physics::model::Disable;

/// The arm over the table, fingers at rest.
const READY: [f64; 7] = [0.08, -0.9, 0.0, 0.88, 0.0, 1.6, 0.0];

#[test]
fn it_has_the_robots_mass_and_reach() {
    let m = own("fetch/scene.xml");
    let base = m.body("base_link").unwrap().index();
    let mass = m.body_subtreemass[base];
    // What moves of the maker's 121.3 kg: the rest are wheels and the fixed part of the torso, as in RoboHive's model.
    assert!((mass - 98.948).abs() < 0.001, "{mass}");
    let mut d = Data::new(&m);
    physics::forward(&m, &mut d).unwrap();
    let shoulder = d.body(m.body("shoulder_pan_link").unwrap()).xpos()[1];
    let reach = d.site(m.site("grip").unwrap()).xpos()[1] - shoulder;
    assert!((reach - 1.0958).abs() < 1e-3, "{reach}");
}

#[test]
fn it_holds_its_pose_for_ten_seconds() {
    let off = drift("fetch/scene.xml", &READY, 3);
    assert!(off < 0.01);
}

#[test]
fn every_joint_of_the_arm_moves_through_its_range_and_follows_a_sine() {
    let mut m = stand("fetch/robot.xml", "base_link", "timestep='0.002'", "");
    // The whole range of the shoulder leads through the base.
    m.options_mut().disableflags |= Disable::CONTACT;
    let (short, off) = mobility(&m, &READY);
    assert!(short < 0.01);
    assert!(off < 0.05);
}

#[test]
fn the_gripper_holds_a_kilogram() {
    let block = "<body name='block' pos='0.166 0 1'><freejoint/>
        <geom type='box' size='0.02 0.025 0.02' mass='1' condim='4' friction='1'/></body>";
    let m = stand("fetch/robot.xml", "gripper_link", "timestep='0.002' cone='elliptic' impratio='10'", block);
    let mut d = Data::new(&m);
    d.state.qpos[..2].fill(0.03);
    d.state.ctrl.fill(-20.0);
    let (place, start) = (2, 1.0);
    run(&m, &mut d, 1.0, |d| {
        d.state.qpos[place..place + 7].copy_from_slice(&[0.166, 0.0, start, 1.0, 0.0, 0.0, 0.0]);
        d.state.qvel[place..].fill(0.0);
    });
    run(&m, &mut d, 10.0, |_| ());
    let height = d.state.qpos[place + 2];
    println!("with 20 N a finger it slipped by {:.1} mm in 10 s", (start - height) * 1e3);
    assert!((height - start).abs() < 0.01, "{height}");
}
