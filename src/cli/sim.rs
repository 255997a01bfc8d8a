//! `sim`: let a model move.

use crate::arguments::Sim;
use crate::fields::Recorder;
use crate::{Failure, load, start, unwritable};
use dataset::NpzWriter;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::Path;
use std::time::Instant;

const RECORDED: [&str; 7] = ["time", "qpos", "qvel", "act", "ctrl", "sensordata", "energy"];

/// Most steps one run may take.
const MAX_STEPS: f64 = 1e9;

/// Runs the command.
pub fn run(a: &Sim) -> Result<(), Failure> {
    let m = load(&a.model.path, &a.model.reading)?;
    let mut d = start(&m, a.keyframe.as_deref())?;
    let steps = (a.seconds / m.opt.timestep).ceil();
    if !(0.0..=MAX_STEPS).contains(&steps) {
        return Err(Failure::usage(format!(
            "--seconds {} asks for {steps} steps; 0 to {MAX_STEPS:e} can be run",
            a.seconds
        )));
    }
    let mut recorder = match a.out {
        Some(_) => Some(Recorder::new(&m, &d, &RECORDED.map(String::from))?),
        None => None,
    };
    let bar = if a.quiet { ProgressBar::hidden() } else { progress(steps as u64) };
    let began = Instant::now();
    let mut contacts = 0;
    for _ in 0..steps as u64 {
        physics::step(&m, &mut d).map_err(|e| Failure::new(format!("at {:.6} s: {e}", d.state.time)))?;
        contacts = contacts.max(d.con.contact.len());
        if let Some(recorder) = &mut recorder {
            physics::derive_on_demand(&m, &mut d);
            recorder.record(&m, &d);
        }
        bar.inc(1);
    }
    let wall = began.elapsed().as_secs_f64();
    bar.finish_and_clear();
    physics::derive_on_demand(&m, &mut d);
    show!("model        {}", m.name);
    show!("time         {:.6} s in {steps} steps", d.state.time);
    show!("speed        {:.0} steps/s, {:.1} x real time", steps / wall, d.state.time / wall);
    show!("energy       potential {:.6} J, kinetic {:.6} J", d.energy[0], d.energy[1]);
    show!("contacts     {} now, {contacts} at most", d.con.contact.len());
    if let (Some(path), Some(recorder)) = (&a.out, recorder) {
        write(path, recorder)?;
        show!("written      {}", path.display());
    }
    Ok(())
}

fn progress(steps: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {per_sec}, {eta} left")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(steps).with_style(style)
}

fn write(path: &Path, recorder: Recorder) -> Result<(), Failure> {
    let mut writer = NpzWriter::create(path).map_err(unwritable(path))?;
    for (name, array) in recorder.finish() {
        writer.add(&name, &array).map_err(unwritable(path))?;
    }
    writer.finish().map_err(unwritable(path))
}
