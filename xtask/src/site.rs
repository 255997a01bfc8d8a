//! The documentation site: one folder of files that any static host serves. Its links are checked, and the code on its pages
//! is compiled or run.

use crate::built::{PROFILE, SAME_FEATURES, document};
use crate::command::{cargo, installed, succeed, target_folder};
use crate::outcome::{Missing, Outcome};
use crate::python;
use crate::web_tools;
use std::path::Path;
use std::process::{Command, Stdio};

/// What decides what the site says, and whether that is so.
pub const INPUTS: &[&str] = &[
    "site",
    "docs",
    "python",
    "src",
    "mjcf",
    "assets",
    "examples",
    "validation",
    "benches",
    "web",
    "README.md",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "THIRD_PARTY.md",
];

/// What blocks of pages need that not every machine has, as the site's program names it, with how to get it.
const NEEDS: [(&str, &str); 3] = [
    ("the Python package", "apt-get install python3-venv"),
    (
        "the npm package in node",
        "rustup target add wasm32-unknown-unknown, install Node.js, and cargo xtask web",
    ),
    (
        "packages that blocks of Python import",
        "target/python/venv/bin/python -m pip install ray torch lerobot imageio",
    ),
];

/// Crates of the workspace that programs use: rustdoc's pages of the others are no part of the site.
const PROGRAMS: [&str; 6] =
    ["robohive_cli", "robohive_digest", "robohive_site", "robohive_validation", "robohive_web", "xtask"];

/// Lints and tests what builds the site, with the programs of its pages, then builds and checks the site.
pub fn run() -> Outcome {
    let package = [&["--profile", PROFILE, "-p", "robohive-site"][..], &SAME_FEATURES].concat();
    cargo(&[&["clippy"][..], &package, &["--all-targets", "--", "-D", "warnings"]].concat())?;
    cargo(&[&["test", "--quiet"][..], &package].concat())?;
    build(&target_folder()?.join("site/html"))
}

/// Builds the site into a folder and checks it.
pub fn build(site: &Path) -> Outcome {
    let target = target_folder()?;
    let programs = ["build", "--profile", PROFILE, "-p", "robohive-site", "-p", "robohive-cli"];
    cargo(&[&programs[..], &SAME_FEATURES].concat())?;
    document()?;
    let api = target.join("site/api");
    published(&target.join("doc"), &api)?;
    let programs = target.join(PROFILE);
    let mut program = Command::new(programs.join("robohive-site"));
    program.arg(site).arg(target.join("site"));
    program.arg("--command").arg(&programs).arg("--api").arg(&api);
    if let Some(python) = python::with_package()? {
        program.arg("--python").arg(python);
    }
    let page = target.join("web");
    if page.join("engine_bg.wasm").is_file() {
        program.arg("--package").arg(page);
    }
    let out = program.stderr(Stdio::inherit()).output().map_err(|error| format!("{program:?}: {error}"))?;
    let printed = String::from_utf8_lossy(&out.stdout).into_owned();
    print!("{printed}");
    if !out.status.success() {
        return Err(format!("the site: {}", out.status));
    }
    println!("{} holds the site", site.display());
    let mut missing: Vec<_> = printed.lines().filter_map(lacking).collect();
    missing.extend(look(site, &target)?);
    Ok(missing)
}

/// Copies rustdoc's pages of the crates that programs use, without sources.
fn published(from: &Path, to: &Path) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("{}: {error}", to.display());
    if to.exists() {
        std::fs::remove_dir_all(to).map_err(failed)?;
    }
    std::fs::create_dir_all(to).map_err(failed)?;
    for entry in std::fs::read_dir(from).map_err(|error| format!("{}: {error}", from.display()))?.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_crate = entry.path().join("all.html").is_file();
        let wanted = if is_crate {
            name.starts_with("robohive") && !PROGRAMS.contains(&&*name)
        } else {
            name != "src"
        };
        if wanted {
            succeed(Command::new("cp").arg("-r").arg(entry.path()).arg(to))?;
        }
    }
    Ok(())
}

/// What a line of the site's program says that this machine lacks.
fn lacking(line: &str) -> Option<Missing> {
    let (what, count) = line.strip_prefix("lacking: ")?.rsplit_once(": ")?;
    let get = NEEDS.iter().find(|(need, _)| *need == what).map_or("see CONTRIBUTING.md", |(_, get)| *get);
    Some(Missing::new(format!("blocks of the site for lack of {what} ({count})"), get))
}

/// Opens pages in a browser, on a desktop and a phone, light and dark, where there is one.
fn look(site: &Path, target: &Path) -> Outcome {
    let tools = web_tools::folder()?;
    let ready = ["node", "chromium"].iter().all(|program| installed(program));
    if !ready || !tools.join("node_modules/playwright-core").is_dir() {
        let get = format!(
            "install node and chromium, and npm install --prefix {} playwright-core",
            tools.display()
        );
        return Ok(vec![Missing::new("the site in a browser", get)]);
    }
    let script = Path::new("site/tests/look.mjs")
        .canonicalize()
        .map_err(|error| format!("site/tests/look.mjs: {error}"))?;
    let site = site.canonicalize().map_err(|error| format!("{}: {error}", site.display()))?;
    let mut node = Command::new("node");
    node.current_dir(tools).arg(script).arg(site).arg("chromium").arg(target.join("site/screenshots"));
    succeed(&mut node).map(|()| Vec::new())
}
