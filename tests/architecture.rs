//! What ARCHITECTURE.md promises of the tree: the order of the crates, what each may touch, sizes of files and functions,
//! modules without circles, names that say something, and a description and a reference for every own model.

#[path = "architecture/functions.rs"]
mod functions;
#[path = "architecture/modules.rs"]
mod modules;
#[path = "architecture/signatures.rs"]
mod signatures;
#[path = "architecture/tree.rs"]
mod tree;

use std::collections::{BTreeMap, BTreeSet};
use tree::{Crate, crates, root, sources};

/// Lines of a file.
const FILE: usize = 500;
/// Lines of a function, from its signature to its closing brace.
const FUNCTION: usize = 80;
/// Arguments of a function, `self` among them.
const ARGUMENTS: usize = 7;

/// Every crate with the crates of this repository that it may depend on. What stands in no row does not exist.
const ORDER: [(&str, &[&str]); 38] = [
    ("robohive-physics", &[]),
    ("robohive-workshop", &["physics"]),
    ("robohive-dataset", &[]),
    ("robohive-random", &[]),
    ("robohive-store", &[]),
    ("robohive-video", &[]),
    ("robohive-exchange", &["dataset", "video"]),
    ("robohive-encoders", &["dataset"]),
    ("robohive-mjcf", &["physics"]),
    ("robohive-assets", &["mjcf", "workshop"]),
    ("robohive-rapier", &["physics"]),
    ("robohive-robot", &["physics", "random"]),
    ("robohive-protocol", &[]),
    ("robohive-wire", &["physics", "protocol", "random", "robot"]),
    ("robohive-hardware", &["protocol", "robot"]),
    ("robohive-render", &["physics"]),
    ("robohive-render-gpu", &["physics", "render"]),
    ("robohive-env", &["assets", "physics", "mjcf", "dataset", "random", "robot", "render"]),
    ("robohive-control", &["assets", "physics", "random", "robot", "env"]),
    ("robohive-agents", &["assets", "dataset", "random", "env", "control"]),
    ("robohive-record", &["physics", "dataset", "env"]),
    ("robohive-identify", &["physics", "mjcf", "dataset", "random"]),
    ("robohive-teleop", &["physics", "dataset", "protocol", "robot", "env", "agents", "record"]),
    ("robohive-bevy", &["assets", "rapier", "mjcf", "teleop"]),
    ("robohive", &["physics", "mjcf", "dataset", "random", "robot", "render", "video", "env", "control"]),
    (
        "robohive-validation",
        &[
            "assets",
            "physics",
            "mjcf",
            "dataset",
            "random",
            "robot",
            "render",
            "render_gpu",
            "env",
            "agents",
            "control",
        ],
    ),
    ("robohive-clients", &["mjcf", "protocol", "robot", "wire"]),
    ("robohive-digest", &["agents", "assets", "env", "physics", "mjcf", "render"]),
    (
        "robohive-library",
        &[
            "physics",
            "mjcf",
            "store",
            "robot",
            "protocol",
            "wire",
            "hardware",
            "encoders",
            "env",
            "render",
            "render_gpu",
        ],
    ),
    (
        "robohive-viewer",
        &[
            "assets",
            "physics",
            "mjcf",
            "dataset",
            "random",
            "render",
            "render_gpu",
            "video",
            "env",
            "agents",
            "record",
        ],
    ),
    ("robohive-web", &["physics", "mjcf", "dataset", "record", "render", "env", "agents", "viewer"]),
    ("robohive-web-app", &["env", "agents", "viewer", "robohive-web"]),
    (
        "robohive-python",
        &[
            "assets", "physics", "rapier", "mjcf", "dataset", "random", "robot", "hardware", "library",
            "render", "video", "viewer", "exchange", "env", "agents", "control",
        ],
    ),
    (
        "robohive-cli",
        &[
            "assets",
            "physics",
            "rapier",
            "mjcf",
            "dataset",
            "random",
            "store",
            "robot",
            "protocol",
            "wire",
            "hardware",
            "library",
            "render",
            "render_gpu",
            "video",
            "viewer",
            "exchange",
            "env",
            "record",
            "identify",
            "teleop",
            "agents",
            "control",
            "validation",
        ],
    ),
    ("robohive-site", &["assets", "physics", "mjcf", "env", "viewer"]),
    ("xtask", &[]),
    ("workspace-hack", &[]),
    ("robohive-fuzz", &["physics", "mjcf", "dataset", "random", "robot", "render", "env", "agents"]),
];

