//! What tests of the page need beside the compiler: node, a browser, and packages of npm.

use crate::command::{installed, target_folder};
use crate::outcome::Missing;
use std::path::PathBuf;

/// Packages of npm that tests use: what drives a browser, checks types, and bundles.
pub const PACKAGES: [(&str, &str); 3] = [("playwright-core", "1.65"), ("typescript", "5.9"), ("vite", "7.3")];

/// The folder that they are in.
pub fn folder() -> Result<PathBuf, String> {
    target_folder().map(|folder| folder.join("web-tools"))
}

/// What this machine lacks.
pub fn missing() -> Result<Vec<Missing>, String> {
    if !installed("node") {
        return Ok(vec![Missing::new("the page in node", "install Node.js, https://nodejs.org")]);
    }
    let folder = folder()?;
    let there = |package: &str| folder.join("node_modules").join(package).is_dir();
    let mut missing = Vec::new();
    if PACKAGES.iter().any(|(package, _)| !there(package)) {
        let names: Vec<_> =
            PACKAGES.iter().map(|(package, version)| format!("{package}@{version}")).collect();
        let get = format!("npm install --prefix {} {}", folder.display(), names.join(" "));
        missing.push(Missing::new("the page in a browser, and the package of npm", get));
    }
    if !installed("chromium") {
        missing.push(Missing::new("the page in a browser", "apt-get install chromium"));
    }
    Ok(missing)
}
