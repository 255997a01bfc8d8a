//! The Python package: its wheel, built and installed into an environment of its own, and its tests there.

use crate::built::{PROFILE, SAME_FEATURES};
use crate::command::{cargo, installed, output, succeed, target_folder};
use crate::outcome::{Missing, Outcome};
use crate::passed::NO_TESTS;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the package is made of.
pub const INPUTS: &[&str] = &["python", "src", NO_TESTS, "mjcf", "assets", "README.md", "THIRD_PARTY.md"];

/// Tests of windows, which miss presses of keys while they wait for a core: nothing else is tested beside them.
const WINDOWS: &str = "python/tests/windows";

/// The oldest Python that the wheel is for.
const OLDEST: &str =
    "import sys; assert sys.version_info >= (3, 10), 'needs Python 3.10'; import venv, ensurepip";

/// The Pythons that one wheel is for, by their minor versions.
const MINOR_VERSIONS: std::ops::RangeInclusive<u32> = 10..=14;

/// Largest wheel \[bytes\].
const LARGEST_WHEEL: u64 = 20_000_000;

/// Texts that the metadata of a wheel carry.
const LICENCES: [&str; 3] = ["licenses/LICENSE", "licenses/THIRD_PARTY.md", "licenses/FONTS.txt"];

/// What a fresh environment does first with an installed wheel; prints how long the imports took \[ms\].
const FIRST_STEP: &str = "
import time
import numpy
start = time.perf_counter()
import robohive
print(f'import robohive took {1e3 * (time.perf_counter() - start):.0f} ms beside numpy')
import gymnasium
env = gymnasium.make('hive/FrankaReach-v0')
env.reset(seed=0)
env.step(env.action_space.sample())
";

/// Lints the extension module, builds the wheel, installs it with what its tests need, checks its types, and runs the tests.
pub fn run() -> Outcome {
    let lint =
        ["clippy", "--profile", PROFILE, "-p", "robohive-python", "--all-targets", "--", "-D", "warnings"];
    succeed(Command::new("cargo").args(lint))?;
    let Some(python) = with_package()? else { return Ok(vec![no_python("the Python package")]) };
    let types = ["-m", "mypy", "--config-file", "python/pyproject.toml", "python/robohive"];
    succeed(Command::new(&python).args(types))?;
    let types = ["-m", "basedpyright", "--project", "python/pyproject.toml", "--pythonpath"];
    succeed(Command::new(&python).args(types).arg(&python))?;
    let robohive = command()?;
    let pytest = |words: &[&str]| {
        let tests = [&["-m", "pytest", "-q"], words].concat();
        succeed(Command::new(&python).args(tests).env("ROBOHIVE_COMMAND", &robohive))
    };
    pytest(&["-n", "logical", "--dist", "loadscope", "--ignore", WINDOWS, "python/tests"])?;
    pytest(&[WINDOWS])?;
    Ok(unchecked(&python))
}

/// The `robohive` command, built, which sessions of tests run.
fn command() -> Result<PathBuf, String> {
    cargo(&[&["build", "--quiet", "--profile", PROFILE, "-p", "robohive-cli"][..], &SAME_FEATURES].concat())?;
    Ok(target_folder()?.join(PROFILE).join(format!("robohive{}", std::env::consts::EXE_SUFFIX)))
}

/// What the tests skip on this machine.
fn unchecked(python: &Path) -> Vec<Missing> {
    let lacks = |(what, program, package): (&str, &str, &str)| {
        (!installed(program)).then(|| {
            Missing::new(format!("{what} (there is no {program})"), format!("apt-get install {package}"))
        })
    };
    let windows = "windows from Python on a virtual display";
    let openxr = "controllers of an OpenXR runtime";
    let programs = [(windows, "Xvfb", "xvfb"), (windows, "xdotool", "xdotool"), (openxr, "cc", "gcc")];
    let mut missing: Vec<Missing> = programs.into_iter().filter_map(lacks).collect();
    if output(Command::new(python).args(["-c", "import xr"])).is_err() {
        missing.push(Missing::new(
            format!("{openxr} (pyopenxr cannot be imported; it needs OpenGL's libGL)"),
            "apt-get install libgl1",
        ));
    }
    missing
}

