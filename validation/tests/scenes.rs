//! Scenes of own models against those that MuJoCo assembled.

use robohive_validation::scenes::{BAR, measure};
use std::path::Path;

const VARIANTS: usize = 55;

#[test]
fn own_scenes_agree() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for name in ["pile", "quadruped", "workbench", "yard", "drape", "grasp"] {
        let model = root.join(format!("../assets/{name}/{name}.xml"));
        let report = measure(&model, &root.join(format!("reference/items/{name}.npz"))).unwrap();
        assert_eq!(report.notes, [""; 0], "{name}");
        assert!(report.scenes > VARIANTS && report.different == 0 && report.worst.iter().all(|&x| x <= BAR));
        assert!(report.items > 4 * report.scenes, "{name}: {} items", report.items);
    }
}
