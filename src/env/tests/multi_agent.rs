//! Environments of several agents, agent by agent and as one.

use robohive_env::team::Stakes;
use robohive_env::{AssetError, Assets, Env, MultiEnv, Options, OwnModels, Registry};
use std::path::PathBuf;
use std::sync::Arc;

fn ids() -> Vec<&'static str> {
    let specs = Registry::builtin().specs().iter();
    specs.filter(|spec| spec.suite == "multi_agent").map(|spec| &*spec.id).collect()
}

fn make(id: &str) -> MultiEnv {
    MultiEnv::make(id, &OwnModels, &Options::default()).unwrap()
}

/// An action for each agent that differs from step to step and from agent to agent.
fn actions(env: &MultiEnv, step: usize) -> Vec<(String, Vec<f64>)> {
    let action = |(k, name): (usize, &str)| {
        let len = env.action_len(name).unwrap();
        let value = |i: usize| (0.3 * step as f64 + 1.3 * i as f64 + 2.0 * k as f64).sin();
        (name.to_owned(), (0..len).map(value).collect())
    };
    env.agents().enumerate().map(action).collect()
}

fn named(actions: &[(String, Vec<f64>)]) -> Vec<(&str, &[f64])> {
    actions.iter().map(|(name, action)| (&**name, &**action)).collect()
}

#[test]
fn observations_of_agents_differ_and_are_rows_of_the_joint_one() {
    for id in ids() {
        let mut env = make(id);
        env.reset(Some(2)).unwrap();
        for step in 0..5 {
            let actions = actions(&env, step);
            env.step(&named(&actions)).unwrap();
        }
        let agents: Vec<_> = env.agents().map(str::to_owned).collect();
        let seen: Vec<_> = agents.iter().map(|name| env.observation(name).unwrap()).collect();
        assert_ne!(seen[0], seen[1], "{id}");
        for (agent, seen) in agents.iter().zip(seen) {
            let rows = env.observation_rows(agent).unwrap();
            assert_eq!(rows.iter().map(|(_, row)| row.len()).sum::<usize>(), seen.len(), "{id}, {agent}");
            let own = rows.iter().flat_map(|(_, row)| &env.env().rows()[row.name()]).copied();
            assert_eq!(own.collect::<Vec<_>>(), seen, "{id}, {agent}");
        }
    }
}

#[test]
fn the_order_of_agents_does_not_matter() {
    for id in ids() {
        let (mut one, mut other) = (make(id), make(id));
        let mut joint = Env::make(id, &OwnModels, &Options::default()).unwrap();
        one.reset(Some(4)).unwrap();
        other.reset(Some(4)).unwrap();
        joint.reset(Some(4)).unwrap();
        for step in 0..10 {
            let given = actions(&one, step);
            let mut turned = named(&given);
            let first = one.step(&turned).unwrap();
            turned.reverse();
            assert_eq!(first, other.step(&turned).unwrap(), "{id}");
            let concatenated: Vec<f64> = given.iter().flat_map(|(_, action)| action.clone()).collect();
            let whole = joint.step(&concatenated).unwrap();
            assert!(
                one.env().observation() == joint.observation(),
                "{id}: the joint action is the concatenation"
            );
            let earned: Vec<f64> = first.iter().map(|step| step.reward).collect();
            let expected = match one.team().stakes() {
                Stakes::Shared => earned.iter().sum(),
                Stakes::Opposed => earned[0],
            };
            assert!((whole.reward - expected).abs() < 1e-12, "{id}: {} and {earned:?}", whole.reward);
            if one.team().stakes() == Stakes::Opposed {
                assert!((earned[0] + earned[1]).abs() < 1e-12 && earned[0] != 0.0, "{id}: {earned:?}");
            }
        }
    }
}

