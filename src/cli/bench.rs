//! `bench`: steps per second.

use crate::cli::arguments::Bench;
use crate::cli::{Failure, load, start};
use physics::{Data, Model};
use std::path::Path;
use std::time::Instant;

/// Runs the command.
pub fn run(a: &Bench) -> Result<(), Failure> {
    if a.threads == 0 || a.steps == 0 {
        return Err(Failure::usage("--threads and --steps must be at least 1"));
    }
    for path in &a.models {
        let m = load(path, &[])?;
        let rate = measure(&m, a.steps, a.threads)?;
        report(path, a, rate);
    }
    Ok(())
}

/// Steps per second of `threads` independent simulations together.
fn measure(m: &Model, steps: usize, threads: usize) -> Result<f64, Failure> {
    let data = (0..threads).map(|_| start_still(m)).collect::<Result<Vec<_>, _>>()?;
    let began = Instant::now();
    std::thread::scope(|scope| {
        let workers: Vec<_> =
            data.into_iter().map(|mut d| scope.spawn(move || run_steps(m, &mut d, steps))).collect();
        workers
            .into_iter()
            .try_for_each(|w| w.join().unwrap_or_else(|_| Err(Failure::new("a thread panicked"))))
    })?;
    Ok((steps * threads) as f64 / began.elapsed().as_secs_f64())
}

/// Keyframe 0 where there is one, else `qpos0`; zero controls.
fn start_still(m: &Model) -> Result<Data, Failure> {
    let mut d = start(m, None)?;
    d.state.ctrl.fill(0.0);
    Ok(d)
}

fn run_steps(m: &Model, d: &mut Data, steps: usize) -> Result<(), Failure> {
    for _ in 0..steps {
        physics::step(m, d).map_err(|e| Failure::new(format!("{}: at {:.6} s: {e}", m.name, d.time)))?;
    }
    Ok(())
}

fn report(path: &Path, a: &Bench, rate: f64) {
    if a.json {
        let line = serde_json::json!({
            "model": path.display().to_string(),
            "steps": a.steps,
            "threads": a.threads,
            "steps_per_second": rate,
        });
        println!("{line}");
    } else {
        println!("{:>10.0} steps/s  {} thread(s)  {}", rate, a.threads, path.display());
    }
}
