//! `cargo xtask crash-safety [KILLS]`: recordings of episodes, killed at random moments. Our reader must find every episode
//! that was finished, and so must h5py, where the `python3` on the path (or the program that `PYTHON` names) has it.

use crate::command::{succeed, target_folder};
use std::path::Path;
use std::process::Command;

/// Recordings killed where no number is given.
const KILLS: &str = "200";

/// Kills recordings and reads them.
pub fn run(words: &[&str]) -> Result<(), String> {
    let kills = match *words {
        [] => KILLS,
        [kills] if kills.parse::<u32>().is_ok_and(|kills| kills > 0) => kills,
        _ => return Err("crash-safety takes a number of recordings".into()),
    };
    let folder = target_folder()?.join("crash-safety");
    clear(&folder)?;
    let test = [
        "test",
        "--quiet",
        "--profile",
        "ci",
        "-p",
        "robohive-dataset",
        "--features",
        "hdf5",
        "--test",
        "crash",
    ];
    succeed(Command::new("cargo").args(test).args(["--", kills, "--keep"]).arg(&folder))?;
    let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".into());
    let has_h5py =
        Command::new(&python).args(["-c", "import h5py"]).output().is_ok_and(|out| out.status.success());
    if !has_h5py {
        println!(
            "not opened with h5py: {python} has none (pip install h5py, or name another program in PYTHON)"
        );
        return Ok(());
    }
    succeed(Command::new(python).args(["validation/reference/traces.py", "killed"]).arg(&folder))
}

/// Removes what an earlier run left.
fn clear(folder: &Path) -> Result<(), String> {
    match std::fs::remove_dir_all(folder) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(format!("{}: {error}", folder.display()))
        }
        _ => Ok(()),
    }
}
