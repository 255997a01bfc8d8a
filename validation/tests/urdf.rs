//! URDF models beside MuJoCo's compile of them: every array, to the bar of compiled models.

use robohive_validation::compile::compare_compiled;
use robohive_validation::reference::Reference;
use std::path::Path;

#[test]
fn urdf_compiles_to_the_recorded_arrays() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["arm", "world"] {
        let model = mjcf::load(root.join(format!("../mjcf/tests/urdf/{name}.urdf"))).unwrap().model;
        let reference = Reference::open(&root.join(format!("reference/urdf/{name}.npz"))).unwrap();
        let report = compare_compiled(&model, &reference).unwrap();
        let worst: Vec<String> = report.differences.iter().map(|worst| format!("{worst:?}")).collect();
        assert!(report.agrees(), "{name}: {}", worst.join("\n"));
    }
}