/// What the library may use of others: all of it pure Rust.
const OTHERS: [(&str, &[&str]); 24] = [
    ("robohive-assets", &[]),
    ("robohive-physics", &["libm", "rayon"]),
    ("robohive-workshop", &["earcut"]),
    ("robohive-dataset", &["zip", "flate2"]),
    ("robohive-random", &["libm"]),
    ("robohive-store", &["flate2", "lzma-rust2", "sha2", "zip"]),
    (
        "robohive-video",
        &["base64", "crc32fast", "font8x8", "gif", "png", "rusty_h264-common", "rusty_h264-encoder"],
    ),
    ("robohive-exchange", &["parquet", "serde_json"]),
    ("robohive-encoders", &["libm", "ndarray", "rayon", "serde", "serde_json", "zip"]),
    ("robohive-mjcf", &["roxmltree", "fdeflate"]),
    ("robohive-rapier", &["rapier3d-f64", "parry3d-f64", "rapier3d", "rapier3d-mjcf"]),
    ("robohive-robot", &["toml"]),
    ("robohive-protocol", &[]),
    ("robohive-wire", &["rustix"]),
    ("robohive-hardware", &["moq-v4l", "serial2", "zune-jpeg"]),
    ("robohive-render", &["font8x8", "rayon", "wide"]),
    ("robohive-render-gpu", &["bytemuck", "pollster", "wgpu"]),
    ("robohive-env", &["rayon", "serde", "toml"]),
    ("robohive-agents", &["crc", "libm", "safetensors", "serde", "serde_json", "toml", "wide"]),
    ("robohive-control", &["nalgebra"]),
    ("robohive-record", &[]),
    ("robohive-identify", &["nalgebra", "rayon"]),
    ("robohive-teleop", &["rustix", "toml"]),
    ("robohive", &[]),
];

/// What only those who deal with files and machines may touch.
const OUTSIDE: [&str; 5] = ["std::fs", "std::net", "std::env", "std::process", "std::time"];

/// Names that say nothing of what is inside.
const EMPTY_NAMES: [&str; 8] = ["util", "utils", "helper", "helpers", "common", "misc", "shared", "tools"];

/// Files that stand directly in a folder.
const FOLDER: usize = 25;

/// Fails with the list of everything that breaks a rule.
fn none(broken: Vec<String>, rule: &str) {
    assert!(broken.is_empty(), "{rule}:\n{}", broken.join("\n"));
}

#[test]
fn crates_depend_on_those_before_them() {
    let order: BTreeMap<_, _> = ORDER.into_iter().collect();
    let others: BTreeMap<_, _> = OTHERS.into_iter().collect();
    let ours: BTreeSet<_> = [
        "assets",
        "physics",
        "workshop",
        "rapier",
        "mjcf",
        "dataset",
        "random",
        "store",
        "robot",
        "protocol",
        "wire",
        "hardware",
        "env",
        "record",
        "agents",
        "control",
        "teleop",
        "validation",
        "video",
        "exchange",
        "identify",
        "render",
        "encoders",
        "render_gpu",
        "library",
        "robohive",
    ]
    .into();
    let found = crates();
    assert_eq!(found.len(), order.len(), "{:?}", found.iter().map(|c| &c.name).collect::<Vec<_>>());
    let mut broken = Vec::new();
    for Crate { name, dependencies, .. } in &found {
        let allowed = order.get(name.as_str()).unwrap_or_else(|| panic!("{name} has no place in the order"));
        for dependency in dependencies {
            let dependency = dependency.as_str();
            let wrong = if ours.contains(dependency) {
                !allowed.contains(&dependency)
            } else {
                others.get(name.as_str()).is_some_and(|list| !list.contains(&dependency))
            };
            if wrong {
                broken.push(format!("{name} depends on {dependency}"));
            }
        }
    }
    none(broken, "dependencies against the order");
}

#[test]
fn physics_and_random_touch_nothing_outside() {
    let mut broken = Vec::new();
    for folder in ["src/physics", "src/random"] {
        let inside = sources(folder)
            .into_iter()
            .filter(|file| !file.path.contains("/tests/") && !file.path.contains("/examples/"));
        for file in inside {
            for path in modules::Paths::of(&file.syntax()).used.iter().map(|path| path.join("::")) {
                if OUTSIDE.iter().any(|outside| path.starts_with(outside)) {
                    broken.push(format!("{}: {path}", file.path));
                }
            }
        }
    }
    none(broken, "no files, clocks or processes in numeric crates");
}

#[test]
fn files_are_short_enough_to_read() {
    let long = sources("").into_iter().filter_map(|file| {
        let lines = file.text.lines().count();
        (lines > FILE).then(|| format!("{}: {lines} lines", file.path))
    });
    none(long.collect(), "files with too many lines");
}

