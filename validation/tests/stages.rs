//! Every stage agrees with MuJoCo on the own models, upstream injected.

use robohive_validation::reference::Reference;
use robohive_validation::stages::compare_stages;
use std::path::{Path, PathBuf};

/// The recorded own models, and those in the folder that `ROBOHIVE_REFERENCES` names.
fn references() -> Vec<PathBuf> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/own");
    let folders = [Some(own), std::env::var_os("ROBOHIVE_REFERENCES").map(PathBuf::from)];
    let mut files: Vec<_> = folders
        .into_iter()
        .flatten()
        .flat_map(|folder| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()))
        .collect();
    files.sort();
    files
}

#[test]
fn stages_agree() {
    let mut outside = Vec::new();
    let mut compared = 0;
    for path in references() {
        let report = compare_stages(&Reference::open(&path).unwrap()).unwrap();
        compared += report.outputs.iter().filter(|(_, _, worst)| worst.theirs != 0.0).count();
        for (state, worst) in report.outside() {
            outside.push(format!("{} state {state}: {worst}, error {:.1e}", path.display(), worst.error));
        }
    }
    assert!(compared > 100, "only {compared} outputs are not zero");
    assert!(outside.is_empty(), "{}", outside.join("\n"));
}
