//! The same bits from every build: unoptimised, with wide vectors, static, and WebAssembly with and without vectors. Each build
//! steps the models of `validation/digest`, draws their pictures, trains its policies and compares its hashes with the recorded ones. And the
//! builds with fewer features.

use crate::built::{PROFILE, SAME_FEATURES};
use crate::command::{cargo, installed, output, succeed, target_folder};
use crate::outcome::{Missing, Outcome};
use crate::passed::NO_TESTS;
use std::path::PathBuf;
use std::process::Command;

/// What decides the hashes, and what the static command is built of.
pub const INPUTS: &[&str] = &["src", NO_TESTS, "mjcf", "assets", "validation/digest"];

const DIGEST: [&str; 2] = ["-p", "robohive-digest"];
/// The target is named, so that flags hold for what is built, and not for procedural macros.
pub const STATIC_TARGET: &str = "x86_64-unknown-linux-gnu";
/// Flags of the static build: as configured, and the C library inside.
const STATIC_FLAGS: &str = "-C target-feature=+avx,+crt-static";
/// The target of WebAssembly modules without a system.
pub const WEB_TARGET: &str = "wasm32-unknown-unknown";

/// The command with TLS, and the library without its default features, here and for WebAssembly where the target is installed.
pub fn features() -> Outcome {
    let tls = [&["-p", "robohive-cli", "--features", "robohive-cli/tls"][..], &SAME_FEATURES].concat();
    cargo(
        &[&["clippy", "--profile", PROFILE, "--all-targets"], &tls[..], &["--", "-D", "warnings"]].concat(),
    )?;
    cargo(&[&["test", "--profile", PROFILE], &tls[..], &["--test", "phone_tls"]].concat())?;
    let bare = ["check", "--profile", PROFILE, "--no-default-features"];
    for package in ["robohive", "robohive-physics", "robohive-render", "robohive-encoders", "robohive-digest"]
    {
        cargo(&[&bare[..], &["-p", package]].concat())?;
    }
    if !web_target_installed()? {
        return Ok(vec![web_target_missing("the library for WebAssembly")]);
    }
    cargo(&[&bare[..], &["-p", "robohive", "--target", WEB_TARGET]].concat())
}

/// Builds and runs all of them. Fails where a build does, or computes another hash than the recorded one.
pub fn run() -> Outcome {
    let mut missing = Vec::new();
    println!("-- unoptimised, two threads");
    digest(&["run", "--quiet"], &["--threads", "2"], "")?;
    println!("-- wide vectors");
    missing.extend(wide_build()?);
    println!("-- static");
    missing.extend(static_build()?);
    missing.extend(web_builds(PROFILE)?);
    Ok(missing)
}

/// The builds that are shipped, with optimisation across crates.
pub fn dist() -> Outcome {
    println!("-- native");
    digest(&["run", "--quiet", "--profile", "dist"], &["--threads", "4"], "")?;
    web_builds("dist")
}

/// Runs cargo over the digest program.
fn digest(cargo: &[&str], program: &[&str], flags: &str) -> Result<(), String> {
    let mut command = Command::new("cargo");
    command.args(cargo).args(DIGEST);
    if !program.is_empty() {
        command.arg("--").args(program);
    }
    if !flags.is_empty() {
        command.env("RUSTFLAGS", flags);
    }
    succeed(&mut command)
}

/// Vectors of four numbers and fused multiply-add: what the compiler may use must not change a bit.
fn wide_build() -> Result<Option<Missing>, String> {
    let has_avx2 = std::fs::read_to_string("/proc/cpuinfo").is_ok_and(|text| text.contains(" avx2 "));
    if cfg!(target_arch = "x86_64") && has_avx2 {
        digest(&["run", "--quiet", "--profile", PROFILE], &[], "-C target-cpu=x86-64-v3")?;
        return Ok(None);
    }
    Ok(Some(Missing::new("the build with wide vectors", "run on an x86-64 processor with AVX2, under Linux")))
}

