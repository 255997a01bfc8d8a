//! The own models, compiled by us, against what MuJoCo recorded: arrays, forward passes, 500 steps.

use robohive_validation::compile::compare_compiled;
use robohive_validation::motion::{compare_forward, compare_rollout, compare_steps};
use robohive_validation::reference::Reference;
use std::path::{Path, PathBuf};

/// Model and reference of every own model that has both.
fn own() -> Vec<(PathBuf, Reference)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    for folder in std::fs::read_dir(root.join("../assets")).unwrap() {
        for file in std::fs::read_dir(folder.unwrap().path()).unwrap() {
            let model = file.unwrap().path();
            let name = model.file_stem().unwrap().to_string_lossy().into_owned();
            let reference = root.join("reference/own").join(name + ".npz");
            if model.extension().is_some_and(|e| e == "xml") && reference.exists() {
                found.push((model, Reference::open(&reference).unwrap()));
            }
        }
    }
    assert!(found.len() >= 4, "only {} own models have references", found.len());
    found
}

fn load(path: &Path) -> physics::Model {
    mjcf::load(path).unwrap().model
}

#[test]
fn own_models_compile_alike() {
    for (path, reference) in own() {
        let report = compare_compiled(&load(&path), &reference).unwrap();
        assert!(report.fields > 300);
        let differences: Vec<_> = report.differences.iter().map(ToString::to_string).collect();
        assert!(report.agrees(), "{}: {}", path.display(), differences.join("; "));
    }
}

#[test]
fn own_models_accelerate_alike() {
    for (path, reference) in own() {
        let report = compare_forward(&load(&path), &reference).unwrap();
        let worst = report.worst.as_ref().map(|(state, w)| format!("state {state}: {w}")).unwrap_or_default();
        assert_eq!(report.agreeing, report.states, "{}: {worst} {:?}", path.display(), report.failure);
        assert_eq!(report.equal_contacts, report.states, "{}", path.display());
    }
}

#[test]
fn own_models_step_alike() {
    for (path, reference) in own() {
        let report = compare_steps(&load(&path), &reference).unwrap();
        assert!(report.steps > 100);
        assert_eq!(report.agreeing, report.steps, "{}: {:?}", path.display(), report.worst);
    }
}

#[test]
fn own_models_move_alike() {
    for (path, reference) in own() {
        let report = compare_rollout(&load(&path), &reference).unwrap();
        assert!(
            report.follows(),
            "{}: outside from step {:?}, {:?}",
            path.display(),
            report.first_outside,
            report.failure
        );
        assert_eq!(report.by_step.len(), report.steps);
    }
}
