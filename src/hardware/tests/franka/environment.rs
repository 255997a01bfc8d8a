//! `hive/FrankaReach-v0` through the driver.

use super::rig::{ID, Rig, config};
use env::{Env, Options, OwnModels};
use protocol::franka::Version;
use wire::franka::Arm;

/// A policy that leads the arm to a pose above the table, and there waves with its wrist; the hand stays as it is, half open.
fn act(k: usize) -> [f64; 8] {
    let wave = 0.2 * (0.2 * k as f64).sin();
    [0.1, -0.2, 0.05, -0.1, wave, 0.1, -wave, 0.0]
}

/// Plays an episode in simulation and through the driver: joints of the simulation after every step, how far the plant's are
/// from them at most, and the rewards of both.
fn play(rig: &Rig, parameters: &str) -> (f64, [f64; 2]) {
    let mut simulated = Env::make(ID, &OwnModels, &Options::default().with_seed(3)).unwrap();
    let mut real = rig.environment(config(parameters), 3);
    simulated.reset(Some(3)).unwrap();
    real.reset(Some(3)).unwrap();
    let (mut worst, mut rewards) = (0.0_f64, [0.0; 2]);
    for k in 0..50 {
        rewards[0] += simulated.step(&act(k)).unwrap().reward;
        rewards[1] += real.step(&act(k)).unwrap().reward;
        let there = &simulated.scene().data.state.qpos;
        let here = rig.positions();
        worst = here.iter().zip(there.iter()).map(|(a, b)| (a - b).abs()).fold(worst, f64::max);
    }
    (worst, rewards)
}

#[test]
fn targets_that_leap_give_the_bits_of_the_simulation_with_doubles() {
    let rig = Rig::new(Version::V5, Arm::without_limits);
    let (worst, rewards) = play(&rig, "control = 'position', interpolation = 'none'");
    assert_eq!((worst, rewards[0].to_bits()), (0.0, rewards[1].to_bits()));
}

#[test]
fn targets_that_leap_give_the_simulation_but_for_the_rounding_of_floats() {
    let rig = Rig::new(Version::V10, Arm::without_limits);
    let (worst, rewards) = play(&rig, "control = 'position', interpolation = 'none'");
    // A reading of a few radians is rounded to 2.4e-7; each step begins from a reading.
    assert!(worst > 0.0 && worst < 50.0 * 2.4e-7, "{worst}");
    assert!((rewards[0] - rewards[1]).abs() < 1e-3, "{rewards:?}");
}

#[test]
fn a_motion_within_the_arms_limits_earns_what_the_simulation_does() {
    let rig = Rig::new(Version::V5, |arm| arm);
    let (worst, rewards) = play(&rig, "control = 'position'");
    rig.check_commands();
    // The servos of the simulation leap and swing; this motion does not, and gets to the same places.
    assert!((rewards[0] - rewards[1]).abs() < 0.05 * rewards[0].abs() && worst > 0.0, "{rewards:?}");
}
