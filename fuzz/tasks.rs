//! Environments: settings of users, and policies read from files, which act in one.

use agents::Policy;
use env::{Arguments, Env, Options, OwnModels, Registry};

/// Most time steps in a step of an environment that is stepped: more take too long for an input.
const MOST_STEPS: usize = 40;

/// A byte that chooses one of the environments on models of our own, then settings as TOML. What can be made is reset and
/// stepped.
pub fn settings(data: &[u8]) {
    let [choice, text @ ..] = data else { return };
    let ids: Vec<_> = Registry::builtin().specs().iter().filter(|spec| spec.suite == "hive").collect();
    let Some(changes) = std::str::from_utf8(text).ok().and_then(|text| text.parse::<Arguments>().ok()) else {
        return;
    };
    // Not the files of this machine.
    if changes.get::<String>("model_path").is_some_and(|path| path.starts_with('/')) {
        return;
    }
    let _ = changes.to_string().parse::<Arguments>().expect("settings are written as they are read");
    let id = &ids[usize::from(*choice) % ids.len()].id;
    let Ok(mut env) = Env::make(id, &OwnModels, &Options::default().with_changes(changes)) else { return };
    if env.frame_skip() > MOST_STEPS || env.reset(Some(1)).is_err() {
        return;
    }
    let observed = env.observation().len();
    for value in [0.5, -1.0] {
        if env.step(&vec![value; env.action_len()]).is_err() {
            return;
        }
        assert_eq!(env.observation().len(), observed);
    }
}

thread_local! {
    static ELBOW: Env = {
        let mut env = Env::make("hive/ElbowPose-v0", &OwnModels, &Options::default()).expect("it is our own");
        env.reset(Some(1)).expect("it can be reset");
        env
    };
}

/// The file of a policy. One that fits the environment acts in it.
pub fn policy(data: &[u8]) {
    if let Ok(policy) = Policy::parse(data) {
        ELBOW.with(|env| act(policy, env));
    }
}

fn act(mut policy: Policy, env: &Env) {
    let mut action = vec![0.0; env.action_len()];
    if policy.action(env, &mut action).is_ok()
        && let Ok(mut env) = env.fork()
    {
        let _ = env.step(&action);
    }
}
