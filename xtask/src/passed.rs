//! At which commit each long check last passed, in a file of the repository, so that a check whose inputs have not changed
//! since need not run again.

use crate::command::output;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::process::Command;

/// Leaves tests of crates out of the inputs of a check that does not run them.
pub const NO_TESTS: &str = ":(exclude,glob)src/**/tests/**";

/// One line a check: its name and the commit.
const FILE: &str = "xtask/passed.txt";

/// Decides the outcome of every check.
const ALWAYS: [&str; 5] = ["Cargo.toml", "Cargo.lock", "rust-toolchain.toml", ".cargo", "xtask/src"];

/// The commits at which checks passed.
pub struct Record {
    commits: BTreeMap<String, String>,
    changed: bool,
}

impl Record {
    /// What the file says; nothing without a file.
    pub fn read() -> Result<Self, String> {
        let text = match std::fs::read_to_string(FILE) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            read => read.map_err(|error| format!("{FILE}: {error}"))?,
        };
        let line = |line: &str| {
            let words =
                line.split_once(' ').map(|(name, commit)| (name.to_owned(), commit.trim().to_owned()));
            words.ok_or_else(|| format!("{FILE}: {line:?} is not a name and a commit"))
        };
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        Ok(Record { commits: lines.map(line).collect::<Result<_, _>>()?, changed: false })
    }

    /// The commit at which check `name` passed, where no file of `inputs` differs from it, committed or not.
    pub fn unchanged_since(&self, name: &str, inputs: &[&str]) -> Option<String> {
        let commit = self.commits.get(name).filter(|_| !inputs.is_empty())?;
        let differs = git(&["diff", "--quiet", commit, "--"], inputs).is_err() || has_uncommitted(inputs);
        (!differs).then(|| commit.clone())
    }

    /// Records that check `name` passed at the commit that is checked out, unless a file of `inputs` differs from it.
    pub fn passed(&mut self, name: &str, inputs: &[&str]) {
        if inputs.is_empty() || has_uncommitted(inputs) {
            return;
        }
        if let Ok(commit) = git(&["rev-parse", "--short=12", "HEAD"], &[]) {
            self.commits.insert(name.to_owned(), commit.trim().to_owned());
            self.changed = true;
        }
    }

    /// Writes the file where a check passed.
    pub fn write(&self) -> Result<(), String> {
        if !self.changed {
            return Ok(());
        }
        let mut text =
            String::from("# Commits at which long checks passed, written by `cargo xtask long`.\n");
        self.commits.iter().for_each(|(name, commit)| _ = writeln!(text, "{name} {commit}"));
        std::fs::write(FILE, text).map_err(|error| format!("{FILE}: {error}"))
    }
}

/// Whether one of `inputs` has changes that no commit holds; true where git does not tell.
fn has_uncommitted(inputs: &[&str]) -> bool {
    git(&["status", "--porcelain", "--"], inputs).map_or(true, |changes| !changes.trim().is_empty())
}

/// What git prints, asked of `inputs` and what all checks depend on.
fn git(words: &[&str], inputs: &[&str]) -> Result<String, String> {
    let mut command = Command::new("git");
    command.args(words);
    if words.last() == Some(&"--") {
        command.args(inputs).args(ALWAYS);
    }
    output(&mut command).map(|(printed, _)| printed)
}
