//! Every stage agrees with MuJoCo on the own models, upstream injected.

use robohive_validation::reference::recorded;
use robohive_validation::stages::compare_stages;

#[test]
fn stages_agree() {
    let mut outside = Vec::new();
    let mut compared = 0;
    for (path, reference) in recorded().unwrap() {
        let report = compare_stages(&reference).unwrap();
        compared += report.outputs.iter().filter(|(_, _, worst)| worst.theirs != 0.0).count();
        for (state, worst) in report.outside() {
            outside.push(format!("{} state {state}: {worst}, error {:.1e}", path.display(), worst.error));
        }
    }
    assert!(compared > 100, "only {compared} outputs are not zero");
    assert!(outside.is_empty(), "{}", outside.join("\n"));
}
