//! States that are shown again are followed by the steps that followed them.

use physics::Snapshot;
use robohive_viewer::Session;

const HUMANOID: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/humanoid/humanoid.xml");

fn bits(session: &Session) -> Vec<u64> {
    let data = session.data();
    data.state.qpos.iter().chain(&data.state.qvel).chain(&data.acc.qacc).map(|x| x.to_bits()).collect()
}

fn stepped(session: &mut Session, count: usize) -> Vec<u64> {
    (0..count).for_each(|_| session.step_forward());
    assert_eq!(session.fault(), None);
    bits(session)
}

#[test]
fn saved_states_and_those_of_the_history_are_followed_by_the_same_steps() {
    let mut session = Session::new(mjcf::load(HUMANOID).unwrap().model).unwrap();
    // On the ground, so that the solver's start matters.
    stepped(&mut session, 600);
    assert!(!session.data().con.contact.is_empty());
    let mut saved = Snapshot::default();
    session.data().save(&mut saved);
    let there = stepped(&mut session, 40);
    session.restore(&saved).unwrap();
    assert_eq!(stepped(&mut session, 40), there);
    session.show_past(20);
    // Time goes on from there: the states after it are dropped.
    session.run(true);
    assert_eq!(session.advance(20.0 * session.model().opt.timestep, &mut || true), 20);
    assert_eq!(bits(&session), there);
}

#[test]
fn states_of_other_models_change_nothing() {
    let mut session = Session::new(mjcf::load(HUMANOID).unwrap().model).unwrap();
    let before = bits(&session);
    assert!(session.restore(&Snapshot::default()).is_err());
    assert_eq!(bits(&session), before);
}
