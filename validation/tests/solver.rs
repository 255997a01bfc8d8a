//! Recorded constraint problems: every solver with every cone, warm and cold, with and without islands and slip.

use robohive_validation::reference::Reference;
use robohive_validation::solver::{CONES, SOLVERS, solve_archive};
use std::path::Path;

/// Relative difference of solutions: both stop at a tolerance of 1e-8 in scaled cost or gradient, which leaves the
/// square root of that to the flattest directions of CG.
const SOLUTION: f64 = 1e-6;

/// Share of problems in which every iteration has MuJoCo's statistics: rounding decides states near a cone's surface.
const STATISTICS_SHARE: f64 = 0.95;

#[test]
fn recorded_problems_are_solved_alike() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference");
    let mut features = std::collections::BTreeSet::new();
    let (mut problems, mut equal_statistics) = (0, 0);
    for name in ["elbow", "franka_table", "humanoid", "pile", "quadruped", "workbench", "yard"]
        .map(|name| format!("{name}.npz"))
    {
        let mut m = Reference::open(&folder.join("own").join(&name)).unwrap().model().unwrap();
        let outcome = solve_archive(&mut m, &folder.join("solver").join(&name)).unwrap();
        for (row, solver) in outcome.tallies.iter().zip(SOLVERS) {
            for (tally, cone) in row.iter().zip(CONES) {
                assert!(tally.problems >= 10 && tally.passes(), "{name} {solver:?} {cone:?}: {tally:?}");
                assert!(tally.worst_qacc < SOLUTION, "{name} {solver:?} {cone:?}: {tally:?}");
            }
        }
        problems += outcome.tallies.iter().flatten().map(|t| t.problems).sum::<usize>();
        equal_statistics += outcome.tallies.iter().flatten().map(|t| t.equal_statistics).sum::<usize>();
        features.extend(outcome.features.into_keys());
    }
    assert!(equal_statistics as f64 > STATISTICS_SHARE * problems as f64, "{equal_statistics} of {problems}");
    for feature in [
        "cold start",
        "contacts of dimension 3",
        "contacts of dimension 6",
        "equality rows",
        "friction loss",
        "islands off",
        "limits",
        "removal of slip, several islands",
        "sparse storage",
        "tendon rows",
    ] {
        assert!(features.contains(feature), "no problem with: {feature}");
    }
}
