//! Poses of arms and of a crouched D'Kitty: the controller takes them, doing nothing does not, and episodes repeat.

use env::{Env, Options, OwnModels};
use robohive_control::make;

/// In how many of an episode's steps the task is solved, and every action.
fn play(id: &str, seed: u64, controlled: bool) -> (usize, Vec<f64>) {
    let mut env = Env::make(id, &OwnModels, &Options::default()).unwrap();
    let mut controller = make("servo_pose", &env).unwrap();
    let (mut action, mut given, mut count) = (vec![0.0; env.action_len()], Vec::new(), 0);
    env.reset(Some(seed)).unwrap();
    controller.reset(&env, seed).unwrap();
    loop {
        if controlled {
            controller.act(&env, &mut action).unwrap();
        }
        given.extend_from_slice(&action);
        let step = env.step(&action).unwrap();
        assert!(step.fault.is_none(), "{id}: {:?}", step.fault);
        count += usize::from(env.verdict().solved);
        if step.terminated || step.truncated {
            return (count, given);
        }
    }
}

/// A success is more than five solved steps.
#[test]
fn servos_take_their_poses_and_doing_nothing_does_not() {
    let least = [
        ("hive/rpFrankaDmanusPoseFixed-v0", 20),
        ("hive/rpFrankaRobotiqPoseFixed-v0", 20),
        ("hive/DKittyStandFixed-v0", 10),
    ];
    for (id, least) in least {
        let (solved, actions) = play(id, 0, true);
        assert!(solved >= least, "{id} is solved in {solved} steps");
        assert!(actions == play(id, 0, true).1, "{id} acts otherwise in the same episode");
        assert_eq!(play(id, 0, false).0, 0, "{id} is solved by zero actions");
    }
}
