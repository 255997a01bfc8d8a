//! Policies that are shipped: they were trained for their ids, and solve most of a few episodes that neither training nor the table of
//! their successes plays.

use agents::Policy;
use env::episode::evaluate;
use env::{Env, Options, OwnModels};
use robohive_agents as agents;

const SEEDS: std::ops::Range<u64> = 9000..9005;

#[test]
fn shipped_policies_solve_their_tasks() {
    let mut found = 0;
    for id in assets::policies() {
        let policy = Policy::shipped(id).unwrap().unwrap();
        let Policy::Trained(trained) = &policy else { panic!("{id} was not trained here") };
        assert_eq!(trained.card().id, id);
        let mut env = Env::make(id, &OwnModels, &Options::default()).unwrap();
        let episodes: Vec<_> = SEEDS.map(|seed| policy.play(&mut env, seed).unwrap()).collect();
        let solved = evaluate(&episodes, env.success()).success_percentage;
        assert!(solved >= 60.0, "{id}: {solved} % of {} episodes", episodes.len());
        found += 1;
    }
    assert!(found > 0 && Policy::shipped("hive/QuadrupedWalk-v0").unwrap().is_none());
}

#[test]
fn all_shipped_policies_take_less_than_4_mb() {
    let bytes: usize = assets::policies().filter_map(assets::policy).map(<[u8]>::len).sum();
    assert!((1_000..4_000_000).contains(&bytes), "{bytes} bytes");
}
