//! Tests of the page: in node beside native builds, as a package of npm, and in a browser.

use crate::built::{EVERYTHING, PROFILE};
use crate::command::{cargo, succeed, target_folder};
use crate::outcome::Outcome;
use crate::web_tools;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Steps of a model whose hash is compared with the native one (an environment makes at most those of an episode), and sides of the
/// picture that is.
const STEPS: &str = "1000";
const SIDES: [&str; 2] = ["320", "240"];

/// Scripts in node alone, and with what npm installs and a browser.
const IN_NODE: [&str; 1] = ["node.mjs"];
const IN_BROWSER: [&str; 6] =
    ["package.mjs", "page.mjs", "drops.mjs", "element.mjs", "memory.mjs", "viewer.mjs"];

/// Runs what this machine can run.
pub fn run(folder: &Path) -> Outcome {
    let missing = web_tools::missing()?;
    let lacks = |what: &str| missing.iter().any(|missing| missing.what.starts_with(what));
    if lacks("the page in node") {
        return Ok(missing);
    }
    let references = references()?;
    let tools = web_tools::folder()?;
    fs::create_dir_all(&tools).map_err(|error| format!("{}: {error}", tools.display()))?;
    let scripts = whole(Path::new("web/tests"))?;
    let arguments = [whole(folder)?, references, STEPS.into(), SIDES[0].into(), SIDES[1].into()];
    let node = |script: &&str| {
        println!("-- {script}");
        let mut command = Command::new("node");
        command.current_dir(&tools).arg(scripts.join(script)).args(&arguments);
        succeed(&mut command)
    };
    IN_NODE.iter().try_for_each(node)?;
    if !lacks("the page in a browser") {
        IN_BROWSER.iter().try_for_each(node)?;
    }
    Ok(missing)
}

/// Native hashes and pictures: the folder that has them.
fn references() -> Result<PathBuf, String> {
    let target = target_folder()?;
    let folder = target.join("web-references");
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    // With the features of all packages, so that other checks have compiled what it needs.
    cargo(&[&["build", "--quiet", "--profile", PROFILE], EVERYTHING, &["--example", "references"]].concat())?;
    let program = target.join(PROFILE).join("examples/references");
    succeed(Command::new(program).arg(&folder).arg(STEPS).args(SIDES))?;
    Ok(folder)
}

fn whole(path: &Path) -> Result<PathBuf, String> {
    path.canonicalize().map_err(|error| format!("{}: {error}", path.display()))
}
