//! Controls as a robot gets them: held from row to row, and late.

use crate::log::Log;

/// The mean of a log's controls over a time, `nu` numbers: with a delay, a step sees the end of one control and the beginning of
/// the next, in shares that change with the delay without jumps.
pub(crate) fn controls(log: &Log, delay: f64, from: f64, until: f64, out: &mut [f64]) {
    out.fill(0.0);
    let width = out.len();
    let (from, until) = (from - delay, until - delay);
    let slack = 1e-9 * (until - from);
    let row_at = |time: f64| log.times.partition_point(|&t| t <= time).max(1) - 1;
    let mut row = row_at(from + slack);
    let mut now = from;
    loop {
        let next = log.times.get(row + 1).map_or(f64::INFINITY, |&t| t);
        let last = next >= until - slack;
        let end = if last { until } else { next };
        let share = (end - now) / (until - from);
        for (sum, value) in out.iter_mut().zip(&log.ctrl[row * width..]) {
            *sum += share * value;
        }
        if last {
            return;
        }
        (now, row) = (end, row + 1);
    }
}

#[cfg(test)]
mod tests {
    use super::controls;
    use crate::log::{Log, Readings};

    fn log() -> Log {
        let readings = Readings {
            names: vec![],
            columns: vec![],
            of_sensors: true,
            quaternions: vec![],
            values: vec![],
        };
        Log {
            name: String::new(),
            times: vec![0.0, 0.1, 0.2, 0.3],
            ctrl: vec![1.0, 2.0, 4.0, 8.0],
            readings,
            states: vec![],
        }
    }

    #[test]
    fn a_step_gets_the_mean_of_what_is_held_in_it() {
        for (delay, from, until, mean) in [
            (0.0, 0.1, 0.2, 2.0),
            (0.0, 0.12, 0.14, 2.0),
            (0.1, 0.1, 0.2, 1.0),
            (0.03, 0.1, 0.2, 0.3 * 1.0 + 0.7 * 2.0),
            (0.0, 0.05, 0.25, (0.05 * 1.0 + 0.1 * 2.0 + 0.05 * 4.0) / 0.2),
            // Before the first row and after the last one theirs are held.
            (0.5, 0.0, 0.1, 1.0),
            (0.0, 0.4, 0.5, 8.0),
        ] {
            let mut out = [f64::NAN];
            controls(&log(), delay, from, until, &mut out);
            assert!((out[0] - mean).abs() < 1e-12, "{delay} {from} {until}: {} {mean}", out[0]);
        }
    }

    #[test]
    fn what_a_robot_gets_in_all_is_what_it_was_told() {
        let steps = 37;
        let (mut sum, mut out) = (0.0, [0.0]);
        for step in 0..steps {
            let dt = 0.4 / f64::from(steps);
            controls(&log(), 0.0, f64::from(step) * dt, f64::from(step + 1) * dt, &mut out);
            sum += out[0] * dt;
        }
        assert!((sum - 0.1 * 15.0).abs() < 1e-12, "{sum}");
    }
}
