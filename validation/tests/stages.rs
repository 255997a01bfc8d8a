//! Every stage agrees with MuJoCo on the own models, upstream injected.

use robohive_validation::reference::{is_own, recorded};
use robohive_validation::stages::compare_stages;
use robohive_validation::tolerance::{STAGE, STAGE_ELSEWHERE};

#[test]
fn stages_agree() {
    let (mut compared, mut models) = (0, 0);
    let mut gauges = [STAGE_ELSEWHERE.gauge(), STAGE.gauge()];
    for (path, reference) in recorded().unwrap() {
        let report = compare_stages(&reference).unwrap();
        models += 1;
        compared += report.outputs.iter().filter(|(_, _, worst)| worst.theirs != 0.0).count();
        for (stage, state, worst) in &report.outputs {
            let what = format!("{} state {state}, {stage}: {worst}", path.display());
            gauges[usize::from(is_own(&path))].take(worst.error, what);
        }
    }
    assert!(compared > 30 * models, "of {models} models only {compared} outputs are not zero");
}
