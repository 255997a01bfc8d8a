//! Controllers of the suite `deformable`: they solve their tasks, doing nothing does not, and their episodes repeat.

mod playing;

use env::Registry;
use playing::play;

/// Ids of the suite whose observations have the state of the thing.
fn ids() -> Vec<String> {
    let specs = Registry::builtin().specs().iter().filter(|spec| spec.suite == "deformable");
    specs.map(|spec| spec.id.clone()).filter(|id| !id.contains("_v2d")).collect()
}

#[test]
fn every_task_is_solved_by_its_controller_and_not_by_doing_nothing() {
    assert_eq!(ids().len(), 4);
    for id in ids() {
        let (solved, actions) = play(&id, 0, true);
        assert!(solved, "{id} is not solved");
        assert!(actions.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(!play(&id, 0, false).0, "{id} is solved by zero actions");
    }
}

#[test]
fn episodes_repeat() {
    let id = "hive/SpongePress-v0";
    assert!(play(id, 3, true).1 == play(id, 3, true).1, "{id} acts otherwise in the same episode");
}
