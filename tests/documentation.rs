//! What the documentation promises: every public module of a published crate shows by an example how it is used.

use std::path::{Path, PathBuf};
use syn::{Attribute, Expr, Item, Lit, Meta, Visibility};

/// Folders of the published crates.
const PUBLISHED: [&str; 16] = [
    "assets",
    "mjcf",
    "src/agents",
    "src/dataset",
    "src/encoders",
    "src/env",
    "src/exchange",
    "src/library",
    "src/physics",
    "src/random",
    "src/render",
    "src/render_gpu",
    "src/robot",
    "src/store",
    "src/video",
    ".",
];

/// The folder of the repository.
fn root() -> PathBuf {
    env!("CARGO_MANIFEST_DIR").into()
}

/// The text of the documentation in attributes.
fn documentation(attributes: &[Attribute]) -> String {
    let lines = attributes.iter().filter(|attribute| attribute.path().is_ident("doc")).filter_map(|doc| {
        let Meta::NameValue(value) = &doc.meta else { return None };
        let Expr::Lit(literal) = &value.value else { return None };
        let Lit::Str(text) = &literal.lit else { return None };
        Some(text.value())
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Whether an attribute takes the item out of the documentation.
fn is_hidden(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) => list.path.is_ident("doc") && list.tokens.to_string() == "hidden",
        _ => false,
    })
}

/// Whether a line of documentation begins an example that is compiled.
fn has_example(documentation: &str) -> bool {
    documentation.lines().map(str::trim).any(|line| line == "```" || line == "```no_run")
}

/// Whether a file, or a file of the folder of that name, has an example.
fn shows_an_example(module: &Path) -> bool {
    let own = [module.with_extension("rs"), module.join("mod.rs")];
    let texts = own.iter().filter_map(|file| std::fs::read_to_string(file).ok());
    let below = std::fs::read_dir(module).into_iter().flatten().filter_map(|entry| {
        let path = entry.ok()?.path();
        if path.is_dir() { None } else { std::fs::read_to_string(path).ok() }
    });
    texts.chain(below).any(|text| {
        let lines = text.lines().map(str::trim_start);
        let lines = lines.filter_map(|line| line.strip_prefix("//!").or_else(|| line.strip_prefix("///")));
        has_example(&lines.collect::<Vec<_>>().join("\n"))
    })
}

#[test]
fn every_public_module_has_an_example() {
    let (mut seen, mut without) = (0, Vec::new());
    for folder in PUBLISHED {
        let file = if folder == "." { root().join("src/lib.rs") } else { root().join(folder).join("lib.rs") };
        let text = std::fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let syntax = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        let before = seen;
        for item in &syntax.items {
            let Item::Mod(module) = item else { continue };
            if !matches!(module.vis, Visibility::Public(_)) || is_hidden(&module.attrs) {
                continue;
            }
            seen += 1;
            let name = module.ident.to_string();
            if !has_example(&documentation(&module.attrs))
                && !shows_an_example(&root().join(folder).join(&name))
            {
                without.push(format!("{folder}: {name}"));
            }
        }
        // What stands at the root alone is shown there.
        if seen == before && !has_example(&documentation(&syntax.attrs)) {
            without.push(folder.to_owned());
        }
    }
    assert!(seen > 40, "only {seen} public modules found");
    assert!(without.is_empty(), "without an example that compiles:\n{}", without.join("\n"));
}
