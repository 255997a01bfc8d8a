//! The environments on models of our own that are measured here.

use env::{Registry, Spec};

/// Those of one suite, or of all where it is empty, whose id contains `only`. Ids that add pictures to another one are left out.
pub fn own_ids(suite: &str, only: &str) -> impl Iterator<Item = &'static Spec> {
    Registry::builtin().specs().iter().filter(move |spec| {
        let model: Option<String> = spec.args.get("model_path");
        let wanted = (suite.is_empty() || spec.suite == suite) && spec.id.contains(only);
        wanted && model.is_some_and(|path| path.starts_with("hive/")) && !spec.args.contains("visual_keys")
    })
}
