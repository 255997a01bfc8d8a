//! The contract of an environment, on a model of our own.

use robohive_env::check::check;
use robohive_env::{Autoreset, Env, EnvError, Options, OwnModels, VecEnv};

const ID: &str = "hive/FrankaReach-v0";

fn make(changes: &str) -> Result<Env, EnvError> {
    Env::make(ID, &OwnModels, &Options::default().with_changes(changes.parse().unwrap()))
}

/// Actions that differ from step to step and from one another.
fn action(step: usize, len: usize) -> Vec<f64> {
    (0..len).map(|k| (0.7 * step as f64 + 1.3 * k as f64).sin()).collect()
}

/// Observations of `steps` steps after a seeded reset.
fn roll(env: &mut Env, seed: u64, steps: usize) -> Vec<f64> {
    let mut seen = env.reset(Some(seed)).unwrap().to_vec();
    for step in 0..steps {
        env.step(&action(step, env.action_len())).unwrap();
        seen.extend_from_slice(env.observation());
    }
    seen
}

#[test]
fn a_seed_decides_the_episode() {
    let mut env = make("").unwrap();
    let first = roll(&mut env, 5, 20);
    assert_eq!(first, roll(&mut env, 5, 20));
    assert_eq!(first, roll(&mut make("").unwrap(), 5, 20));
    let other = roll(&mut env, 6, 20);
    let target = |seen: &[f64]| seen[..env.observation().len()].to_vec();
    assert_ne!(target(&first), target(&other), "another seed draws another target");
    assert!(first.iter().all(|value| value.is_finite()));
    let len = env.observation().len();
    assert!((0..9).all(|joint| (first[joint] - first[20 * len + joint]).abs() > 1e-4), "every joint moves");
}

#[test]
fn an_episode_is_truncated_at_its_length() {
    let mut env = make("max_episode_steps = 7").unwrap();
    env.reset(Some(1)).unwrap();
    for step in 0..7 {
        let outcome = env.step(&action(step, env.action_len())).unwrap();
        assert_eq!((outcome.truncated, outcome.terminated), (step == 6, false));
        assert!(outcome.reward < 0.0 && outcome.reward == env.dense());
    }
}

#[test]
fn a_saved_state_continues_exactly() {
    let mut env = make("").unwrap();
    roll(&mut env, 3, 10);
    let saved = env.state();
    let go_on = |env: &mut Env| -> Vec<f64> {
        let mut seen = env.observation().to_vec();
        for step in 0..15 {
            env.step(&action(3 * step, env.action_len())).unwrap();
            seen.extend_from_slice(env.observation());
        }
        seen.extend_from_slice(env.reset(None).unwrap());
        seen
    };
    let there = go_on(&mut env);
    env.set_state(&saved).unwrap();
    assert_eq!(env.steps(), 10);
    assert_eq!(there, go_on(&mut env));
    let mut fresh = make("").unwrap();
    fresh.set_state(&saved).unwrap();
    assert_eq!(there, go_on(&mut fresh));
}

#[test]
fn a_recorded_state_is_observed_again() {
    let mut env = make("").unwrap();
    roll(&mut env, 3, 10);
    let (world, seen, dense) = (env.world(), env.observation().to_vec(), env.dense());
    roll(&mut env, 4, 5);
    assert_ne!(seen, env.observation());
    assert_eq!(env.set_world(&world).unwrap(), seen);
    assert_eq!(env.dense(), dense);
    let mut wrong = world;
    wrong.qpos = Some(vec![0.0; 3]);
    assert!(env.set_world(&wrong).unwrap_err().to_string().contains("qpos has 3 values"));
}

#[test]
fn paths_are_rewarded_from_observations() {
    let mut env = make("").unwrap();
    let seen = roll(&mut env, 3, 3);
    let last = env.dense();
    let rewards = env.path_rewards(&seen).unwrap();
    assert_eq!(rewards.len(), 4);
    assert_eq!((rewards[2].dense, rewards[3].dense), (last, last));
    let blind = make("obs_keys = ['time', 'time']").unwrap();
    assert_eq!(blind.observation().len(), 2);
    assert!(blind.path_rewards(&[0.0, 0.0]).unwrap_err().to_string().contains("reach"));
}

