//! Blocks of Python: those of a page run in one interpreter, so that names of one are known to the next.

use super::command::Run;
use crate::block::Block;
use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// The interpreter of a page.
pub struct Interpreter {
    child: Child,
    asked: ChildStdin,
    answered: BufReader<ChildStdout>,
}

impl Interpreter {
    /// Starts `program` in `folder`.
    ///
    /// # Errors
    /// It cannot be started.
    pub fn start(program: &Path, root: &Path, folder: &Path) -> Result<Self, String> {
        let mut command = Command::new(program);
        command.arg(root.join("site/run/interpreter.py")).current_dir(folder);
        command
            .env("ROBOHIVE_STORE", folder.join("store"))
            .env("MINARI_DATASETS_PATH", folder.join("minari"));
        let started = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = started.map_err(|error| format!("{}: {error}", program.display()))?;
        let (Some(asked), Some(answered)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(format!("{} has no standard streams", program.display()));
        };
        Ok(Interpreter { child, asked, answered: BufReader::new(answered) })
    }

    /// Runs a block.
    ///
    /// # Errors
    /// The interpreter has ended.
    pub fn run(&mut self, block: &Block) -> Result<Run, String> {
        let ask = json!({"place": block.place, "code": block.text, "needs": block.marks.needs});
        let ended = |error: std::io::Error| format!("{}: the interpreter has ended: {error}", block.place);
        writeln!(self.asked, "{ask}").and_then(|()| self.asked.flush()).map_err(ended)?;
        let mut line = String::new();
        self.answered.read_line(&mut line).map_err(ended)?;
        let answer: Value = serde_json::from_str(&line)
            .map_err(|error| format!("{}: the interpreter has ended: {error}", block.place))?;
        if answer["lacking"] == json!(true) {
            return Ok(Run::Lacking("packages that blocks of Python import"));
        }
        let printed = answer["printed"].as_str().unwrap_or_default().to_owned();
        Ok(Run::Ended { well: answer["well"] == json!(true), printed })
    }
}

impl Drop for Interpreter {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