/// The digest program and the command, each one file that needs no other.
fn static_build() -> Result<Option<Missing>, String> {
    let Some(folder) = static_programs()? else {
        return Ok(Some(Missing::new("the static build", format!("run on {STATIC_TARGET}"))));
    };
    succeed(Command::new(folder.join("robohive-digest")).args(["--threads", "4"]))?;
    let binary = folder.join("robohive");
    let bytes = std::fs::read(&binary).map_err(|e| format!("{}: {e}", binary.display()))?;
    if asks_for_loader(&bytes) {
        return Err(format!("{} is linked dynamically", binary.display()));
    }
    println!("{}: static, {:.1} MB", binary.display(), bytes.len() as f64 / 1e6);
    output(Command::new(&binary).args(["inspect", "assets/franka/franka_table.xml", "--json"]))?;
    Ok(None)
}

/// Builds the digest program and the command, statically and as `cargo run --release` does otherwise; the folder that they
/// are in, or none where they cannot be built.
pub fn static_programs() -> Result<Option<PathBuf>, String> {
    if !cfg!(all(target_arch = "x86_64", target_os = "linux", target_env = "gnu")) {
        return Ok(None);
    }
    let build = ["build", "--quiet", "--release", "--target", STATIC_TARGET, "-p", "robohive-cli"];
    succeed(Command::new("cargo").args(build).args(DIGEST).env("RUSTFLAGS", STATIC_FLAGS))?;
    Ok(Some(target_folder()?.join(STATIC_TARGET).join("release")))
}

/// Whether an ELF file of 64 bits has a segment PT_INTERP, the name of the dynamic loader.
fn asks_for_loader(elf: &[u8]) -> bool {
    let word =
        |at: usize| elf.get(at..at + 8).map_or(0, |b| u64::from_le_bytes(b.try_into().unwrap_or([0; 8])));
    let (table, size, count) = (word(32) as usize, word(54) as usize & 0xffff, word(56) as usize & 0xffff);
    (0..count).any(|k| word(table + k * size) as u32 == 3)
}

/// The digest as a module without and with vectors, under node; with vectors, as pages are, it trains too.
fn web_builds(profile: &str) -> Result<Vec<Missing>, String> {
    println!("-- WebAssembly");
    let mut missing = Vec::from_iter(web_build(profile, "", &[], &["training_"])?);
    println!("-- WebAssembly with vectors");
    let vectors = "-C target-feature=+simd128";
    missing.extend(web_build(profile, vectors, &["--features", "trainings"], &[])?);
    Ok(missing)
}

/// The module of a profile with these flags and features, whose hashes are compared, but for some that are left out.
fn web_build(
    profile: &str,
    flags: &str,
    features: &[&str],
    left_out: &[&str],
) -> Result<Option<Missing>, String> {
    if !web_target_installed()? {
        return Ok(Some(web_target_missing("hashes from WebAssembly")));
    }
    let module = ["--lib", "--crate-type", "cdylib", "--no-default-features", "--target", WEB_TARGET];
    digest(&[&["rustc", "--quiet", "--profile", profile][..], &module, features].concat(), &[], flags)?;
    if !installed("node") {
        return Ok(Some(node_missing("hashes from WebAssembly")));
    }
    let module = target_folder()?.join(WEB_TARGET).join(profile).join("robohive_digest.wasm");
    succeed(Command::new("node").arg("validation/digest/run.mjs").arg(module).args(left_out))?;
    Ok(None)
}

/// Whether the compiler has the target.
pub fn web_target_installed() -> Result<bool, String> {
    let (folder, _) =
        output(Command::new("rustc").args(["--print", "target-libdir", "--target", WEB_TARGET]))?;
    Ok(PathBuf::from(folder.trim()).is_dir())
}

/// Says that something needs the target.
pub fn web_target_missing(what: &str) -> Missing {
    Missing::new(format!("{what} (the target is not installed)"), format!("rustup target add {WEB_TARGET}"))
}

/// Says that something is built and needs node to be run.
pub fn node_missing(what: &str) -> Missing {
    let what = format!("{what} (the module is built; node, which runs it, is not installed)");
    Missing::new(what, "install Node.js, https://nodejs.org")
}
