//! `cargo xtask crash-safety [KILLS]`: recordings of episodes, killed at random moments: of the recorder alone, and of
//! `robohive run --record`. Our reader must find every episode that was finished, and so must h5py, where the `python3` on the
//! path (or the program that `PYTHON` names) has it.

use crate::command::{cargo, output, succeed, target_folder};
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

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
    kill_runs(&folder, kills.parse().map_err(|error| format!("{kills}: {error}"))?)?;
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

/// Kills `robohive run --record`, each time at another moment of its first half second, and counts the trials that our reader
/// finds. Beside every recording is written, in JSON, how many episodes the command had called finished.
fn kill_runs(folder: &Path, kills: usize) -> Result<(), String> {
    cargo(&["build", "--quiet", "--profile", "ci", "-p", "robohive-cli"])?;
    let robohive = target_folder()?.join("ci").join(format!("robohive{}", std::env::consts::EXE_SUFFIX));
    let (mut finished, mut kept, mut lost, mut killed) = (0, 0, 0, 0);
    // Kills that came before there was a file say nothing and are repeated.
    for attempt in 0..2 * kills {
        if killed == kills {
            break;
        }
        let file = folder.join(format!("run{killed}.h5"));
        let mut run = Command::new(&robohive);
        run.args(["run", "hive/FrankaReach-v0", "--quiet", "--each", "--episodes", "1000000", "--record"])
            .arg(&file);
        let mut child = run.stdout(Stdio::piped()).spawn().map_err(|error| format!("{run:?}: {error}"))?;
        // Steps of a prime cover the half second evenly.
        sleep(Duration::from_millis(30 + (attempt as u64 * 211) % 470));
        child.kill().map_err(|error| error.to_string())?;
        let out = child.wait_with_output().map_err(|error| error.to_string())?;
        let promised = out.stdout.iter().filter(|&&byte| byte == b'\n').count();
        if !file.exists() {
            lost += promised;
            continue;
        }
        let (report, _) = output(Command::new(&robohive).args(["data", "inspect", "--json"]).arg(&file))?;
        let found = report.matches("{\"name\":\"Trial").count();
        std::fs::write(file.with_extension("json"), format!("{{\"finished\": {promised}}}"))
            .map_err(|error| error.to_string())?;
        (finished, kept, killed) = (finished + promised, kept + found, killed + 1);
        lost += promised.saturating_sub(found);
    }
    println!("{killed} runs killed, {finished} episodes finished, {kept} in the files, {lost} lost");
    if lost > 0 || killed < kills {
        Err("robohive run --record lost episodes, or was killed too early".into())
    } else {
        Ok(())
    }
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
