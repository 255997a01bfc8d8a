//! The own models compile to what MuJoCo makes of them, every array.

use robohive_validation::compile::compare_compiled;
use robohive_validation::reference::Reference;
use std::path::Path;

#[test]
fn own_models_compile_as_in_mujoco() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for (name, model) in [
        ("elbow", "elbow/elbow.xml"),
        ("franka_table", "franka/franka_table.xml"),
        ("pile", "pile/pile.xml"),
        ("quadruped", "quadruped/quadruped.xml"),
    ] {
        let path = root.join("assets").join(model);
        let loaded = mjcf::loader::load(path.to_str().unwrap()).unwrap_or_else(|errors| panic!("{errors}"));
        let reference = root.join(format!("validation/reference/own/{name}.npz"));
        let report = compare_compiled(&loaded.model, &Reference::open(&reference).unwrap()).unwrap();
        assert!(report.fields > 300);
        assert!(report.agrees(), "{name}: {}", report.differences[0]);
    }
}