/// The checkers of learners' libraries, where torch can be imported, which is too large to be installed unasked.
pub fn learners() -> Outcome {
    let requirements = ["--no-deps", "-r", "python/learners/requirements.txt"];
    let (Some(python), Some(builder)) =
        (ready("learners", &requirements)?, ready("venv", &["-r", "python/tests/requirements.txt"])?)
    else {
        return Ok(vec![no_python("Python environments by the checkers of learners")]);
    };
    if output(Command::new(&python).args(["-c", "import torch"])).is_err() {
        return Ok(vec![Missing::new(
            "Python environments by the checkers of Stable-Baselines3 and TorchRL (torch is not installed)",
            format!("{} -m pip install torch", python.display()),
        )]);
    }
    install(&python, &["--force-reinstall", "--no-deps"], &build(&builder, &["--profile", PROFILE])?)?;
    succeed(Command::new(&python).args(["-m", "pytest", "-q", "python/learners"]))?;
    Ok(Vec::new())
}

/// Collection on a real Ray cluster of several nodes, some die on the way, and RLlib's samplers where torch can be imported.
pub fn cluster() -> Outcome {
    let requirements = ["-r", "python/cluster/requirements.txt"];
    let (Some(python), Some(builder)) =
        (ready("cluster", &requirements)?, ready("venv", &["-r", "python/tests/requirements.txt"])?)
    else {
        return Ok(vec![no_python("collection on a Ray cluster")]);
    };
    install(&python, &["--force-reinstall", "--no-deps"], &build(&builder, &["--profile", PROFILE])?)?;
    succeed(Command::new(&python).args(["-m", "pytest", "-q", "-rs", "python/cluster"]))?;
    if output(Command::new(&python).args(["-c", "import torch"])).is_err() {
        return Ok(vec![Missing::new(
            "RLlib over vectors of environments (torch is not installed)",
            format!("{} -m pip install torch", python.display()),
        )]);
    }
    Ok(Vec::new())
}

/// An interpreter with the package, as it is in the sources, and what its tests need; none where there is no Python for it.
pub fn with_package() -> Result<Option<PathBuf>, String> {
    let Some(python) = ready("venv", &["-r", "python/tests/requirements.txt"])? else { return Ok(None) };
    let wheel = build(&python, &["--profile", PROFILE])?;
    carries_licences(&python, &wheel)?;
    install(&python, &["--no-deps", "--force-reinstall"], &wheel)?;
    Ok(Some(python))
}

/// The wheel that is published: for every Linux of the last ten years, of bounded size, the same for every Python, and
/// ready to step in a fresh environment. Prints how long that takes.
pub fn wheel() -> Outcome {
    let Some(builder) = ready("venv", &["-r", "python/tests/requirements.txt", "ziglang"])? else {
        return Ok(vec![no_python("the published wheel")]);
    };
    let wheel = build(&builder, &["--profile", "dist", "--zig", "--compatibility", "manylinux2014"])?;
    let size = std::fs::metadata(&wheel).map_err(|error| format!("{}: {error}", wheel.display()))?.len();
    println!("{} has {:.1} MB", wheel.display(), size as f64 / 1e6);
    if size > LARGEST_WHEEL {
        return Err(format!("the wheel has more than {} MB", LARGEST_WHEEL / 1_000_000));
    }
    carries_licences(&builder, &wheel)?;
    let mut missing = Vec::new();
    for minor in MINOR_VERSIONS {
        let Some(interpreter) = interpreter(minor) else {
            missing.push(Missing::new(
                format!("the wheel on Python 3.{minor} (there is none)"),
                format!("pyenv install 3.{minor}"),
            ));
            continue;
        };
        first_step(&interpreter, &wheel, &format!("python3.{minor}"))?;
    }
    Ok(missing)
}

