//! Recorded constraint problems: every solver with every cone, warm and cold, with and without islands and slip.

use robohive_validation::reference::Reference;
use robohive_validation::solver::{CONES, SOLVERS, solve_archive};
use std::path::Path;

/// Relative difference of solutions: both stop at a tolerance of 1e-8 in scaled cost or gradient, which leaves the
/// square root of that to the flattest directions of CG.
const SOLUTION: f64 = 1e-6;

#[test]
fn recorded_problems_are_solved_alike() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference");
    let mut features = std::collections::BTreeSet::new();
    for name in ["elbow", "franka_table", "pile", "quadruped", "workbench"].map(|name| format!("{name}.npz"))
    {
        let mut m = Reference::open(&folder.join("own").join(&name)).unwrap().model().unwrap();
        let outcome = solve_archive(&mut m, &folder.join("solver").join(&name)).unwrap();
        for (row, solver) in outcome.tallies.iter().zip(SOLVERS) {
            for (tally, cone) in row.iter().zip(CONES) {
                assert!(tally.problems >= 10 && tally.passes(), "{name} {solver:?} {cone:?}: {tally:?}");
                assert!(tally.worst_qacc < SOLUTION, "{name} {solver:?} {cone:?}: {tally:?}");
            }
        }
        features.extend(outcome.features.into_keys());
    }
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
