//! Hands turn what lies in them by sampled plans.

mod playing;

use playing::{play, watch};

/// Few seeds, as every step of an episode takes tens of simulated plans.
fn solves_and_doing_nothing_does_not(ids: &[(&str, u64)]) {
    for &(id, seed) in ids {
        let (solved, actions) = play(id, seed, true);
        assert!(solved, "{id}");
        assert!(actions.iter().all(|value| (-1.0..=1.0).contains(value)), "{id}");
        assert!(!play(id, seed, false).0, "{id} is solved by zero actions");
    }
}

#[test]
fn a_cube_is_turned() {
    let [allegro, shadow] = ["hive/AllegroCubeReorient-v0", "hive/ShadowCubeReorient-v0"];
    solves_and_doing_nothing_does_not(&[(allegro, 1), (shadow, 1)]);
}

#[test]
fn two_balls_go_round_each_other() {
    solves_and_doing_nothing_does_not(&[("hive/AdroitBaoding-v0", 0)]);
}

#[test]
fn a_pen_in_the_palm_is_turned() {
    solves_and_doing_nothing_does_not(&[("hive/AdroitPenReorient-v0", 0)]);
}

/// Zero actions turn the pen far enough on one seed of five, as RoboHive defines the task; on this seed they do not.
#[test]
fn a_pen_is_turned_and_actions_repeat() {
    let id = "hive/pen-v1";
    let (solved, actions) = play(id, 0, true);
    assert!(solved && !play(id, 0, false).0);
    assert!(actions == play(id, 0, true).1, "{id} acts otherwise in the same episode");
}

/// The ball is squeezed by more than a tenth, as asked for on these seeds, and never torn: no node is farther from another than 1.5 diameters.
#[test]
fn a_soft_ball_is_squeezed_as_far_as_asked() {
    for id in ["hive/AllegroSoftBall-v0", "hive/AdroitSoftBall-v0"] {
        let mut last = [0.0; 2];
        let (solved, actions) = watch(id, 0, true, |env| {
            let rows = env.rows();
            last = [rows["width"][0], rows["width_error"][0]];
            let nodes = rows["ball"].as_chunks::<3>().0;
            assert_eq!(nodes.len(), 8);
            let farthest =
                nodes.iter().flat_map(|a| nodes.iter().map(move |b| distance(a, b))).fold(0.0, f64::max);
            assert!(farthest < 0.06 * 3_f64.sqrt() * 1.5, "{id}: nodes are {farthest} m apart");
        });
        assert!(solved && last[0] < 0.92 && last[1].abs() < 0.02, "{id}: {last:?}");
        assert!(!play(id, 0, false).0, "{id} is solved by zero actions");
        assert!(actions == play(id, 0, true).1, "{id} acts otherwise in the same episode");
    }
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}