/// Refuses a wheel without its own licence and the licences of what is inside.
fn carries_licences(python: &Path, wheel: &Path) -> Result<(), String> {
    let (listed, _) = output(Command::new(python).args(["-m", "zipfile", "-l"]).arg(wheel))?;
    let lacks = |name: &&&str| !listed.contains(**name);
    match LICENCES.iter().find(lacks) {
        None => Ok(()),
        Some(name) => Err(format!("{} has no {name}", wheel.display())),
    }
}

/// Makes a fresh environment, installs the wheel with Gymnasium, and takes a step.
fn first_step(interpreter: &Path, wheel: &Path, name: &str) -> Result<(), String> {
    let folder = target_folder()?.join("python").join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    }
    let began = std::time::Instant::now();
    succeed(Command::new(interpreter).args(["-m", "venv"]).arg(&folder))?;
    let python = folder.join("bin/python");
    install(&python, &["gymnasium"], wheel)?;
    succeed(Command::new(&python).args(["-c", FIRST_STEP]))?;
    println!("{name}: from nothing to a step in {:.0} s", began.elapsed().as_secs_f64());
    Ok(())
}

/// A Python of this minor version, on the path or of pyenv.
fn interpreter(minor: u32) -> Option<PathBuf> {
    let name = format!("python3.{minor}");
    let works = |python: &Path| output(Command::new(python).args(["-c", "import venv, ensurepip"])).is_ok();
    let folder = PathBuf::from(std::env::var_os("HOME")?).join(".pyenv/versions");
    let installed = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let found = installed.map(|entry| entry.path().join("bin").join(&name)).find(|path| path.exists());
    found.into_iter().chain([name.into()]).find(|python| works(python))
}

fn no_python(what: &str) -> Missing {
    Missing::new(
        format!("{what} (there is no Python 3.10 or later with venv)"),
        "apt-get install python3-venv",
    )
}

/// The interpreter of a virtual environment of this package's, with what `requirements` name; `None` where this machine
/// has no Python for it.
fn ready(name: &str, requirements: &[&str]) -> Result<Option<PathBuf>, String> {
    if !installed("python3") || output(Command::new("python3").args(["-c", OLDEST])).is_err() {
        return Ok(None);
    }
    let folder = target_folder()?.join("python").join(name);
    let python = folder.join("bin/python");
    if !python.exists() {
        succeed(Command::new("python3").args(["-m", "venv"]).arg(&folder))?;
    }
    pip(&python).args(requirements).status().map_err(|error| format!("pip: {error}")).and_then(|status| {
        if status.success() { Ok(Some(python)) } else { Err(format!("pip install: {status}")) }
    })
}

fn pip(python: &Path) -> Command {
    let mut command = Command::new(python);
    command.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    command
}

fn install(python: &Path, options: &[&str], wheel: &Path) -> Result<(), String> {
    succeed(pip(python).args(options).arg(wheel))
}

/// Builds the wheel with these options of maturin.
fn build(python: &Path, options: &[&str]) -> Result<PathBuf, String> {
    let wheels = target_folder()?.join("python/wheels");
    // Of earlier builds, so that the one found is this one.
    if wheels.exists() {
        std::fs::remove_dir_all(&wheels).map_err(|error| format!("{}: {error}", wheels.display()))?;
    }
    let maturin = ["-m", "maturin", "build", "--manifest-path", "python/Cargo.toml", "--out"];
    // maturin finds zig by the python3 on the path.
    let folder = python.parent().map(Path::to_owned).into_iter();
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(folder.chain(std::env::split_paths(&path)))
        .map_err(|error| format!("PATH: {error}"))?;
    succeed(Command::new(python).args(maturin).arg(&wheels).args(options).env("PATH", path))?;
    let files = std::fs::read_dir(&wheels).into_iter().flatten().flatten();
    let wheel = files.map(|entry| entry.path()).find(|path| path.extension().is_some_and(|end| end == "whl"));
    wheel.ok_or_else(|| format!("maturin left no wheel in {}", wheels.display()))
}
