//! The Mini-Cheetah-like quadruped weighs and does what its README says. The numbers are printed by `-- --nocapture`.

mod measure;

use measure::legs::{apart, hung, mass, pushed, ranges, sines, stands};
use measure::own;

/// Legs folded: abad, hip and knee of front and hind, left and right \[rad\].
const FOLDED: [f64; 12] = [0.0, 0.0, 2.6, 0.0, 0.0, 2.6, 0.0, 0.0, 2.6, 0.0, 0.0, 2.6];
/// Legs spread, so that one of them swings inwards without meeting the others.
const SPREAD: [f64; 12] = [1.2, 0.0, 2.6, -1.2, 0.0, 2.6, 1.2, 0.0, 2.6, -1.2, 0.0, 2.6];
/// Weight of the robot \[N\].
const WEIGHT: f64 = 8.912 * 9.81;
const OPTIONS: &str = "timestep='0.002' integrator='implicitfast'";

#[test]
fn it_has_the_published_mass_and_links() {
    let m = hung("minicheetah", OPTIONS);
    assert!((mass(&m) - 9.0).abs() < 0.1, "{}", mass(&m));
    assert!((apart(&m, "fl_abad", "hl_abad") - 0.38).abs() < 1e-9);
    assert!((apart(&m, "fl_abad", "fl_thigh") - 0.062).abs() < 1e-9);
    assert!((apart(&m, "hr_thigh", "hr_shin") - 0.209_038).abs() < 1e-6);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let m = hung("minicheetah", OPTIONS);
    for (pose, of) in [(&SPREAD, "abad"), (&FOLDED, "hip"), (&FOLDED, "knee")] {
        let (short, clashes) = ranges(&m, pose, of);
        assert!(short < 0.02, "{of}: {short}");
        assert!(clashes.is_empty(), "{clashes:?}");
    }
    let (error, joint) = sines(&m, &FOLDED);
    assert!(error < 0.2, "{joint}: {error}");
}

#[test]
fn it_stands_and_carries_half_of_its_weight() {
    let m = own("minicheetah/scene.xml");
    let stood = stands(&m, "trunk", 10.0, 0.0);
    assert!(stood.height[1] > 0.285 && stood.upright > 0.999 && stood.sag < 0.04);
    let stood = stands(&m, "trunk", 5.0, 0.5 * WEIGHT);
    assert!(stood.height[1] > 0.28 && stood.upright > 0.999 && stood.sag < 0.06);
}

#[test]
fn pushes_do_not_make_it_fall() {
    let m = own("minicheetah/scene.xml");
    for impulse in [[12.0, 0.0], [-12.0, 0.0], [0.0, 6.0], [0.0, -6.0]] {
        let stood = pushed(&m, "trunk", impulse);
        assert!(stood.height[1] > 0.28 && stood.upright > 0.9 && stood.sag < 0.06, "{impulse:?}");
    }
    // Half as much again sideways turns it over: the test can fail.
    assert!(pushed(&m, "trunk", [0.0, 9.0]).upright < 0.0);
}
