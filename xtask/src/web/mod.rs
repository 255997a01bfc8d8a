//! The page: one folder of files that any static host serves and that is the npm package, and its tests.

mod bind;
mod checks;
mod files;
mod notices;
mod offline;

use crate::command::{installed, succeed, target_folder};
use crate::outcome::Outcome;
use files::{copy, copy_all, remove, write};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the module is compiled for.
const TARGET: &str = "wasm32-unknown-unknown";
/// How modules are built.
const PROFILE: &str = "page";
/// The modules: the package, the name of its script, and what it compiles to.
const MODULES: [(&str, &str, &str); 2] = [
    ("robohive-web", "engine", "robohive_web.wasm"),
    ("robohive-web-app", "viewer", "robohive_web_app.wasm"),
];
/// Files of the page that are written by hand.
const PAGE: &str = "web/page";

/// Policies that a page fetches when it is asked for one.
const POLICIES: &str = "assets/policies/hive";

/// Builds the page into `folder`, or `web` in the target folder, and tests it as far as this machine can.
pub fn run(words: &[&str]) -> Outcome {
    let folder = match words.first() {
        Some(word) => PathBuf::from(word),
        None => target_folder()?.join("web"),
    };
    build(&folder)?;
    println!("{} holds the page", folder.display());
    checks::run(&folder)
}

fn build(folder: &Path) -> Result<(), String> {
    let packages = MODULES.iter().flat_map(|(package, _, _)| ["-p", package]);
    let mut build = Command::new("cargo");
    build.args(["build", "--profile", PROFILE, "--lib", "--target", TARGET]).args(packages);
    succeed(build.env("RUSTFLAGS", "-C target-feature=+simd128"))?;
    for (_, name, file) in MODULES {
        bind::bind(&target_folder()?.join(TARGET).join(PROFILE).join(file), name, folder)?;
    }
    copy_all(Path::new(PAGE), folder)?;
    copy_all(Path::new(POLICIES), &folder.join("policies/hive"))?;
    copy(Path::new("LICENSE"), &folder.join("LICENSE"))?;
    write(&folder.join("THIRD_PARTY.txt"), &notices::of("robohive-web-app", TARGET)?)?;
    write_made(folder)
}

/// Writes what is made of the others.
fn write_made(folder: &Path) -> Result<(), String> {
    match installed("node") {
        true => offline::inline(folder)?,
        false => remove(&folder.join("inline.js"))?,
    }
    offline::version(folder)
}
