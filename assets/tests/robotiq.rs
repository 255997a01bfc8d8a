//! The Robotiq 2F-85 weighs, opens and holds what the gripper does, alone and on the Panda. The numbers of the README are printed by
//! `-- --nocapture`.

mod measure;

use measure::{drift, own, run, stand, sweep, track};
use physics::math::{norm, sub};
use physics::model::Disable;
use physics::{Data, Model};

/// The arm over the table, the gripper open and pointing down.
const READY: [f64; 8] = [0.0, 0.2, 0.0, -1.9, 0.0, 2.1, 0.785, 0.0];
/// The gripper alone: its mount is turned as on the Panda's flange.
const ALONE: &str = "timestep='0.002' cone='elliptic' impratio='10'";
const TURN: &str = "quat='0.9238795325112867 0 0 -0.3826834323650898'";

/// Distance between the faces of two pads at their middle \[m\].
fn opening(m: &Model, d: &Data) -> f64 {
    let middle = |side: &str| {
        let [near, far] = ["near", "far"]
            .map(|part| d.geom(m.geom(&format!("robotiq_2f_85_{side}_pad_{part}")).unwrap()).xpos());
        [0, 1, 2].map(|axis| (near[axis] + far[axis]) / 2.0)
    };
    norm(sub(middle("right"), middle("left"))) - 0.008
}

#[test]
fn it_has_the_grippers_mass_and_stroke() {
    let m = stand("robotiq/gripper.xml", "ee_mount", ALONE, "");
    let mass = m.body_subtreemass[m.body("ee_mount").unwrap().index()];
    assert!((mass - 1.05).abs() < 0.001, "{mass}");
    let mut d = Data::new(&m);
    physics::forward(&m, &mut d).unwrap();
    let open = opening(&m, &d);
    d.state.ctrl[0] = 1.0;
    run(&m, &mut d, 2.0, |_| ());
    let closed = opening(&m, &d);
    println!("{mass:.3} kg, open {:.1} mm, closed {:.1} mm", open * 1e3, closed * 1e3);
    assert!((open - 0.085).abs() < 0.001 && closed.abs() < 0.002, "{open} {closed}");
}

#[test]
fn the_four_bars_stay_together_and_the_pads_parallel() {
    let m = stand("robotiq/gripper.xml", "ee_mount", ALONE, "");
    let mut d = Data::new(&m);
    let (mut apart, mut tilt) = (0.0_f64, 0.0_f64);
    run(&m, &mut d, 4.0, |d| {
        d.state.ctrl[0] = 0.19 * d.time();
        for side in [0, 3] {
            tilt = tilt.max((d.state.qpos[side] + d.state.qpos[side + 1]).abs());
        }
        apart = apart.max((d.state.qpos[0] - d.state.qpos[3]).abs());
        // Both bars turn alike, but for what their pins are apart from a parallelogram.
        apart = apart.max((d.state.qpos[0] - d.state.qpos[2]).abs());
    });
    println!("bars apart by {apart:.4} rad, pads tilted by {tilt:.4} rad");
    assert!(apart < 0.02 && tilt < 0.04);
}

#[test]
fn it_holds_a_cube_against_a_pull_of_20_newtons() {
    // The cube is slippery: the friction is that of the pads.
    let cube = format!(
        "<body name='cube' pos='0 0 1.251' {TURN}><freejoint/>
           <geom type='box' size='0.02 0.02 0.02' mass='0.1' condim='4' friction='0.1 0.005 0.0001'/></body>"
    );
    let m = stand("robotiq/gripper.xml", "ee_mount", ALONE, &cube);
    let cube = m.body("cube").unwrap();
    for (name, pull) in [("out of the fingers", [0.0, 0.0, 20.0]), ("sideways", [14.142, 14.142, 0.0])] {
        let mut d = Data::new(&m);
        d.state.ctrl[0] = 1.0;
        let start = m.body_pos[cube.index()];
        let place = d.state.qpos.len() - 7;
        let pose: Vec<f64> = start.into_iter().chain(m.body_quat[cube.index()]).collect();
        run(&m, &mut d, 1.0, |d| {
            d.state.qpos[place..].copy_from_slice(&pose);
            d.state.qvel[place - 1..].fill(0.0);
        });
        d.state.xfrc_applied[cube.index()] = [pull[0], pull[1], pull[2], 0.0, 0.0, 0.0];
        run(&m, &mut d, 5.0, |_| ());
        let slip = norm(sub(*d.body(cube).xpos(), start));
        println!("pulled {name} with 20 N, the cube moved by {:.2} mm in 5 s", slip * 1e3);
        assert!(slip < 0.005, "{name}: {slip}");
    }
}

#[test]
fn on_the_panda_it_holds_its_pose_for_ten_seconds() {
    let off = drift("robotiq/scene.xml", &READY, 0);
    assert!(off < 0.005);
}

#[test]
fn the_arm_moves_through_its_range_and_all_servos_follow_a_sine() {
    let mut m = own("robotiq/scene.xml");
    // The whole range leads through the table and the arm itself.
    m.options_mut().disableflags |= Disable::CONTACT;
    let (short, actuator) = sweep(&m, &READY[..7]);
    let (off, slowest) = track(&m, &READY);
    println!(
        "short {short:.4} (actuator {actuator}), sine off by {off:.3} of its amplitude (actuator {slowest})"
    );
    assert!(short < 0.02);
    // The servos damp the absolute velocity, joint 7 by 10 N m s/rad to 50 N m/rad: a lag of 0.2 s, which is 0.53 of the amplitude.
    assert!(off < 0.6);
}
