//! Every test of the workspace. The programs that cargo builds of tests run several at a time, each in the folder of its
//! package, since most of them are short and some leave cores idle; documentation is tested by cargo.

use crate::built::{EVERYTHING, PROFILE};
use crate::command::cargo;
use crate::outcome::Outcome;
use crate::tolerances;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::time::Instant;

/// Programs named in the account of the slowest.
const SLOWEST: usize = 8;

/// A program of tests.
struct Program {
    executable: PathBuf,
    /// Folder of its package.
    folder: PathBuf,
}

/// A program that has run.
struct Finished {
    name: String,
    seconds: f64,
    printed: String,
    passed: bool,
}

/// Builds and runs all tests, and compares the tolerances with what the tests have measured. A failure does not keep other
/// tests from running.
pub fn run() -> Outcome {
    let mut finished = run_programs(build()?);
    finished.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    println!("-- the slowest of {} programs of tests", finished.len());
    finished.iter().take(SLOWEST).for_each(|one| println!("{:>6.1} s  {}", one.seconds, one.name));
    let failed: Vec<_> = finished.iter().filter(|one| !one.passed).map(|one| one.name.as_str()).collect();
    let tests = match failed.is_empty() {
        true => tolerances::check(finished.iter().map(|one| one.printed.as_str())),
        false => Err(format!("tests of {}", failed.join(", "))),
    };
    println!("-- documentation");
    let documentation = cargo(&[&["test", "--doc", "--quiet", "--profile", PROFILE], EVERYTHING].concat());
    match (tests, documentation) {
        (Ok(()), documentation) => documentation,
        (Err(tests), Ok(_)) => Err(tests),
        (Err(tests), Err(documentation)) => Err(format!("{tests}; {documentation}")),
    }
}

/// Builds tests and examples.
fn build() -> Result<Vec<Program>, String> {
    let mut command = Command::new("cargo");
    command.args(["test", "--no-run", "--profile", PROFILE, "--message-format", "json-render-diagnostics"]);
    let out = command.args(EVERYTHING).stderr(std::process::Stdio::inherit()).output();
    let out = out.map_err(|error| format!("{command:?}: {error}"))?;
    if !out.status.success() {
        return Err(format!("{command:?}: {}", out.status));
    }
    let messages = String::from_utf8_lossy(&out.stdout);
    let tests = messages.lines().filter(|line| line.contains("\"overflow_checks\":true,\"test\":true}"));
    let program = |line: &str| {
        let executable = PathBuf::from(field(line, "executable")?);
        Some(Program { executable, folder: Path::new(field(line, "manifest_path")?).parent()?.to_owned() })
    };
    let programs: Vec<_> = tests.filter_map(program).collect();
    match programs.is_empty() {
        true => Err("cargo names no program of tests".into()),
        false => Ok(programs),
    }
}

/// The text of a field of a line of JSON, which holds no escaped characters.
fn field<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = line.split_once(&format!("\"{name}\":\""))?;
    rest.split_once('"').map(|(text, _)| text)
}

/// Runs the programs, as many at a time as there are cores.
fn run_programs(programs: Vec<Program>) -> Vec<Finished> {
    let cores = std::thread::available_parallelism().map_or(1, |cores| cores.get());
    let (waiting, finished) = (Mutex::new(programs), Mutex::new(Vec::new()));
    let next = || waiting.lock().ok().and_then(|mut programs| programs.pop());
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(|| {
                while let Some(program) = next() {
                    let done = run_one(&program);
                    print!("{}", summary(&done));
                    if let Ok(mut finished) = finished.lock() {
                        finished.push(done);
                    }
                }
            });
        }
    });
    finished.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// Runs a program with what cargo tells tests of their package.
fn run_one(program: &Program) -> Finished {
    let began = Instant::now();
    let mut command = Command::new(&program.executable);
    command.arg("--show-output").current_dir(&program.folder).env("CARGO_MANIFEST_DIR", &program.folder);
    // References from outside the repository are for runs that name them.
    command.env_remove("ROBOHIVE_REFERENCES");
    let stem = program.executable.file_stem().unwrap_or_default().to_string_lossy();
    let package = program.folder.file_name().unwrap_or_default().to_string_lossy();
    let name = format!("{package}: {}", stem.rsplit_once('-').map_or(&*stem, |(name, _)| name));
    let (passed, printed) = match command.output() {
        Ok(out) => {
            let texts = [&out.stdout, &out.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
            (out.status.success(), texts.concat())
        }
        Err(error) => (false, format!("{command:?}: {error}")),
    };
    Finished { name, seconds: began.elapsed().as_secs_f64(), printed, passed }
}

/// One line for a program that passed, everything that it printed for one that failed.
fn summary(done: &Finished) -> String {
    let verdict = done.printed.lines().rfind(|line| line.starts_with("test result:"));
    match done.passed {
        // A program that brings its own harness says nothing.
        true => format!("{}: {}\n", done.name, verdict.unwrap_or("passed")),
        false => format!("{}: FAILED\n{}\n", done.name, done.printed),
    }
}
