//! Every module that a reader of the documentation sees has an example, which runs as a doctest.

use std::path::{Path, PathBuf};

/// Files of the documented modules that `file` declares, and of those below them.
fn documented(file: &Path, folder: &Path, found: &mut Vec<PathBuf>) {
    let text = std::fs::read_to_string(file).unwrap();
    let mut hidden = false;
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("pub mod ").and_then(|rest| rest.strip_suffix(';'))
            && !hidden
        {
            let (below, leaf) = (folder.join(name), folder.join(format!("{name}.rs")));
            let file = if leaf.is_file() { leaf } else { below.join("mod.rs") };
            documented(&file, &below, found);
            found.push(file);
        }
        hidden = line == "#[doc(hidden)]";
    }
}

#[test]
fn every_documented_module_has_an_example() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    documented(&root.join("lib.rs"), root, &mut found);
    assert!(found.len() > 20, "{found:?}");
    for file in found {
        let text = std::fs::read_to_string(&file).unwrap();
        let mut head = text.lines().take_while(|line| line.starts_with("//!"));
        assert!(head.any(|line| line == "//! ```"), "{} has no example", file.display());
    }
}
