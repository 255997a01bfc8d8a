//! The own models, compiled by us, against what MuJoCo recorded: arrays, forward passes, 500 steps.

use robohive_validation::compile::compare_compiled;
use robohive_validation::motion::{compare_forward, compare_rollout, compare_steps};
use robohive_validation::reference::{Own, own_models};
use robohive_validation::tolerance::{COMPILE, OWN_QACC, OWN_STEP, OWN_STEP_STIFF, friction_is_stiff};
use std::path::Path;

/// Every own model.
fn own() -> Vec<Own> {
    let models = own_models().unwrap();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/own");
    assert_eq!(models.len(), std::fs::read_dir(folder).unwrap().count(), "a reference of no model");
    assert!(models.len() >= 9);
    models
}

#[test]
fn own_models_compile_alike() {
    let mut compile = COMPILE.gauge();
    for Own { name, model, reference } in own() {
        let report = compare_compiled(&model, &reference).unwrap();
        assert!(report.fields > 300);
        let differences: Vec<_> = report.differences.iter().map(ToString::to_string).collect();
        compile.take(report.largest, format!("{}: {}", name, differences.join("; ")));
    }
}

#[test]
fn own_models_accelerate_alike() {
    let mut qacc = OWN_QACC.gauge();
    for Own { name, model, reference } in own() {
        let report = compare_forward(&model, &reference).unwrap();
        let (state, worst) = report.worst.unwrap_or_else(|| panic!("{}: no state", name));
        qacc.take(worst.error, format!("{} state {state}: {worst}", name));
        assert_eq!(report.agreeing, report.states, "{}: {:?}", name, report.failure);
        assert_eq!(report.equal_contacts, report.states, "{}", name);
    }
}

#[test]
fn own_models_step_alike() {
    let mut steps = [OWN_STEP.gauge(), OWN_STEP_STIFF.gauge()];
    for Own { name, model, reference } in own() {
        let report = compare_steps(&model, &reference).unwrap();
        assert!(report.steps > 100);
        steps[usize::from(friction_is_stiff(&model))]
            .take(report.worst.0, format!("{} step {}", name, report.worst.1));
        assert_eq!(report.agreeing, report.steps, "{}", name);
    }
}

#[test]
fn own_models_move_alike() {
    for Own { name, model, reference } in own() {
        let report = compare_rollout(&model, &reference).unwrap();
        assert!(
            report.follows(),
            "{}: outside from step {:?}, {:?}",
            name,
            report.first_outside,
            report.failure
        );
        let recorded = reference.row_count("rollout.qpos").unwrap();
        assert_eq!((report.steps, report.by_step.len()), (recorded, recorded));
        assert!(recorded >= 120, "{}: {recorded} steps", name);
    }
}
