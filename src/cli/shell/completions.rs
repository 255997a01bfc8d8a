//! `completions`: what a shell completes.

use crate::failure::Failure;

use crate::terminal::write_bytes;
use clap::Args;

/// Print completions for a shell
#[derive(Args)]
#[command(after_help = "Put the script where the shell looks for it, and start a new shell.

Examples:
  robohive completions bash > ~/.local/share/bash-completion/completions/robohive
  robohive completions zsh > ~/.zfunc/_robohive
  robohive completions fish > ~/.config/fish/completions/robohive.fish")]
pub struct Completions {
    /// The shell
    pub shell: clap_complete::Shell,
}

/// Runs `completions` for the words of `command`.
pub fn run(a: &Completions, mut command: clap::Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(a.shell, &mut command, "robohive", &mut script);
    write_bytes(&script);
    Ok(())
}
