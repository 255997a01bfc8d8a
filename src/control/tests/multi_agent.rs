//! Controllers of the multi-agent suite: together they solve their tasks, doing nothing does not, and
//! episodes repeat.

use env::team::Agent;
use env::{MultiEnv, Options, OwnModels, Registry};
use robohive_control::{make, serving};

/// Plays an episode with these settings changed, with the controller or with zero actions, agent by agent: whether it was solved in more than 25 steps or ended
/// solved, and every action.
fn play(id: &str, changes: &str, seed: u64, controlled: bool) -> (bool, Vec<f64>) {
    let mut env =
        MultiEnv::make(id, &OwnModels, &Options::default().with_changes(changes.parse().unwrap())).unwrap();
    let name = serving(env.env().spec()).next().unwrap_or_else(|| panic!("no controller serves {id}")).name;
    let mut controller = make(name, env.env()).unwrap();
    let mut joint = vec![0.0; env.env().action_len()];
    let (mut given, mut solved) = (Vec::new(), 0);
    let team = env.team().clone();
    env.reset(Some(seed)).unwrap();
    controller.reset(env.env(), seed).unwrap();
    loop {
        if controlled {
            controller.act(env.env(), &mut joint).unwrap();
        }
        let own = |agent: &Agent| agent.commands().iter().map(|&k| joint[k]).collect::<Vec<_>>();
        let own: Vec<_> = team.agents().iter().map(|agent| (agent.name(), own(agent))).collect();
        let actions: Vec<_> = own.iter().map(|(name, action)| (*name, &**action)).collect();
        let steps = env.step(&actions).unwrap();
        assert!(steps[0].fault.is_none(), "{id}: {:?}", steps[0].fault);
        given.extend_from_slice(&joint);
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
            assert!(play(&id, "", seed, true).0, "{id} is not solved from seed {seed}");
        }
        assert!(!play(&id, "", 0, false).0, "{id} is solved by zero actions");
    }
}

#[test]
fn actions_repeat_and_stay_within_bounds() {
    for id in ids() {
        let short = "max_episode_steps = 150";
        let (_, first) = play(&id, short, 3, true);
        assert!(first.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(first == play(&id, short, 3, true).1, "{id} acts otherwise in the same episode");
    }
}
