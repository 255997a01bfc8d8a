//! Blocks that are programs: of the shell and of node.

use super::runners::Runners;
use crate::block::Block;
use crate::stage::save;
use std::fs::File;
use std::path::Path;
use std::process::{Child, Command, ExitStatus};
use std::time::{Duration, Instant};

/// Longest time of a block.
const LIMIT: Duration = Duration::from_secs(120);

/// How a block ended.
pub enum Run {
    /// It ran, well or not, and printed something.
    Ended {
        /// Whether it succeeded.
        well: bool,
        /// Standard output and standard error.
        printed: String,
    },
    /// This machine lacks what runs it.
    Lacking(&'static str),
}

impl Run {
    /// A block that did not succeed, with the reason.
    pub fn failed(reason: String) -> Self {
        Run::Ended { well: false, printed: reason }
    }
}

/// Runs a block of the shell, with the command in its path and no models of others.
pub fn shell(runners: &Runners, folder: &Path, block: &Block) -> Result<Run, String> {
    let Some(programs) = &runners.command else { return Ok(Run::Lacking("the command")) };
    let mut command = Command::new("sh");
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(programs.clone()).chain(std::env::split_paths(&path)))
        .map_err(|error| format!("PATH: {error}"))?;
    command.args(["-euc", &block.text]).env("PATH", path).env("ROBOHIVE_STORE", folder.join("store"));
    ended(command, folder)
}

/// Runs a module of JavaScript in node, where the page was built.
pub fn javascript(runners: &Runners, folder: &Path, block: &Block) -> Result<Run, String> {
    let has_node = || Command::new("node").arg("--version").output().is_ok_and(|out| out.status.success());
    if runners.package.is_none() || !has_node() {
        return Ok(Run::Lacking("the npm package in node"));
    }
    let line = block.place.rsplit(':').next().unwrap_or_default();
    let file = folder.join(format!("line-{line}.mjs"));
    save(&file, block.text.as_bytes())?;
    let mut command = Command::new("node");
    command.arg(&file);
    ended(command, folder)
}

/// Waits for a program in `folder`, not longer than [`LIMIT`].
fn ended(mut command: Command, folder: &Path) -> Result<Run, String> {
    let file = folder.join(".printed");
    let failed = |error: std::io::Error| format!("{command:?}: {error}");
    let out = File::create(&file).map_err(failed)?;
    let errors = out.try_clone().map_err(failed)?;
    let mut child = command
        .current_dir(folder)
        .stdin(std::process::Stdio::null())
        .stdout(out)
        .stderr(errors)
        .spawn()
        .map_err(|e| format!("{command:?}: {e}"))?;
    let status = wait(&mut child).map_err(|e| format!("{command:?}: {e}"))?;
    let printed =
        std::fs::read(&file).map_or(String::new(), |bytes| String::from_utf8_lossy(&bytes).into_owned());
    Ok(match status {
        None => Run::failed(format!("it ran for more than {} s\n{printed}", LIMIT.as_secs())),
        Some(status) => Run::Ended { well: status.success(), printed },
    })
}

fn wait(child: &mut Child) -> std::io::Result<Option<ExitStatus>> {
    let began = Instant::now();
    while began.elapsed() < LIMIT {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    child.kill()?;
    child.wait()?;
    Ok(None)
}