#[test]
fn bad_actions_are_refused() {
    let mut env = make("").unwrap();
    env.reset(None).unwrap();
    let mut bad = vec![0.0; env.action_len()];
    bad[2] = f64::NAN;
    assert!(env.step(&bad).unwrap_err().to_string().contains("value 2 of the action is NaN"));
    assert!(env.step(&bad[..3]).unwrap_err().to_string().contains("8 values here, and 3"));
    assert_eq!(env.steps(), 0);
}

#[test]
fn a_step_that_physics_refuses_truncates() {
    let mut env = make("").unwrap();
    env.reset(Some(1)).unwrap();
    let mut world = env.world();
    world.qvel.as_mut().unwrap()[0] = 1e9;
    env.set_world(&world).unwrap();
    let zero = vec![0.0; env.action_len()];
    let step = env.step(&zero).unwrap();
    assert!(step.truncated && !step.terminated && step.fault.is_some(), "{step:?}");
    assert_eq!(env.faults(), 1);
    assert!(matches!(env.step(&zero), Err(EnvError::NeedsReset)));
    env.reset(None).unwrap();
    assert!(env.step(&zero).unwrap().fault.is_none());
}

#[test]
fn wrong_settings_are_named() {
    for (changes, text) in [
        ("colour = 1", "colour"),
        ("target_site_name = 'targt'", "target"),
        ("obs_keys = ['qp']", "qp_robot"),
        ("weighted_reward_keys = { reech = 1 }", "reech"),
        ("frame_skip = 0", "1 or more"),
        ("frame_skip = 'x'", "frame_skip"),
        ("target_xyz_range = { low = [1, 2], high = [1, 2, 3] }", "3 numbers"),
        ("visual_keys = ['rgb:nowhere:2x2:2d']", "front"),
        ("act_mode = 'force'", "pos, vel or torque"),
        ("model_path = 'hive/nothing.xml'", "franka/tasks/reach.xml"),
    ] {
        let error = make(changes).err().unwrap_or_else(|| panic!("{changes} is accepted")).to_string();
        assert!(error.contains(text), "{changes}: {error}");
    }
}

#[test]
fn the_contract_is_kept() {
    let mut env = make("").unwrap();
    let report = check(&mut env, 11, 60).unwrap();
    assert_eq!(report.violations, []);
    assert_eq!((report.steps, report.terminated), (50, 0), "the whole episode");
}

#[test]
fn threads_change_no_bit() {
    let env = make("max_episode_steps = 9").unwrap();
    let run = |threads| {
        let mut envs = VecEnv::new(&env, 5, Autoreset::NextStep, threads).unwrap();
        let mut seen = envs.reset(Some(40)).unwrap().to_vec();
        let len = env.action_len();
        for step in 0..25 {
            let actions: Vec<f64> = (0..5).flat_map(|k| action(step + 100 * k, len)).collect();
            seen.extend_from_slice(envs.step(&actions).unwrap());
        }
        seen
    };
    let one = run(1);
    assert_eq!(one, run(3));
    let mut alone = env.fork().unwrap();
    alone.reset(Some(42)).unwrap();
    alone.step(&action(200, env.action_len())).unwrap();
    let width = env.observation().len();
    assert_eq!(alone.observation(), &one[(5 + 2) * width..(5 + 3) * width]);
}

#[test]
fn the_three_ways_of_resetting() {
    let env = make("max_episode_steps = 2").unwrap();
    let zero = vec![0.0; env.action_len()];
    let run = |mode| {
        let mut envs = VecEnv::new(&env, 1, mode, 1).unwrap();
        envs.reset(Some(1)).unwrap();
        let mut log = Vec::new();
        for _ in 0..4 {
            if envs.step(&zero).is_err() {
                break;
            }
            let step = envs.steps().next().unwrap().clone();
            let env = envs.envs().next().unwrap();
            log.push((step.truncated, env.steps(), envs.final_observation(0).is_some()));
        }
        log
    };
    assert_eq!(
        run(Autoreset::NextStep),
        [(false, 1, false), (true, 2, false), (false, 0, false), (false, 1, false)]
    );
    assert_eq!(
        run(Autoreset::SameStep),
        [(false, 1, false), (true, 0, true), (false, 1, false), (true, 0, true)]
    );
    assert_eq!(
        run(Autoreset::Disabled),
        [(false, 1, false), (true, 2, false), (true, 3, false), (true, 4, false)]
    );
}
