//! Recorded constraint problems: every solver with every cone, warm and cold, with and without islands and slip.

use robohive_validation::reference::Reference;
use robohive_validation::solver::{CONES, SOLVERS, solve_archive};
use robohive_validation::tolerance::{PROBLEM, STATISTICS_SHARE};
use std::path::Path;

#[test]
fn recorded_problems_are_solved_alike() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference");
    let mut features = std::collections::BTreeSet::new();
    let (mut problems, mut equal_statistics) = (0, 0);
    let mut solution = PROBLEM.gauge();
    for name in ["elbow", "franka_table", "humanoid", "pile", "quadruped", "workbench", "yard"]
        .map(|name| format!("{name}.npz"))
    {
        let mut m = Reference::open(&folder.join("own").join(&name)).unwrap().model().unwrap();
        let outcome = solve_archive(&mut m, &folder.join("solver").join(&name)).unwrap();
        for (row, solver) in outcome.tallies.iter().zip(SOLVERS) {
            for (tally, cone) in row.iter().zip(CONES) {
                assert!(tally.problems >= 10 && tally.passes(), "{name} {solver:?} {cone:?}: {tally:?}");
                solution.take(tally.worst_qacc, format!("{name} {solver:?} {cone:?}"));
                assert_eq!(
                    tally.worst_excess, 0.0,
                    "{name} {solver:?} {cone:?}: a higher cost than MuJoCo's"
                );
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