#[test]
fn folders_are_small_enough_to_read() {
    let mut sizes: BTreeMap<String, usize> = BTreeMap::new();
    for path in ["rs", "py"].into_iter().flat_map(|extension| tree::files("", extension)) {
        let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
        *sizes.entry(folder.to_owned()).or_default() += 1;
    }
    let large = sizes.into_iter().filter(|(folder, files)| *files > FOLDER && !folder.contains("tests"));
    none(
        large.map(|(folder, files)| format!("{folder}: {files} files")).collect(),
        "folders with too many files",
    );
}

#[test]
fn functions_are_short_and_take_few_arguments() {
    let mut broken = Vec::new();
    let mut seen = 0;
    for file in sources("") {
        for f in functions::of(&file.syntax()) {
            seen += 1;
            if f.lines > FUNCTION || f.arguments > ARGUMENTS {
                broken.push(format!(
                    "{}: {} has {} lines, {} arguments",
                    file.path, f.name, f.lines, f.arguments
                ));
            }
        }
    }
    assert!(seen > 1000, "only {seen} functions found");
    none(broken, "functions with too many lines or arguments");
}

#[test]
fn public_functions_have_types_to_rely_on() {
    let mut broken = Vec::new();
    let published = |file: &tree::Source| {
        !["/tests/", "/examples/", "src/cli/"].iter().any(|elsewhere| file.path.contains(elsewhere))
    };
    for file in ["mjcf", "src"].into_iter().flat_map(sources).filter(published) {
        broken.extend(
            signatures::unreliable(&file.syntax()).iter().map(|found| format!("{} {found}", file.path)),
        );
    }
    assert!(broken.is_empty(), "public functions with types to avoid:\n{}", broken.join("\n"));
    let planted = "pub fn a() -> Result<u8, String> { Ok(1) } pub trait T { fn b(&self, t: &toml::Table); }
        impl S { pub fn c(x: Option<Result<u8, String>>) {} fn d() -> Result<u8, String> { Ok(1) } }";
    assert_eq!(signatures::unreliable(&syn::parse_file(planted).unwrap()).len(), 3);
}

#[test]
fn modules_form_no_circle() {
    let found = crates();
    let folders: Vec<_> = found.iter().filter_map(|found| found.modules.as_deref()).collect();
    assert!(folders.len() >= 18, "modules in {folders:?} alone");
    none(folders.into_iter().flat_map(modules::circles).collect(), "modules that need each other");
}

#[test]
fn names_say_what_is_inside() {
    let empty = sources("")
        .into_iter()
        .map(|file| file.path)
        .filter(|path| path.trim_end_matches(".rs").split('/').any(|part| EMPTY_NAMES.contains(&part)));
    none(empty.collect(), "names without a meaning");
}

#[test]
fn python_records_measures_documents_or_belongs_to_the_package() {
    let folders = ["validation/reference/", "benches/", "python/", "site/"];
    let elsewhere = tree::files("", "py")
        .into_iter()
        .filter(|path| !folders.iter().any(|folder| path.starts_with(folder)));
    none(
        elsewhere.collect(),
        "Python beyond recording and measuring MuJoCo, the package and its documentation",
    );
}

#[test]
fn every_own_model_is_described_and_recorded() {
    let models: BTreeSet<String> = assets::models().map(|(name, _)| name.to_owned()).collect();
    assert!(models.len() >= 9, "{models:?}");
    let recorded = tree::files("validation/reference/own", "npz").into_iter();
    let name = |path: String| path.rsplit('/').next().unwrap().trim_end_matches(".npz").to_owned();
    assert_eq!(models, recorded.map(name).collect(), "models and their references");
    let folders = std::fs::read_dir(root().join("assets")).unwrap().map(|entry| entry.unwrap().path());
    let of_models = folders.filter(|folder| folder.is_dir() && !folder.ends_with("tests"));
    let bare = of_models.filter(|folder| {
        std::fs::read_to_string(folder.join("README.md")).map_or(0, |text| text.len()) < 100
    });
    none(
        bare.map(|folder| folder.display().to_string()).collect(),
        "own models without a README that describes them",
    );
}

#[test]
fn the_pinned_compiler_is_the_oldest_supported() {
    let read = |file: &str| std::fs::read_to_string(root().join(file)).unwrap();
    let value = |text: &str, key: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(key).map(str::to_owned)).unwrap();
        line.trim_matches(['=', ' ', '"']).to_owned()
    };
    let (pinned, promised) =
        (value(&read("rust-toolchain.toml"), "channel"), value(&read("Cargo.toml"), "rust-version"));
    assert_eq!(pinned, format!("{promised}.0"));
}
