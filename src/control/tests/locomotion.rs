//! Controllers of the locomotion suite on a body of each kind: they solve tasks, and their episodes repeat. All bodies and tasks are in the
//! generated table of controllers.

mod playing;

use playing::play;

const IDS: [&str; 7] = [
    "hive/DKittyWalkTo-v0",
    "hive/MiniCheetahPushBox-v0",
    "hive/DarwinVelocity-v0",
    "hive/SnakeSwimTo-v0",
    "hive/SnakeChase-v0",
    "hive/SnakeVelocity-v0",
    "hive/SnakeWeave-v0",
];

#[test]
fn bodies_of_every_kind_do_their_tasks_and_do_not_by_doing_nothing() {
    for id in IDS {
        assert!(play(id, 0, true).0, "{id} is not solved");
        assert!(!play(id, 0, false).0, "{id} is solved by zero actions");
    }
}

#[test]
fn actions_repeat_and_stay_within_bounds() {
    for id in IDS {
        let (_, first) = play(id, 3, true);
        assert!(first.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(first == play(id, 3, true).1, "{id} acts otherwise in the same episode");
    }
}
