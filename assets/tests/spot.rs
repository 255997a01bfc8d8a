//! The Spot-like quadruped weighs and does what its README says. The numbers are printed by `-- --nocapture`.

mod measure;

use measure::legs::{apart, hung, mass, pushed, ranges, sines, stands};
use measure::own;

/// Legs spread and folded, so that one of them moves without meeting the others: hx, hy and kn of front and hind, left and right \[rad\].
const FOLDED: [f64; 12] = [0.5, 0.0, -2.7, -0.5, 0.0, -2.7, 0.5, 0.0, -2.7, -0.5, 0.0, -2.7];
/// Weight of the robot \[N\].
const WEIGHT: f64 = 32.68 * 9.81;
const OPTIONS: &str = "timestep='0.002' integrator='implicitfast'";

#[test]
fn it_has_the_published_mass_and_links() {
    let m = hung("spot", OPTIONS);
    assert!((mass(&m) - 32.5).abs() < 0.3, "{}", mass(&m));
    assert!((apart(&m, "fl_hip", "hl_hip") - 0.5957).abs() < 1e-6);
    assert!((apart(&m, "fl_hip", "fl_uleg") - 0.1108).abs() < 1e-6);
    assert!((apart(&m, "hr_uleg", "hr_lleg") - 0.32098).abs() < 1e-5);
}

#[test]
fn every_joint_moves_through_its_range_and_follows_a_sine() {
    let m = hung("spot", OPTIONS);
    let (short, clashes) = ranges(&m, &FOLDED, "");
    let (error, joint) = sines(&m, &FOLDED);
    assert!(short < 0.02, "{short}");
    assert!(clashes.is_empty(), "{clashes:?}");
    assert!(error < 0.2, "{joint}: {error}");
}

#[test]
fn it_stands_and_carries_half_of_its_weight() {
    let m = own("spot/scene.xml");
    let stood = stands(&m, "body", 10.0, 0.0);
    assert!(stood.height[1] > 0.44 && stood.upright > 0.999 && stood.sag < 0.05);
    let stood = stands(&m, "body", 5.0, 0.5 * WEIGHT);
    assert!(stood.height[1] > 0.43 && stood.upright > 0.999 && stood.sag < 0.08);
}

#[test]
fn pushes_do_not_make_it_fall() {
    let m = own("spot/scene.xml");
    for impulse in [[50.0, 0.0], [-50.0, 0.0], [0.0, 30.0], [0.0, -30.0]] {
        let stood = pushed(&m, "body", impulse);
        assert!(stood.height[1] > 0.42 && stood.upright > 0.94 && stood.sag < 0.08, "{impulse:?}");
    }
    // Half as much again sideways turns it over: the test can fail.
    assert!(pushed(&m, "body", [0.0, 45.0]).upright < 0.0);
}
