//! The SO-101 weighs and does what the arm does. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::{drift, mobility, own, posed, run, stand};
use physics::math::{norm, sub};
use physics::model::Disable;
use physics::{Data, Model};

/// The gripper over the table, pointing down.
const HOME: [f64; 6] = [0.0, 0.0, 0.0, 1.57, 0.0, 0.3];
/// The forearm, level, and the wrist stretched: the most that the shoulder carries.
const OUT: [f64; 6] = [0.0, 1.57, -1.57, 0.0, 0.0, 0.0];
const ALONE: &str = "timestep='0.002' cone='elliptic' impratio='10'";

fn distance(m: &Model, d: &Data, a: &str, b: &str) -> f64 {
    norm(sub(*d.site(m.site(a).unwrap()).xpos(), *d.site(m.site(b).unwrap()).xpos()))
}

#[test]
fn it_has_the_arms_mass_and_lengths() {
    let m = stand("so101/robot.xml", "base", ALONE, "");
    let mass = m.body_subtreemass[m.body("base").unwrap().index()];
    assert!((mass - 0.632006).abs() < 1e-9, "{mass}");
    let mut d = Data::new(&m);
    physics::forward(&m, &mut d).unwrap();
    let place = |body: &str| *d.body(m.body(body).unwrap()).xpos();
    for (from, to, length) in
        [("upper_arm", "lower_arm", 0.11600), ("lower_arm", "wrist", 0.13500), ("wrist", "gripper", 0.06372)]
    {
        let found = norm(sub(place(to), place(from)));
        assert!((found - length).abs() < 1e-5, "{from}: {found}");
    }
    // The maker's description has the tool there, by its own frames.
    let tool = *d.site(m.site("gripperframe").unwrap()).xpos();
    assert!(norm(sub(tool, [0.391362, -0.000011, 1.226469])) < 2e-6, "{tool:?}");
}

#[test]
fn it_holds_poses_for_ten_seconds() {
    // Servos give way by their load over 17.8 N m/rad.
    assert!(drift("so101/scene.xml", &HOME, 0) < 0.03);
    assert!(drift("so101/scene.xml", &OUT, 0) < 0.06);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let mut m = stand("so101/robot.xml", "base", ALONE, "");
    // The whole range leads through the arm itself and the floor of its base.
    m.options_mut().disableflags |= Disable::CONTACT;
    let (short, off) = mobility(&m, &HOME);
    assert!(short < 0.02);
    assert!(off < 0.2);
}

#[test]
fn its_fingers_meet_and_open() {
    let m = stand("so101/robot.xml", "base", ALONE, "");
    let mut d = posed(&m, &HOME);
    let mut gap = |angle: f64| {
        d.state.ctrl[5] = angle;
        run(&m, &mut d, 2.0, |_| ());
        distance(&m, &d, "fixed_tip", "moving_tip")
    };
    let (open, closed) = (gap(1.74), gap(-0.1));
    println!("tips apart by {:.1} mm open, {:.1} mm closed", open * 1e3, closed * 1e3);
    assert!(open > 0.1 && closed < 0.005, "{open} {closed}");
}

#[test]
fn it_holds_a_cube_of_100_grams_against_a_pull_of_5_newtons() {
    // The gripper points along x, 126 mm above the stand and more.
    let cube = "<body name='cube' pos='0.386 0 1.2335'><freejoint/>
        <geom type='box' size='0.012 0.01 0.0115' mass='0.1' condim='4' friction='1'/></body>";
    let mut m = stand("so101/robot.xml", "base", ALONE, cube);
    let roll = m.body("gripper").unwrap().index();
    m.overwrite(|m| m.body_quat[roll] = [1.0, 0.0, 0.0, 0.0]).unwrap();
    let cube = m.body("cube").unwrap();
    let mut d = posed(&m, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.3]);
    let (start, place) = (m.body_pos[cube.index()], m.nq - 7);
    d.state.ctrl[5] = -0.17;
    run(&m, &mut d, 1.0, |d| {
        d.state.qpos[place..place + 3].copy_from_slice(&start);
        d.state.qpos[place + 3..].copy_from_slice(&[1.0, 0.0, 0.0, 0.0]);
        d.state.qvel[place..].fill(0.0);
    });
    run(&m, &mut d, 1.0, |_| ());
    let tool = m.site("gripperframe").unwrap();
    let hold = |d: &Data| sub(*d.body(cube).xpos(), *d.site(tool).xpos());
    let before = hold(&d);
    d.state.xfrc_applied[cube.index()] = [5.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    run(&m, &mut d, 5.0, |_| ());
    let slip = norm(sub(hold(&d), before));
    println!("pulled out with 5 N, a cube of 0.1 kg moved by {:.2} mm in 5 s", slip * 1e3);
    assert!(slip < 0.005, "{slip}");
}

#[test]
fn the_cube_lies_still_beside_the_arm() {
    let m = own("so101/scene.xml");
    let mut d = posed(&m, &HOME);
    let place = m.nq - 7;
    let start = m.qpos0[place..place + 3].to_vec();
    run(&m, &mut d, 5.0, |_| ());
    let off = (0..3).map(|axis| (d.state.qpos[place + axis] - start[axis]).abs()).fold(0.0, f64::max);
    assert!(off < 1e-3, "{off}");
}
