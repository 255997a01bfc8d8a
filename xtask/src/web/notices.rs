//! Licences of what the module is compiled from.

use crate::command::output;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The licence of every package of others that `package` is built from for `target`, with the notices it comes with.
pub fn of(package: &str, target: &str) -> Result<String, String> {
    let (metadata, _) = output(Command::new("cargo").args([
        "metadata",
        "--format-version",
        "1",
        "--filter-platform",
        target,
    ]))?;
    let metadata: Value = serde_json::from_str(&metadata).map_err(|error| error.to_string())?;
    let manifests: BTreeMap<String, (&str, &str)> = entries(&metadata["packages"])
        .map(|each| {
            let text = |key: &str| each[key].as_str().unwrap_or_default();
            (format!("{} v{}", text("name"), text("version")), (text("license"), text("manifest_path")))
        })
        .collect();
    let tree = ["tree", "--package", package, "--target", target, "--edges", "normal"];
    let (tree, _) = output(Command::new("cargo").args(tree).args(["--prefix", "none", "--format", "{p}"]))?;
    let mut used: Vec<&str> = tree.lines().map(|line| line.trim_end_matches(" (*)")).collect();
    used.sort_unstable();
    used.dedup();
    let mut text = String::from("The module is compiled from these works of others.\n");
    // Packages of the repository are named with their folder. Procedural macros are no part of the module.
    for name in used.into_iter().filter(|name| !name.is_empty() && !name.contains(" (")) {
        let (licence, manifest) =
            manifests.get(name).ok_or_else(|| format!("cargo knows no manifest of {name}"))?;
        text += &format!("\n{}\n{name}: {licence}\n", "-".repeat(78));
        let folder = Path::new(manifest).parent().ok_or("a manifest in no folder")?;
        for notice in notices(folder)? {
            text += &format!("\n{}\n", notice.trim_end());
        }
    }
    Ok(text)
}

fn entries(list: &Value) -> impl Iterator<Item = &Value> {
    list.as_array().into_iter().flatten()
}

/// Texts of licences and notices in a folder.
fn notices(folder: &Path) -> Result<Vec<String>, String> {
    let is_notice = |name: &str| {
        let name = name.to_uppercase();
        ["LICENSE", "LICENCE", "COPYING", "NOTICE"].iter().any(|start| name.starts_with(start))
    };
    let mut texts = texts(folder, is_notice)?;
    // Fonts stand beside their licences.
    let fonts = folder.join("fonts");
    if fonts.is_dir() {
        texts.extend(self::texts(&fonts, |name| name.ends_with(".txt"))?);
    }
    // The Apache licence stands in LICENSE once.
    texts.retain(|text| !text.contains("Apache License"));
    Ok(texts)
}

/// The files of a folder whose names are `wanted`, in order.
fn texts(folder: &Path, wanted: impl Fn(&str) -> bool) -> Result<Vec<String>, String> {
    let wrong = |error| format!("{}: {error}", folder.display());
    let mut files: Vec<_> =
        fs::read_dir(folder).map_err(wrong)?.flatten().map(|entry| entry.path()).collect();
    files.sort();
    files.retain(|path| path.is_file() && wanted(&path.file_name().unwrap_or_default().to_string_lossy()));
    files.iter().map(|path| fs::read_to_string(path).map_err(wrong)).collect()
}
