//! Controllers of the classical suite: they solve their tasks, doing nothing does not, and their episodes repeat.

mod playing;

use env::Registry;
use playing::play;

fn ids() -> Vec<String> {
    let specs = Registry::builtin().specs().iter();
    specs.filter(|spec| spec.suite == "classical").map(|spec| spec.id.clone()).collect()
}

#[test]
fn every_task_is_solved_by_its_controller_and_not_by_doing_nothing() {
    assert_eq!(ids().len(), 10);
    for id in ids() {
        assert!(play(&id, 0, true).0, "{id} is not solved");
        assert!(!play(&id, 0, false).0, "{id} is solved by zero actions");
    }
}

#[test]
fn actions_repeat_and_stay_within_bounds() {
    for id in ids() {
        let (_, first) = play(&id, 3, true);
        assert!(first.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(first == play(&id, 3, true).1, "{id} acts otherwise in the same episode");
    }
}
