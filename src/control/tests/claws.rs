//! ROBEL's claw: its controllers solve the tasks, and their episodes repeat.

mod playing;

use env::{Env, Options, OwnModels};
use playing::play;
use robohive_control::{make, serving};

/// In how many of an episode's steps the task is solved.
fn solved(id: &str, seed: u64) -> usize {
    let mut env = Env::make(id, &OwnModels, &Options::default()).unwrap();
    let mut controller = make(serving(env.spec()).next().unwrap().name, &env).unwrap();
    let (mut action, mut count) = (vec![0.0; env.action_len()], 0);
    env.reset(Some(seed)).unwrap();
    controller.reset(&env, seed).unwrap();
    loop {
        controller.act(&env, &mut action).unwrap();
        let step = env.step(&action).unwrap();
        assert!(step.fault.is_none(), "{id}: {:?}", step.fault);
        count += usize::from(env.verdict().solved);
        if step.terminated || step.truncated {
            return count;
        }
    }
}

/// A success is more than five solved steps; doing nothing solves as many of a screw, whose mark starts where the valve is.
#[test]
fn claws_pose_turn_and_screw() {
    let most = [
        ("hive/DClawPoseFixed-v0", 60),
        ("hive/DClawPoseRandom-v0", 70),
        ("hive/DClawTurnFixed-v0", 6),
        ("hive/DClawTurnRandom-v0", 6),
        ("hive/DClawScrewFixed-v0", 50),
        ("hive/DClawScrewRandom-v0", 40),
    ];
    for (id, least) in most {
        let counts: Vec<_> = (3..6).map(|seed| solved(id, seed)).collect();
        assert!(counts.iter().all(|&count| count >= least), "{id} is solved in {counts:?} steps");
    }
}

#[test]
fn actions_repeat_and_stay_within_bounds() {
    for id in ["hive/DClawPoseRandom-v0", "hive/DClawTurnRandom-v0"] {
        let (_, first) = play(id, 3, true);
        assert!(first.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(first == play(id, 3, true).1, "{id} acts otherwise in the same episode");
    }
}
