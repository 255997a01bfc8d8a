//! Plans over copies of the environment.

use env::{Env, Options, OwnModels};
use robohive_control::{Controller, make};

/// A box to be pushed to a target, which zero and random actions do in none of 20 episodes (validation/results/controllers.md).
const PUSH: &str = "hive/FrankaPushRandom-v0";

fn environment(id: &str) -> Env {
    Env::make(id, &OwnModels, &Options::default()).unwrap()
}

/// Plays until the task has been solved for six steps, or the episode is over: the actions, and the steps in which it was solved.
fn play(env: &mut Env, controller: &mut dyn Controller, seed: u64, most: usize) -> (Vec<f64>, usize) {
    let (mut action, mut given, mut solved) = (vec![0.0; env.action_len()], Vec::new(), 0);
    env.reset(Some(seed)).unwrap();
    controller.reset(env, seed).unwrap();
    for _ in 0..most {
        controller.act(env, &mut action).unwrap();
        given.extend_from_slice(&action);
        let step = env.step(&action).unwrap();
        assert!(step.fault.is_none(), "{:?}", step.fault);
        solved += usize::from(env.verdict().solved);
        if solved > 5 || step.terminated || step.truncated {
            break;
        }
    }
    (given, solved)
}

#[test]
fn a_box_is_pushed_by_the_reward_alone() {
    let mut env = environment(PUSH);
    let mut planner = make("push", &env).unwrap();
    let (_, solved) = play(&mut env, &mut *planner, 0, usize::MAX);
    assert!(solved > 5, "{solved}");
}

/// The plans of an episode follow from its seed, whatever was played before, and the environment is not touched by planning.
#[test]
fn episodes_repeat_and_the_environment_is_left_alone() {
    let mut env = environment("hive/FrankaReach-v0");
    let mut planner = make("planner", &env).unwrap();
    let (first, _) = play(&mut env, &mut *planner, 3, 4);
    let (other, _) = play(&mut env, &mut *planner, 4, 4);
    let (again, _) = play(&mut env, &mut *planner, 3, 4);
    assert_eq!(first, again);
    assert_ne!(first, other);
    let (mut action, before) = (vec![0.0; env.action_len()], env.world());
    planner.act(&env, &mut action).unwrap();
    assert_eq!(env.world(), before);
}
