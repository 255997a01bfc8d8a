//! The Atlas-like humanoid weighs and does what its README says. The numbers are printed by `-- --nocapture`.

mod measure;

use measure::legs::{apart, hung, mass, pushed, ranges, sines, stands};
use measure::own;

/// Back and neck, arms and legs, left before right: arms stretched out sideways, legs straight.
const STRAIGHT: [f64; 30] = [0.0; 30];
/// The same with spread legs \[rad\], so that one of them swings inwards without meeting the other.
const SPREAD: [f64; 30] = {
    let mut pose = STRAIGHT;
    (pose[19], pose[25]) = (0.5, -0.5);
    pose
};
/// Weight of the robot \[N\].
const WEIGHT: f64 = 156.5 * 9.81;
const OPTIONS: &str = "timestep='0.004' integrator='implicitfast'";

#[test]
fn it_has_the_published_mass_and_links() {
    let m = hung("atlas", OPTIONS);
    assert!((mass(&m) - 156.5).abs() < 0.01, "{}", mass(&m));
    assert!((apart(&m, "l_uleg", "l_lleg") - 0.3773).abs() < 1e-4);
    assert!((apart(&m, "r_lleg", "r_talus") - 0.422).abs() < 1e-9);
    assert!((apart(&m, "l_uarm", "l_larm") - 0.1194).abs() < 1e-4);
    assert!((apart(&m, "r_larm", "r_hand") - 0.2997).abs() < 1e-4);
}

#[test]
fn every_joint_moves_through_its_range() {
    let m = hung("atlas", OPTIONS);
    let spread = ["hpz", "hpx", "akx"].map(|of| (&SPREAD, of));
    let straight = ["bkz", "bky", "bkx", "ay", "shz", "shx", "ely", "elx", "wy", "mwx", "hpy", "kny", "aky"];
    for (pose, of) in straight.map(|of| (&STRAIGHT, of)).into_iter().chain(spread) {
        let (short, clashes) = ranges(&m, pose, of);
        assert!(short < 0.03, "{of}: {short}");
        assert!(clashes.is_empty(), "{clashes:?}");
    }
}

#[test]
fn its_servos_follow_a_sine() {
    let (error, joint) = sines(&hung("atlas", OPTIONS), &SPREAD);
    assert!(error < 0.2, "{joint}: {error}");
}

#[test]
fn it_stands_and_carries_half_of_its_weight() {
    let m = own("atlas/scene.xml");
    let stood = stands(&m, "pelvis", 10.0, 0.0);
    assert!(stood.height[1] > 0.9 && stood.upright > 0.99 && stood.sag < 0.08);
    let stood = stands(&m, "pelvis", 5.0, 0.5 * WEIGHT);
    assert!(stood.height[1] > 0.9 && stood.upright > 0.99 && stood.sag < 0.1);
}

#[test]
fn pushes_do_not_make_it_fall() {
    let m = own("atlas/scene.xml");
    for impulse in [[70.0, 0.0], [-70.0, 0.0], [0.0, 80.0], [0.0, -80.0]] {
        let stood = pushed(&m, "pelvis", impulse);
        assert!(stood.height[1] > 0.91 && stood.upright > 0.99 && stood.sag < 0.05, "{impulse:?}");
    }
    // Half as much again to the back makes it fall: the test can fail.
    assert!(pushed(&m, "pelvis", [-105.0, 0.0]).upright < 0.5);
}
