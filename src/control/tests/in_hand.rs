//! Hands turn what lies in them by sampled plans.

mod playing;

use playing::play;

/// Few seeds, as every step of an episode takes tens of simulated plans.
#[test]
fn a_cube_is_turned_and_not_by_doing_nothing() {
    for (id, seed) in [("hive/AllegroCubeReorient-v0", 1), ("hive/ShadowCubeReorient-v0", 1)] {
        let (solved, actions) = play(id, seed, true);
        assert!(solved, "{id}");
        assert!(actions.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(!play(id, seed, false).0, "{id} is solved by zero actions");
    }
}

/// Zero actions turn the pen far enough on one seed of five, as RoboHive defines the task; on this seed they do not.
#[test]
fn a_pen_is_turned_and_actions_repeat() {
    let id = "hive/pen-v1";
    let (solved, actions) = play(id, 0, true);
    assert!(solved && !play(id, 0, false).0);
    assert!(actions == play(id, 0, true).1, "{id} acts otherwise in the same episode");
}
