//! The Darwin-OP-like humanoid weighs and does what its README says. The numbers are printed by `-- --nocapture`.

mod measure;

use measure::legs::{apart, hung, mass, pushed, ranges, sines, stands};
use measure::own;

/// Legs straight, arms spread a little: head, arms and legs, left before right \[rad\].
const STRAIGHT: [f64; 20] =
    [0.0, 0.0, 0.0, 0.5, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
/// The legs spread too, so that one of them turns or swings inwards without meeting the other.
const SPREAD: [f64; 20] =
    [0.0, 0.0, 0.0, 0.5, 0.0, 0.0, -0.5, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0];
/// Weight of the robot \[N\].
const WEIGHT: f64 = 2.9 * 9.81;
const OPTIONS: &str = "timestep='0.004' integrator='implicitfast'";

#[test]
fn it_has_the_published_mass_and_links() {
    let m = hung("darwin", OPTIONS);
    assert!((mass(&m) - 2.9).abs() < 0.01, "{}", mass(&m));
    assert!((apart(&m, "l_thigh", "l_shin") - 0.093).abs() < 1e-9);
    assert!((apart(&m, "r_shin", "r_ankle") - 0.093).abs() < 1e-9);
    assert!((apart(&m, "l_shoulder", "r_shoulder") - 0.1207).abs() < 1e-9);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let m = hung("darwin", OPTIONS);
    let straight = ["pan", "tilt", "sho_pitch", "sho_roll", "el", "hip_pitch", "knee", "ank_pitch"];
    let spread = ["hip_yaw", "hip_roll", "ank_roll"];
    let all = straight.map(|of| (&STRAIGHT, of)).into_iter().chain(spread.map(|of| (&SPREAD, of)));
    for (pose, of) in all {
        let (short, clashes) = ranges(&m, pose, of);
        assert!(short < 0.02, "{of}: {short}");
        assert!(clashes.is_empty(), "{clashes:?}");
    }
    let (error, joint) = sines(&m, &SPREAD);
    assert!(error < 0.2, "{joint}: {error}");
}

#[test]
fn it_stands_and_carries_half_of_its_weight() {
    let m = own("darwin/scene.xml");
    let stood = stands(&m, "body", 10.0, 0.0);
    assert!(stood.height[1] > 0.32 && stood.upright > 0.99 && stood.sag < 0.05);
    let stood = stands(&m, "body", 5.0, 0.5 * WEIGHT);
    assert!(stood.height[1] > 0.32 && stood.upright > 0.99 && stood.sag < 0.06);
}

#[test]
fn pushes_do_not_make_it_fall() {
    let m = own("darwin/scene.xml");
    for impulse in [[0.8, 0.0], [-0.8, 0.0], [0.0, 1.0], [0.0, -1.0]] {
        let stood = pushed(&m, "body", impulse);
        assert!(stood.height[1] > 0.32 && stood.upright > 0.98 && stood.sag < 0.05, "{impulse:?}");
    }
    // Half as much again to the back makes it fall: the test can fail.
    assert!(pushed(&m, "body", [-1.2, 0.0]).upright < 0.5);
}
