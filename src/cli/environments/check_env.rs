//! `check-env`: whether environments keep their contract.

use crate::failure::Failure;
use crate::input::library::Making;
use crate::pictures::renderer::RendererArguments;
use crate::terminal::{show, show_verdict};
use clap::Args;
use env::check::{STEPS, check, check_images};
use env::{Registry, Spec};
use indicatif::{ProgressBar, ProgressStyle};
use render::Painters;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Check the contract of environments: finite, repeatable, restorable, observations that change
#[derive(Args)]
#[command(
    after_help = "Every environment is made, plays an episode of seeded random actions twice, is reset with \
other seeds, and returns to a saved state. The table counts those that keep the contract, suite by suite.

Examples:
  robohive check-env classical multi_agent --steps 200   suites; all of them without a name
  robohive check-env hive/FrankaReach-v0                 one id
  robohive check-env hive/FrankaReach_v2d-v0 --visual    images too"
)]
pub struct CheckEnv {
    /// Ids or suites; all without one
    #[arg(value_name = "ID|SUITE")]
    which: Vec<String>,
    /// How they are made
    #[command(flatten)]
    making: Making,
    /// Seed of the episodes
    #[arg(long, value_name = "SEED", default_value_t = 0)]
    seed: u64,
    /// Longest episode [steps]
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    steps: usize,
    /// Draw the images of the visual keys too: finite, not constant, repeatable, restorable
    #[arg(long)]
    visual: bool,
    /// What draws them
    #[command(flatten)]
    renderer: RendererArguments,
    /// Threads; 0 for as many as there are cores
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
}

/// Runs the command.
pub fn run(a: &CheckEnv) -> Result<(), Failure> {
    let specs = chosen(&a.which)?;
    // What is wrong with the arguments is wrong with no environment.
    a.making.options()?;
    let painters = a.renderer.painters_if(a.visual, "--visual")?;
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = if a.threads == 0 { cores } else { a.threads.min(specs.len()) };
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} environments, {eta} left, {msg}");
    let bar = ProgressBar::new(specs.len() as u64)
        .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    let next = AtomicUsize::new(0);
    let work = || {
        let mut found = Vec::new();
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(spec) = specs.get(place) else { return found };
            found.push((place, examine(a, spec, painters.clone())));
            bar.set_message(spec.id.clone());
            bar.inc(1);
        }
    };
    let mut findings: Vec<_> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().expect("a panic ends the command")).collect()
    });
    bar.finish_and_clear();
    findings.sort_by_key(|(place, _)| *place);
    let findings: Vec<_> = findings.into_iter().map(|(_, found)| found).collect();
    report(&specs, &findings)
}

fn chosen(which: &[String]) -> Result<Vec<&'static Spec>, Failure> {
    let registry = Registry::builtin();
    if which.is_empty() {
        return Ok(registry.specs().iter().collect());
    }
    let mut specs: Vec<&Spec> = Vec::new();
    for word in which {
        let suite: Vec<_> = registry.specs().iter().filter(|spec| spec.suite == *word).collect();
        if suite.is_empty() {
            specs.push(registry.spec(word).map_err(Failure::usage)?);
        } else {
            specs.extend(suite);
        }
    }
    Ok(specs)
}

/// What an environment breaks.
fn examine(a: &CheckEnv, spec: &Spec, painters: Arc<dyn Painters>) -> Vec<String> {
    let mut env = match a.making.make_with(&spec.id, painters) {
        Ok(env) => env,
        Err(failure) => return vec![failure.to_string()],
    };
    let mut found = match check(&mut env, a.seed, a.steps) {
        Ok(report) => report.violations.iter().map(ToString::to_string).collect(),
        Err(error) => vec![error.to_string()],
    };
    if a.visual {
        match check_images(&mut env, a.seed) {
            Ok(violations) => found.extend(violations.iter().map(ToString::to_string)),
            Err(error) => found.push(error.to_string()),
        }
    }
    found
}

fn report(specs: &[&Spec], findings: &[Vec<String>]) -> Result<(), Failure> {
    let mut suites: Vec<(&str, usize, usize)> = Vec::new();
    for (spec, found) in specs.iter().zip(findings) {
        found.iter().for_each(|finding| show!("{}: {finding}", spec.id));
        let kept = usize::from(found.is_empty());
        match suites.iter_mut().find(|(suite, ..)| *suite == spec.suite) {
            Some((_, all, good)) => (*all, *good) = (*all + 1, *good + kept),
            None => suites.push((&spec.suite, 1, kept)),
        }
    }
    show!("{:<16} {:>12} {:>18}", "suite", "environments", "keep the contract");
    suites.iter().for_each(|(suite, all, good)| show!("{suite:<16} {all:>12} {good:>18}"));
    let good: usize = suites.iter().map(|(_, _, good)| good).sum();
    show_verdict(
        good == specs.len(),
        "",
        if good == specs.len() { "passed" } else { "failed" },
        &format!(": {good} of {} environments keep their contract", specs.len()),
    );
    if good == specs.len() { Ok(()) } else { Err(Failure::silent(1)) }
}
