//! Arms at tables: their controllers solve the tasks, doing nothing does not, and their episodes repeat.

use env::{Env, Options, OwnModels, Registry};
use robohive_control::{make, serving};

/// Plays an episode, with the controller or with zero actions: whether it was solved, and every action.
fn play(id: &str, seed: u64, controlled: bool) -> (bool, Vec<f64>) {
    let mut env = Env::make(id, &OwnModels, &Options::default()).unwrap();
    let name = serving(env.spec()).next().unwrap_or_else(|| panic!("no controller serves {id}")).name;
    let mut controller = make(name, &env).unwrap();
    let (mut action, mut given) = (vec![0.0; env.action_len()], Vec::new());
    env.reset(Some(seed)).unwrap();
    controller.reset(&env, seed).unwrap();
    loop {
        if controlled {
            controller.act(&env, &mut action).unwrap_or_else(|error| panic!("{id}, seed {seed}: {error}"));
        }
        given.extend_from_slice(&action);
        let step = env.step(&action).unwrap();
        assert!(step.fault.is_none(), "{id}: {:?}", step.fault);
        if env.verdict().solved || step.terminated || step.truncated {
            return (env.verdict().solved, given);
        }
    }
}

fn ids() -> Vec<String> {
    let specs = Registry::builtin().specs().iter();
    specs.filter(|spec| spec.suite == "tabletop").map(|spec| spec.id.clone()).collect()
}

#[test]
fn every_task_is_solved_by_its_controller_and_not_by_doing_nothing() {
    for id in ids() {
        let solved = (0..3).filter(|&seed| play(&id, seed, true).0).count();
        assert!(solved >= 2, "{id}: {solved} of 3 are solved");
        assert!(!play(&id, 0, false).0, "{id} is solved by zero actions");
    }
}

#[test]
fn actions_repeat_and_stay_within_bounds() {
    for id in ids().iter().filter(|id| id.starts_with("hive/Panda")) {
        let (_, first) = play(id, 3, true);
        assert!(first.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(first == play(id, 3, true).1, "{id} acts otherwise in the same episode");
    }
}

#[test]
fn the_panda_carries_its_object_into_the_other_bin() {
    let id = "hive/FrankaPickPlaceFixed-v0";
    assert!(play(id, 0, true).0 && !play(id, 0, false).0, "{id}");
}

/// Its arm starts straight, and searches from there end with the elbow in the table.
#[test]
fn the_fetch_reaches_over_its_table() {
    for id in ["hive/FetchReachFixed-v0", "hive/FetchReachRandom-v0"] {
        let solved = (0..5).filter(|&seed| play(id, seed, true).0).count();
        assert_eq!(solved, 5, "{id}");
    }
}
