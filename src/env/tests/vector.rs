//! Batches: what is sent and received, precision, what is refused, and faults.
#![cfg(feature = "threads")]

use robohive_env::{Autoreset, Env, EnvError, Options, OwnModels, VecEnv};

const COUNT: usize = 6;

fn envs(autoreset: Autoreset, threads: usize) -> VecEnv {
    let changes = "max_episode_steps = 7".parse().unwrap();
    let options = Options::default().with_changes(changes);
    let env = Env::make("hive/ElbowPose-v0", &OwnModels, &options).unwrap();
    VecEnv::new(&env, COUNT, autoreset, threads).unwrap()
}

/// An action for the step of an environment.
fn action(index: usize, step: usize, len: usize) -> Vec<f64> {
    (0..len).map(|k| ((index * 31 + step * 7 + k * 3) as f64).sin()).collect()
}

/// Observations and rewards of each environment, step by step, from steps of all.
fn stepped(autoreset: Autoreset, steps: usize) -> Vec<Vec<(Vec<f64>, f64)>> {
    let mut envs = envs(autoreset, 1);
    envs.reset(Some(3)).unwrap();
    let (len, width) = (envs.action_len(), envs.observation_len());
    let mut log = vec![Vec::new(); COUNT];
    for step in 0..steps {
        let actions: Vec<f64> = (0..COUNT).flat_map(|index| action(index, step, len)).collect();
        let rows = envs.step(&actions).unwrap().to_vec();
        for (index, yielded) in envs.steps().enumerate() {
            log[index].push((rows[index * width..(index + 1) * width].to_vec(), yielded.reward));
        }
    }
    log
}

/// The same from sending and receiving `batch` at a time.
fn received(autoreset: Autoreset, threads: usize, batch: usize, steps: usize) -> Vec<Vec<(Vec<f64>, f64)>> {
    let mut envs = envs(autoreset, threads);
    let (len, width) = (envs.action_len(), envs.observation_len());
    let all: Vec<_> = (0..COUNT).collect();
    let seeds: Vec<_> = all.iter().map(|&index| Some(3 + index as u64)).collect();
    envs.send_resets(&all, &seeds).unwrap();
    let (mut log, mut taken) = (vec![Vec::new(); COUNT], [0; COUNT]);
    while envs.under_way() > 0 {
        let count = batch.min(envs.under_way());
        let (mut ids, mut rows) = (vec![0; count], vec![0.0; count * width]);
        envs.receive(&mut ids, &mut rows).unwrap();
        let mut next = Vec::new();
        for (row, &index) in ids.iter().enumerate() {
            if taken[index] > 0 {
                let reward = envs.last_step(index).reward;
                log[index].push((rows[row * width..(row + 1) * width].to_vec(), reward));
            }
            if taken[index] < steps {
                next.push(index);
            }
        }
        let actions: Vec<f64> = next.iter().flat_map(|&index| action(index, taken[index], len)).collect();
        next.iter().for_each(|&index| taken[index] += 1);
        envs.send(&next, &actions).unwrap();
    }
    log
}

#[test]
fn what_is_received_is_what_stepping_all_yields() {
    for autoreset in [Autoreset::NextStep, Autoreset::SameStep] {
        let expected = stepped(autoreset, 20);
        for (threads, batch) in [(1, 1), (3, 1), (2, 2)] {
            let found = received(autoreset, threads, batch, 20);
            assert!(found == expected, "{autoreset:?}, {threads} threads, {batch} at a time");
        }
    }
}

