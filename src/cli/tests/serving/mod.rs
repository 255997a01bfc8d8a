//! Simulated servos that another process serves on a pseudo-terminal.

use crate::command::{command, scratch};
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};

/// An environment whose robot they are.
pub const ID: &str = "hive/QuadrupedWalk-v0";
/// Its config.
pub const CONFIG: &str = "assets/quadruped/servos.toml";

/// `robohive wire` in the background.
pub struct Wire {
    child: Child,
    /// The robot's config with their addresses.
    pub config: PathBuf,
}

impl Wire {
    pub fn new(name: &str, more: &[&str]) -> Wire {
        let config = scratch(name);
        std::fs::remove_file(&config).unwrap_or_default();
        let mut wire = command();
        wire.args(["wire", "--config", CONFIG, "--env", ID, "--out"]).arg(&config).args(more);
        let mut child = wire.stdout(Stdio::piped()).spawn().unwrap();
        let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
        let ready = lines.find(|line| line.as_ref().unwrap().starts_with("config: "));
        assert!(ready.is_some(), "the config was written");
        Wire { child, config }
    }

    /// Ends it, and with it the pseudo-terminal.
    pub fn kill(&mut self) {
        self.child.kill().unwrap_or_default();
        self.child.wait().unwrap();
    }

    pub fn robohive(&self, before: &[&str], after: &[&str]) -> Command {
        let mut command = command();
        command.args(before).arg(&self.config).args(after);
        command
    }
}

impl Drop for Wire {
    fn drop(&mut self) {
        self.kill();
    }
}
