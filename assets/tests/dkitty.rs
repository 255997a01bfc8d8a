//! The D'Kitty weighs and does what the robot does. The numbers of the README are printed by `-- --nocapture`.

mod measure;

use measure::{off, own, posed, run, stand, sweep, track};
use physics::Data;

/// Legs bent as a standing robot has them.
const BENT: [f64; 12] = [0.0, 0.5, -0.9, 0.0, 0.5, -0.9, 0.0, 0.5, -0.9, 0.0, 0.5, -0.9];
/// Weight of the robot \[N\].
const WEIGHT: f64 = 1.824 * 9.81;

#[test]
fn it_has_the_robots_mass_and_height() {
    let m = own("dkitty/scene.xml");
    let mass: f64 = m.body_mass.iter().sum();
    assert!((mass - 1.824).abs() < 1e-9, "{mass}");
    let mut d = Data::new(&m);
    physics::forward(&m, &mut d).unwrap();
    let foot = d.body(m.body("A:FR12").unwrap()).xpos()[2];
    // The last joint of a straight leg is 0.191 m below the hip, and the foot's end 0.111 m below that joint.
    assert!((0.315 - foot - 0.191).abs() < 1e-9, "{foot}");
}

#[test]
fn every_joint_moves_through_its_range_and_follows_as_softly_as_its_gains_say() {
    let m = stand("dkitty/robot.xml", "A:dkitty", "timestep='0.0025' gravity='0 0 0'", "");
    assert_eq!((m.nv, m.nu), (12, 12));
    let (short, actuator) = sweep(&m, &[0.0; 12]);
    let (off, slowest) = track(&m, &[0.0; 12]);
    println!(
        "short {short:.4} (actuator {actuator}), sine off by {off:.3} of its amplitude (actuator {slowest})"
    );
    assert!(short < 0.01);
    // Damping of 1 N m s/rad against 5 N m/rad lags by 0.2 s: 0.53 of a sine of 0.5 Hz.
    assert!(off < 0.6);
}

/// Height of the torso and its tilt after ten seconds under a load \[N\] on top of the weight, from bent legs.
fn stands(load: f64) -> (f64, f64, f64) {
    let m = own("dkitty/scene.xml");
    let torso = m.body("A:dkitty").unwrap();
    let mut d = posed(&m, &BENT);
    d.state.qpos[2] = -0.04;
    d.state.xfrc_applied[torso.index()] = [0.0, 0.0, -load, 0.0, 0.0, 0.0];
    let mut least = f64::INFINITY;
    run(&m, &mut d, 10.0, |d| least = least.min(d.body(torso).xmat()[8]));
    let sag = off(&BENT, &d.state.qpos[6..]);
    (d.body(torso).xpos()[2], least, sag)
}

#[test]
fn legs_carry_one_and_a_half_times_the_robots_weight_for_ten_seconds() {
    let (height, upright, sag) = stands(0.0);
    println!("unloaded: height {height:.3} m, upright {upright:.4}, sag {sag:.3} rad");
    assert!(height > 0.24 && upright > 0.99 && sag < 0.1);
    let (height, upright, sag) = stands(0.5 * WEIGHT);
    println!("half its weight on top: height {height:.3} m, upright {upright:.4}, sag {sag:.3} rad");
    assert!(height > 0.23 && upright > 0.99 && sag < 0.15);
}