#[test]
fn environments_that_are_under_way_are_out_of_reach() {
    let mut envs = envs(Autoreset::NextStep, 2);
    envs.reset(Some(0)).unwrap();
    let len = envs.action_len();
    let actions = vec![0.5; 2 * len];
    envs.send(&[4, 1], &actions).unwrap();
    assert!(envs.env(4).is_none() && envs.env(0).is_some());
    let text = |outcome: Result<(), EnvError>| outcome.unwrap_err().to_string();
    assert!(text(envs.send(&[4], &actions[..len])).contains("environment 4 is still under way"));
    let all = vec![0.0; COUNT * len];
    assert!(text(envs.step(&all).map(|_| ())).contains("2 environments are still under way"));
    let mut rows = vec![0.0; 3 * envs.observation_len()];
    assert!(text(envs.receive(&mut [0; 3], &mut rows)).contains("3 environments were asked for, and 2"));
    let mut ids = [0; 2];
    let two = 2 * envs.observation_len();
    envs.receive(&mut ids, &mut rows[..two]).unwrap();
    ids.sort_unstable();
    assert_eq!((ids, envs.under_way()), ([1, 4], 0));
    assert_eq!(envs.env(4).unwrap().steps(), 1);
    envs.step(&all).unwrap();
}

#[test]
fn wrong_batches_are_refused_before_anything_steps() {
    let mut envs = envs(Autoreset::NextStep, 2);
    envs.reset(Some(0)).unwrap();
    let len = envs.action_len();
    let mut actions = vec![0.0; COUNT * len];
    actions[2 * len + 1] = f64::NAN;
    let error = envs.step(&actions).map(|_| ()).unwrap_err().to_string();
    assert!(error.contains("environment 2: value 1 of the action is NaN"), "{error}");
    assert!(matches!(envs.step(&actions[1..]), Err(EnvError::ActionLength { .. })));
    for (ids, message) in [(vec![COUNT], "there is no environment 6"), (vec![0, 0], "named twice")] {
        let error = envs.send(&ids, &vec![0.0; ids.len() * len]).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
    let error = envs.send_resets(&[0, 1], &[None]).unwrap_err().to_string();
    assert!(error.contains("1 seeds for 2 environments"), "{error}");
    assert!(envs.envs().all(|env| env.steps() == 0));
}

#[test]
fn threads_end_with_environments_under_way() {
    let mut envs = envs(Autoreset::NextStep, 2);
    let all: Vec<_> = (0..COUNT).collect();
    envs.send_resets(&all, &[None; COUNT]).unwrap();
    drop(envs);
}

#[test]
fn thirty_two_bits_are_the_sixty_four_rounded() {
    let (mut wide, mut narrow) = (envs(Autoreset::NextStep, 1), envs(Autoreset::NextStep, 3));
    let len = wide.action_len();
    let mut rows = vec![0.0f32; COUNT * wide.observation_len()];
    let seeds: Vec<_> = (0..COUNT as u64).map(Some).collect();
    wide.reset(Some(0)).unwrap();
    narrow.reset_into(&seeds, &[true; COUNT], &mut rows).unwrap();
    let actions = vec![0.25f32; COUNT * len];
    for _ in 0..9 {
        let expected = wide.step(&vec![0.25; COUNT * len]).unwrap();
        let expected: Vec<_> = expected.iter().map(|&value| value as f32).collect();
        narrow.step_into(&actions, &mut rows).unwrap();
        assert_eq!(rows, expected);
    }
}

#[test]
fn what_an_episode_ended_with_is_kept() {
    let mut envs = envs(Autoreset::SameStep, 2);
    envs.reset(Some(0)).unwrap();
    let zeros = vec![0.0; COUNT * envs.action_len()];
    for step in 1..=14 {
        envs.step(&zeros).unwrap();
        let ended = step % 7 == 0;
        for index in 0..COUNT {
            assert_eq!(envs.last(index).is_some(), ended);
            assert_eq!(envs.env(index).unwrap().steps(), step % 7);
        }
        if ended {
            let last = envs.last(0).unwrap();
            assert!(last.rows["time"][0] > 0.0 && !last.terms.rows().is_empty());
            assert_eq!(last.observation.len(), envs.observation_len());
        }
    }
}
