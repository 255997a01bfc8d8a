//! What a model reads under the controls of a log.

use crate::command::controls;
use crate::log::Log;
use crate::window::Window;
use physics::{Data, Model, StepError, forward, step};

/// Why there are no readings: the time \[s\], and what happened.
pub(crate) type Failed = (f64, StepError);

/// Readings at the rows of a window, in the columns of the log; between two steps they are interpolated.
pub(crate) fn simulate(m: &Model, log: &Log, window: Window, delay: f64) -> Result<Vec<f64>, Failed> {
    let mut d = Data::new(m);
    let width = m.nq + m.nv + m.na;
    let state = &log.states[window.first * width..(window.first + 1) * width];
    let (qpos, rest) = state.split_at(m.nq);
    let (qvel, act) = rest.split_at(m.nv);
    d.state.qpos.copy_from_slice(qpos);
    d.state.qvel.copy_from_slice(qvel);
    d.state.act.copy_from_slice(act);
    let (dt, start) = (m.opt.timestep, log.times[window.first]);
    d.state.time = start;
    let mut out = Vec::with_capacity((window.end - window.first) * log.readings.width());
    let (mut before, mut after): (Vec<f64>, Vec<f64>) = (Vec::new(), Vec::new());
    let mut taken = 0_u32;
    for row in window.first..window.end {
        let at = log.times[row];
        // Readings of a state are measured by the step from it.
        while after.is_empty() || at > start + f64::from(taken - 1) * dt + 1e-6 * dt {
            let now = start + f64::from(taken) * dt;
            controls(log, delay, now, now + dt, &mut d.state.ctrl);
            std::mem::swap(&mut before, &mut after);
            let positions = (!log.readings.of_sensors).then(|| read(&d.state.qpos, log));
            if row + 1 == window.end && at <= now + 1e-6 * dt {
                forward(m, &mut d).map_err(|error| (now, error))?;
            } else {
                step(m, &mut d).map_err(|error| (now, error))?;
            }
            after = positions.unwrap_or_else(|| read(&d.sensor.sensordata, log));
            taken += 1;
        }
        let last = start + f64::from(taken - 1) * dt;
        let share = ((last - at) / dt).clamp(0.0, 1.0);
        if share < 1e-6 || before.is_empty() {
            out.extend_from_slice(&after);
        } else {
            out.extend(before.iter().zip(&after).map(|(a, b)| b + share * (a - b)));
        }
    }
    Ok(out)
}

/// The columns of a log in an array.
fn read(from: &[f64], log: &Log) -> Vec<f64> {
    log.readings.columns.iter().map(|&column| from[column]).collect()
}