#[test]
fn actions_that_fit_no_agent_are_errors() {
    let mut env = make("hive/DKittyPairPushBox-v0");
    env.reset(Some(0)).unwrap();
    let (whole, short) = ([0.0; 12], [0.0; 11]);
    let mut bad = whole;
    bad[3] = f64::NAN;
    let mut error = |actions: &[(&str, &[f64])]| env.step(actions).unwrap_err().to_string();
    assert_eq!(
        error(&[("left", &whole), ("rigth", &whole)]),
        "there is no agent rigth; there are left, right"
    );
    assert_eq!(error(&[("right", &whole)]), "the agent left has no action; give each agent one");
    assert_eq!(
        error(&[("left", &whole), ("left", &whole)]),
        "the agent left has two actions; give each agent one"
    );
    assert_eq!(
        error(&[("left", &whole), ("right", &short)]),
        "an action of the agent right has 12 values, and 11 were given"
    );
    assert_eq!(
        error(&[("left", &bad), ("right", &whole)]),
        "value 3 of the action of the agent left is NaN; actions are finite numbers"
    );
    let error = env.observation("middle").unwrap_err().to_string();
    assert!(error.starts_with("there is no agent middle; there are left, right"), "{error}");
    assert!(env.step(&[("left", &whole), ("right", &whole)]).is_ok(), "errors leave the episode as it was");
}

#[test]
fn an_environment_for_one_agent_is_refused() {
    let error = MultiEnv::make("hive/FrankaReach-v0", &OwnModels, &Options::default()).err().unwrap();
    let error = error.to_string();
    assert!(error.starts_with("hive/FrankaReach-v0 is an environment for one agent"), "{error}");
    assert!(error.contains("hive/DKittyPairPushBox-v0"), "{error}");
}

/// Our own models, with a file of roles that names no feet.
struct Footless;

impl Assets for Footless {
    fn model(&self, path: &str) -> Result<(mjcf::Loader, PathBuf), AssetError> {
        OwnModels.model(path)
    }

    fn read(&self, _: &str) -> Result<Arc<[u8]>, AssetError> {
        Ok(b"root = 'A:dkitty'\nforward = 'y'".as_slice().into())
    }
}

#[test]
fn missing_roles_and_missing_bodies_are_errors() {
    let error_of = |id: &str, assets: &dyn Assets, changes: &str| {
        let options = Options::default().with_changes(changes.parse().unwrap());
        MultiEnv::make(id, assets, &options).err().unwrap().to_string()
    };
    let error = |assets: &dyn Assets, changes| error_of("hive/DKittyPairPushBox-v0", assets, changes);
    let feet = error(&Footless, "roles = 'footless.toml'");
    assert!(feet.contains("footless.toml: there is no role 'feet', which the task"), "{feet}");
    let alone = error(&OwnModels, "model_path = 'hive/locomotion/tasks/box.xml'");
    assert!(alone.contains("the agent left commands nothing"), "{alone}");
    let unknown = error(&OwnModels, "rolls = 'hive/dkitty/roles.toml'");
    assert!(unknown.contains("rolls"), "{unknown}");
    let legs = error_of("hive/PandaPairHandOver-v0", &OwnModels, "roles = 'hive/dkitty/roles.toml'");
    assert!(
        legs.contains("hive/dkitty/roles.toml") && legs.contains("which the task 'hand over' needs"),
        "{legs}"
    );
}

/// Roots on slides in a frame that is turned (D'Kitty), and on a free joint (Spot).
#[test]
fn bodies_begin_where_the_task_puts_them() {
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
    let (mut swap, mut tag) = (make("hive/DKittyPairSwap-v0"), make("hive/SpotTag-v0"));
    let mut turned = Vec::new();
    for seed in 0..5 {
        swap.reset(Some(seed)).unwrap();
        for agent in ["left_", "right_"] {
            let rows = swap.env().rows().of(agent);
            assert!(near(&rows["target_error"], &rows["mate_error"]), "each is to go where the other is");
            assert!((1.6..2.05).contains(&rows["mate_error"][0]), "they look at each other");
        }
        tag.reset(Some(seed)).unwrap();
        let (chaser, evader) = (tag.env().rows().of("chaser_"), tag.env().rows().of("evader_"));
        assert!(
            near(&evader["centre_error"], &[0.0; 2]) && near(&chaser["centre_error"], &chaser["mate_error"])
        );
        let [x, y] = [chaser["mate_error"][0], chaser["mate_error"][1]];
        assert!((2.5..3.5).contains(&x.hypot(y)) && (y / x).atan().abs() < 0.8, "{x}, {y}");
        turned.push((y / x).atan());
    }
    assert!(
        turned.iter().any(|angle| *angle > 0.1) && turned.iter().any(|angle| *angle < -0.1),
        "{turned:?}"
    );
}
