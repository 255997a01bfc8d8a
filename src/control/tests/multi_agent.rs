//! Controllers of the multi-agent suite: together they solve their tasks, doing nothing does not, nor does one agent alone where two are
//! needed, and episodes repeat.

use env::{MultiEnv, Options, OwnModels, Registry};
use robohive_control::{make, serving};

/// Plays an episode in which the controller acts for the agents whose names `acts` accepts, and the others are given zero actions: whether
/// it was solved in more than 25 steps or ended solved, and every action.
fn play(id: &str, seed: u64, acts: impl Fn(&str) -> bool) -> (bool, Vec<f64>) {
    let mut env = MultiEnv::make(id, &OwnModels, &Options::default()).unwrap();
    let name = serving(env.env().spec()).next().unwrap_or_else(|| panic!("no controller serves {id}")).name;
    let mut controller = make(name, env.env()).unwrap();
    let mut joint = vec![0.0; env.env().action_len()];
    let (mut given, mut solved) = (Vec::new(), 0);
    let team = env.team().clone();
    env.reset(Some(seed)).unwrap();
    controller.reset(env.env(), seed).unwrap();
    loop {
        controller.act(env.env(), &mut joint).unwrap();
        let own = team.agents().iter().map(|agent| {
            let action = agent.commands().iter().map(|&k| if acts(agent.name()) { joint[k] } else { 0.0 });
            (agent.name(), action.collect::<Vec<_>>())
        });
        let own: Vec<_> = own.collect();
        let actions: Vec<_> = own.iter().map(|(name, action)| (*name, &**action)).collect();
        let steps = env.step(&actions).unwrap();
        assert!(steps[0].fault.is_none(), "{id}: {:?}", steps[0].fault);
        given.extend(actions.iter().flat_map(|(_, action)| action.iter().copied()));
        let verdict = env.env().verdict();
        solved += usize::from(verdict.solved);
        if solved > 25 || steps[0].terminated || steps[0].truncated {
            return (solved > 25 || verdict.solved, given);
        }
    }
}

fn ids() -> Vec<String> {
    let specs = Registry::builtin().specs().iter();
    specs.filter(|spec| spec.suite == "multi_agent").map(|spec| spec.id.clone()).collect()
}

#[test]
fn every_task_is_solved_by_its_controller_and_not_by_doing_nothing() {
    for id in ids() {
        for seed in [0, 1] {
            assert!(play(&id, seed, |_| true).0, "{id} is not solved from seed {seed}");
        }
        assert!(!play(&id, 0, |_| false).0, "{id} is solved by zero actions");
    }
}

#[test]
fn one_agent_alone_does_not_bring_the_box_to_its_place() {
    for agent in ["left", "right"] {
        assert!(!play("hive/DKittyPairPushBox-v0", 0, |name| name == agent).0, "{agent} alone suffices");
    }
}

#[test]
fn actions_repeat_and_stay_within_bounds() {
    for id in ids() {
        let (_, first) = play(&id, 3, |_| true);
        assert!(first.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(first == play(&id, 3, |_| true).1, "{id} acts otherwise in the same episode");
    }
}
