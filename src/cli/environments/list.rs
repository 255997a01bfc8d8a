//! `list`: which environments there are.

use crate::failure::Failure;
use crate::terminal::{listed, show, show_json};
use clap::Args;
use env::{Registry, Spec};
use serde_json::json;

/// List environments
#[derive(Args)]
#[command(after_help = "Examples:
  robohive list                 every suite with its environments
  robohive list quadrupeds      one suite
  robohive list --only Random   ids that contain a text
  robohive list --json | jq -r .[].id")]
pub struct List {
    /// Suite; all without one
    #[arg(value_name = "SUITE")]
    suite: Option<String>,
    /// Show only ids that contain this text
    #[arg(long, value_name = "TEXT", default_value = "")]
    only: String,
    /// Print one JSON array instead
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(a: &List) -> Result<(), Failure> {
    let registry = Registry::builtin();
    let mut suites: Vec<&str> = Vec::new();
    for spec in registry.specs() {
        if !suites.contains(&spec.suite.as_str()) {
            suites.push(&spec.suite);
        }
    }
    if let Some(suite) = a.suite.as_deref().filter(|suite| !suites.contains(suite)) {
        return Err(Failure::usage(format!("there is no suite {suite:?}; there are {}", listed(suites, 20))));
    }
    let wanted =
        |spec: &&Spec| spec.id.contains(&a.only) && a.suite.as_ref().is_none_or(|suite| *suite == spec.suite);
    let specs: Vec<&Spec> = registry.specs().iter().filter(wanted).collect();
    if a.json {
        let rows: Vec<_> = specs
            .iter()
            .map(|spec| {
                json!({"id": spec.id, "suite": spec.suite, "task": spec.task, "max_episode_steps": spec.max_episode_steps})
            })
            .collect();
        show_json(&rows.into());
        return Ok(());
    }
    for suite in suites {
        let rows: Vec<_> = specs.iter().filter(|spec| spec.suite == suite).collect();
        if rows.is_empty() {
            continue;
        }
        show!("{suite} ({})", rows.len());
        rows.iter().for_each(|spec| show!("  {:<44} {:>5} steps", spec.id, spec.max_episode_steps));
    }
    show!("{} environments; `robohive info ID` describes one", specs.len());
    Ok(())
}
