//! The page: one folder of files that any static host serves, and its test in node.

use crate::command::{installed, output, succeed, target_folder};
use crate::outcome::{Missing, Outcome};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";
/// Steps whose hash is compared with the native one.
const STEPS: &str = "1000";
/// Files of the page that are written by hand.
const PAGE: &str = "web/page";

/// Builds the page into `folder`, or `web` in the target folder, and tests it in node where there is one.
pub fn run(words: &[&str]) -> Outcome {
    let folder = match words.first() {
        Some(word) => PathBuf::from(word),
        None => target_folder()?.join("web"),
    };
    let profile = "release";
    let flags = "-C target-feature=+simd128";
    let build = ["build", "--profile", profile, "-p", "robohive-web", "--lib", "--target", TARGET];
    succeed(Command::new("cargo").args(build).env("RUSTFLAGS", flags))?;
    let module = target_folder()?.join(TARGET).join(profile).join("robohive_web.wasm");
    bind(&module, &folder)?;
    for entry in fs::read_dir(PAGE).map_err(|error| format!("{PAGE}: {error}"))? {
        let path = entry.map_err(|error| format!("{PAGE}: {error}"))?.path();
        let to = folder.join(path.file_name().unwrap_or_default());
        fs::copy(&path, &to).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    let size = fs::metadata(folder.join("engine_bg.wasm")).map_or(0, |about| about.len());
    println!("{} holds the page; its module has {:.2} MB", folder.display(), size as f64 / 1e6);
    test(&folder)
}

/// Writes the module and its script.
fn bind(module: &Path, folder: &Path) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let mut bindgen = Bindgen::new();
    bindgen.input_path(module).out_name("engine").typescript(true).omit_default_module_path(false);
    bindgen.web(true).and_then(|bindgen| bindgen.generate(folder)).map_err(|error| format!("{error:#}"))
}

/// Compares the module with native builds in node, and drives the page in a browser, where there are these.
fn test(folder: &Path) -> Outcome {
    if !installed("node") {
        return Ok(vec![Missing::new("the page in node", "install Node.js, https://nodejs.org")]);
    }
    let hashes = ["run", "--quiet", "--release", "-p", "robohive-web", "--example", "hashes", "--", STEPS];
    let (native, _) = output(Command::new("cargo").args(hashes))?;
    let place = target_folder()?;
    let file = place.join("web-hashes.json");
    fs::write(&file, native).map_err(|error| format!("{}: {error}", file.display()))?;
    let folder = folder.canonicalize().map_err(|error| format!("{}: {error}", folder.display()))?;
    let scripts = Path::new("web/tests").canonicalize().map_err(|error| error.to_string())?;
    let node = |script: &str| {
        let mut command = Command::new("node");
        command.current_dir(&place).arg(scripts.join(script)).args([&folder, &file]).arg(STEPS);
        command
    };
    succeed(&mut node("node.mjs"))?;
    if !installed("chromium") || !place.join("node_modules/playwright-core").is_dir() {
        let get = format!("install chromium, and npm install --prefix {} playwright-core", place.display());
        return Ok(vec![Missing::new("the page in a browser", get)]);
    }
    succeed(node("page.mjs").args(["chromium".into(), place.join("web-screenshots")])).map(|()| Vec::new())
}
