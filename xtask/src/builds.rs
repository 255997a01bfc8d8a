//! The same bits from every build: unoptimised, with wide vectors, static, and WebAssembly. Each build steps the
//! models of `validation/digest` and compares its hashes with the recorded ones.

use crate::Trouble::{self, CannotCheck, Failed};
use std::path::PathBuf;
use std::process::Command;

const DIGEST: [&str; 2] = ["-p", "robohive-digest"];
const STATIC_TARGET: &str = "x86_64-unknown-linux-gnu";
const WEB_TARGET: &str = "wasm32-unknown-unknown";

/// Builds and runs all of them. Fails where a build does, or computes another hash than the recorded one.
pub fn run() -> Result<(), Trouble> {
    let passed_over = every_build().map_err(Failed)?;
    if passed_over.is_empty() { Ok(()) } else { Err(CannotCheck(passed_over.join("; "))) }
}

/// What this machine cannot build or run, each with the reason.
fn every_build() -> Result<Vec<String>, String> {
    let mut passed_over = Vec::new();
    println!("-- in another program");
    succeed(Command::new("cargo").args(["run", "--quiet", "--profile", "ci", "--example", "embed"]))?;
    println!("-- unoptimised, two threads");
    digest(&["run", "--quiet"], &["--threads", "2"], "")?;
    if cfg!(target_arch = "x86_64") {
        println!("-- wide vectors");
        match std::fs::read_to_string("/proc/cpuinfo") {
            Ok(text) if text.contains(" avx2 ") => {
                digest(&["run", "--quiet", "--profile", "ci"], &[], "-C target-cpu=x86-64-v3")?;
            }
            _ => passed_over.push("wide vectors: the processor has none, or does not say".into()),
        }
    }
    if cfg!(all(target_arch = "x86_64", target_os = "linux", target_env = "gnu")) {
        println!("-- static");
        static_build()?;
    }
    println!("-- WebAssembly");
    passed_over.extend(web_build()?.map(|reason| format!("WebAssembly: {reason}")));
    Ok(passed_over)
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

/// The digest program and the command line, each one file that needs no other.
fn static_build() -> Result<(), String> {
    let flags = "-C target-feature=+crt-static";
    digest(&["run", "--quiet", "--release", "--target", STATIC_TARGET], &["--threads", "4"], flags)?;
    let arguments = ["build", "--quiet", "--profile", "ci", "-p", "robohive-cli", "--target", STATIC_TARGET];
    succeed(Command::new("cargo").args(arguments).env("RUSTFLAGS", flags))?;
    let binary = target_folder()?.join(STATIC_TARGET).join("ci/robohive");
    let bytes = std::fs::read(&binary).map_err(|e| format!("{}: {e}", binary.display()))?;
    if asks_for_loader(&bytes) {
        return Err(format!("{} is linked dynamically", binary.display()));
    }
    println!("{}: static, {:.1} MB", binary.display(), bytes.len() as f64 / 1e6);
    let model = ["inspect", "assets/franka/franka_table.xml", "--json"];
    let output = Command::new(&binary).args(model).output().map_err(|e| e.to_string())?;
    if output.status.success() { Ok(()) } else { Err(format!("{}: {}", binary.display(), output.status)) }
}

/// Whether an ELF file of 64 bits has a segment PT_INTERP, the name of the dynamic loader.
fn asks_for_loader(elf: &[u8]) -> bool {
    let word =
        |at: usize| elf.get(at..at + 8).map_or(0, |b| u64::from_le_bytes(b.try_into().unwrap_or([0; 8])));
    let (table, size, count) = (word(32) as usize, word(54) as usize & 0xffff, word(56) as usize & 0xffff);
    (0..count).any(|k| word(table + k * size) as u32 == 3)
}

/// The module under node; a reason where the target or node is not installed.
fn web_build() -> Result<Option<String>, String> {
    let query = ["--print", "target-libdir", "--target", WEB_TARGET];
    let folder = Command::new("rustc").args(query).output().map_err(|e| e.to_string())?;
    if !PathBuf::from(String::from_utf8_lossy(&folder.stdout).trim()).is_dir() {
        return Ok(Some(format!("rustup target add {WEB_TARGET}")));
    }
    let module = ["--lib", "--crate-type", "cdylib", "--no-default-features", "--target", WEB_TARGET];
    digest(&[&["rustc", "--quiet", "--release"][..], &module].concat(), &[], "")?;
    if Command::new("node").arg("--version").output().is_err() {
        return Ok(Some("built; node is not installed".into()));
    }
    let module = target_folder()?.join(WEB_TARGET).join("release/robohive_digest.wasm");
    succeed(Command::new("node").arg("validation/digest/run.mjs").arg(module))?;
    Ok(None)
}

fn target_folder() -> Result<PathBuf, String> {
    let arguments = ["metadata", "--no-deps", "--format-version", "1"];
    let output = Command::new("cargo").args(arguments).output().map_err(|e| e.to_string())?;
    let text = String::from_utf8_lossy(&output.stdout);
    let folder = text.split_once("\"target_directory\":\"").and_then(|(_, rest)| rest.split_once('"'));
    folder.map(|(folder, _)| folder.into()).ok_or_else(|| "cargo names no target directory".into())
}

fn succeed(command: &mut Command) -> Result<(), String> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{command:?}: {status}")),
        Err(error) => Err(format!("{command:?}: {error}")),
    }
}
