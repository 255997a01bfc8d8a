//! Episodes that controllers play.

use env::{Env, Options, OwnModels};
use robohive_control::{make, serving};

/// Plays an episode, with the controller or with zero actions: whether it was solved, and every action.
pub fn play(id: &str, seed: u64, controlled: bool) -> (bool, Vec<f64>) {
    watch(id, seed, controlled, |_| ())
}

/// The same, and shows the environment after every step.
pub fn watch(id: &str, seed: u64, controlled: bool, mut each: impl FnMut(&Env)) -> (bool, Vec<f64>) {
    let mut env = Env::make(id, &OwnModels, &Options::default()).unwrap();
    let name = serving(env.spec()).next().unwrap_or_else(|| panic!("no controller serves {id}")).name;
    let mut controller = make(name, &env).unwrap();
    let (mut action, mut given) = (vec![0.0; env.action_len()], Vec::new());
    env.reset(Some(seed)).unwrap();
    controller.reset(&env, seed).unwrap();
    loop {
        if controlled {
            controller.act(&env, &mut action).unwrap();
        }
        given.extend_from_slice(&action);
        let step = env.step(&action).unwrap();
        assert!(step.fault.is_none(), "{id}: {:?}", step.fault);
        each(&env);
        if env.verdict().solved || step.terminated || step.truncated {
            return (env.verdict().solved, given);
        }
    }
}
