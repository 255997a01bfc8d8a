//! History buffers: past controls and sensor readings, from which delays read (XML reference: `delay`, `interp`,
//! `interval`).
//!
//! A buffer of `n` samples holds the time of the last due reading, the place of the newest sample, `n` times and
//! `n` rows of values; samples stand in a ring, oldest behind the newest.

use crate::model::Model;
use crate::model::bounds::MINVAL;

/// A buffer that is only read.
#[derive(Clone, Copy)]
pub struct Buffer<'a> {
    times: &'a [f64],
    values: &'a [f64],
    newest: usize,
    dim: usize,
}

/// How many numbers a buffer of `n` samples of `dim` numbers takes.
fn length(n: usize, dim: usize) -> usize {
    2 + n * (1 + dim)
}

impl<'a> Buffer<'a> {
    fn new(history: &'a [f64], address: i32, n: usize, dim: usize) -> Self {
        let buffer = &history[address as usize..address as usize + length(n, dim)];
        let (times, values) = buffer[2..].split_at(n);
        Buffer { times, values, newest: buffer[1] as usize % n, dim }
    }

    /// Place of sample `i`, the oldest being 0.
    fn place(&self, i: usize) -> usize {
        (self.newest + 1 + i) % self.times.len()
    }

    fn time(&self, i: usize) -> f64 {
        self.times[self.place(i)]
    }

    fn row(&self, i: usize) -> &'a [f64] {
        let place = self.place(i);
        &self.values[place * self.dim..(place + 1) * self.dim]
    }

    /// The first sample not before `t`; the number of samples when all are.
    fn find(&self, t: f64) -> usize {
        let n = self.times.len();
        let (mut low, mut high) = (0, n);
        while low < high {
            let middle = (low + high) / 2;
            if self.time(middle) < t { low = middle + 1 } else { high = middle }
        }
        low
    }

    /// Values at time `t`: held, or interpolated linearly (`interp` 1) or by a cubic (2); constant outside.
    pub fn read(&self, t: f64, interp: i32, out: &mut [f64]) {
        let n = self.times.len();
        let (first, last) = (self.time(0) + MINVAL, self.time(n - 1) - MINVAL);
        let inside = first < t && t < last;
        if !inside {
            return out.copy_from_slice(self.row(if t > first { n - 1 } else { 0 }));
        }
        let i = self.find(t);
        if (t - self.time(i)).abs() < MINVAL {
            return out.copy_from_slice(self.row(i));
        }
        let (low, high) = (self.row(i - 1), self.row(i));
        if interp == 0 {
            return out.copy_from_slice(low);
        }
        let width = self.time(i) - self.time(i - 1);
        let a = (t - self.time(i - 1)) / width;
        for (k, x) in out.iter_mut().enumerate() {
            *x = if interp == 1 { low[k] + a * (high[k] - low[k]) } else { self.cubic(i, k, a, width) };
        }
    }

    /// Cubic through samples `i - 1` and `i` with Catmull–Rom slopes, flat at the ends of the buffer.
    fn cubic(&self, i: usize, k: usize, a: f64, width: f64) -> f64 {
        let slope = |from: usize, to: usize| {
            (self.row(to)[k] - self.row(from)[k]) / (self.time(to) - self.time(from))
        };
        let start = if i > 1 { slope(i - 2, i) } else { 0.0 };
        let end = if i + 1 < self.times.len() { slope(i - 1, i + 1) } else { 0.0 };
        let (a2, a3) = (a * a, a * a * a);
        let (h00, h10) = (2.0 * a3 - 3.0 * a2 + 1.0, a3 - 2.0 * a2 + a);
        let (h01, h11) = (-2.0 * a3 + 3.0 * a2, a3 - a2);
        h00 * self.row(i - 1)[k] + h10 * width * start + h01 * self.row(i)[k] + h11 * width * end
    }
}

/// Sets all buffers to zero values at the times before the start.
pub fn reset(m: &Model, history: &mut [f64]) {
    let dt = m.opt.timestep;
    for i in 0..m.nactuator {
        let n = m.actuator_history[i][0].max(0) as usize;
        if n > 0 {
            start(history, m.actuator_historyadr[i], n, 1, 0.0, |j| -((n - j) as f64) * dt);
        }
    }
    for i in 0..m.nsensor {
        let n = m.sensor_history[i][0].max(0) as usize;
        if n == 0 {
            continue;
        }
        let (address, dim) = (m.sensor_historyadr[i], m.sensor_dim[i] as usize);
        let [period, phase] = m.sensor_interval[i];
        if period > 0.0 {
            let last = if phase == 0.0 { -period } else { phase };
            let time = |j: usize| ((last - (n - 1 - j) as f64 * period) / dt).ceil() * dt;
            start(history, address, n, dim, last, time);
        } else {
            start(history, address, n, dim, -dt, |j| -((n - j) as f64) * dt);
        }
    }
}

fn start(history: &mut [f64], address: i32, n: usize, dim: usize, last: f64, time: impl Fn(usize) -> f64) {
    let buffer = &mut history[address as usize..address as usize + length(n, dim)];
    buffer.fill(0.0);
    (buffer[0], buffer[1]) = (last, (n - 1) as f64);
    buffer[2..2 + n].iter_mut().enumerate().for_each(|(j, t)| *t = time(j));
}

/// Control `k`, of actuator `i`, as it acts at `time`.
#[cold]
pub fn control(m: &Model, history: &[f64], ctrl: &[f64], time: f64, k: usize) -> f64 {
    let i = m.actuator_ctrladr.partition_point(|&first| first as usize <= k) - 1;
    let [n, interp] = m.actuator_history[i];
    if m.actuator_delay[i] == 0.0 || n <= 0 {
        return ctrl[k];
    }
    let mut value = [0.0];
    let buffer = Buffer::new(history, m.actuator_historyadr[i], n as usize, 1);
    buffer.read(time - m.actuator_delay[i], interp, &mut value);
    value[0]
}

/// The element whose past is asked for, by id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recorded {
    /// The control of an actuator: one number.
    Actuator(usize),
    /// The readings of a sensor: as many numbers as it has.
    Sensor(usize),
}

/// What was recorded of an element, as it arrives at `time` \[s\] after the element's delay; interpolated as `interp` says,
/// or, where that is `None`, as the model does. `None` where the element keeps no history.
pub fn recall(m: &Model, history: &[f64], of: Recorded, time: f64, interp: Option<i32>) -> Option<Vec<f64>> {
    let ([n, own], address, delay, dim) = match of {
        Recorded::Actuator(i) => (m.actuator_history[i], m.actuator_historyadr[i], m.actuator_delay[i], 1),
        Recorded::Sensor(i) => {
            (m.sensor_history[i], m.sensor_historyadr[i], m.sensor_delay[i], m.sensor_dim[i] as usize)
        }
    };
    let n = usize::try_from(n).ok().filter(|&n| n > 0)?;
    let mut values = vec![0.0; dim];
    Buffer::new(history, address, n, dim).read(time - delay, interp.unwrap_or(own), &mut values);
    Some(values)
}

/// Replaces the fresh reading `data` of sensor `i` by what the sensor shows at `time`.
pub fn show(m: &Model, history: &[f64], time: f64, i: usize, data: &mut [f64]) {
    let [n, interp] = m.sensor_history[i];
    if n <= 0 {
        return;
    }
    let waits = m.sensor_interval[i][0] > 0.0 && !is_due(m, history, time, i);
    if m.sensor_delay[i] > 0.0 || waits {
        let buffer = Buffer::new(history, m.sensor_historyadr[i], n as usize, data.len());
        buffer.read(time - m.sensor_delay[i], interp, data);
    }
}

/// True when the interval of sensor `i` is over.
fn is_due(m: &Model, history: &[f64], time: f64, i: usize) -> bool {
    history[m.sensor_historyadr[i] as usize] + m.sensor_interval[i][0] <= time
}

/// Records the controls and the fresh readings of the step that begins at `time`.
pub fn record(m: &Model, ctrl: &[f64], fresh: &[f64], time: f64, history: &mut [f64]) {
    for i in 0..m.nactuator {
        let n = m.actuator_history[i][0].max(0) as usize;
        if n > 0 {
            insert(history, m.actuator_historyadr[i], n, time, &ctrl[m.actuator_ctrladr[i] as usize..][..1]);
        }
    }
    for i in 0..m.nsensor {
        let n = m.sensor_history[i][0].max(0) as usize;
        if n == 0 || (m.sensor_interval[i][0] > 0.0 && !is_due(m, history, time, i)) {
            continue;
        }
        if m.sensor_interval[i][0] > 0.0 {
            history[m.sensor_historyadr[i] as usize] += m.sensor_interval[i][0];
        }
        let first = m.sensor_adr[i] as usize;
        if let Some(values) = fresh.get(first..first + m.sensor_dim[i] as usize) {
            insert(history, m.sensor_historyadr[i], n, time, values);
        }
    }
}

/// Puts a sample in its place in time; one sample of that time is overwritten, else the oldest goes.
fn insert(history: &mut [f64], address: i32, n: usize, t: f64, values: &[f64]) {
    let dim = values.len();
    let view = Buffer::new(history, address, n, dim);
    let i = view.find(t);
    let exact = i < n && (t - view.time(i)).abs() < MINVAL;
    let ring: [usize; 3] = [view.place(0), view.place(i.min(n - 1)), view.newest];
    let base = address as usize;
    let (times, rows) = (base + 2, base + 2 + n);
    let place = if exact {
        ring[1]
    } else if i == 0 {
        ring[0]
    } else {
        // Older samples move one place back, the oldest out.
        for j in 0..i - 1 {
            let (to, from) = ((ring[2] + 1 + j) % n, (ring[2] + 2 + j) % n);
            if i < n {
                history[times + to] = history[times + from];
                history.copy_within(rows + from * dim..rows + (from + 1) * dim, rows + to * dim);
            }
        }
        if i == n {
            history[base + 1] = ((ring[2] + 1) % n) as f64;
            (ring[2] + 1) % n
        } else {
            (ring[2] + i) % n
        }
    };
    history[times + place] = t;
    history[rows + place * dim..rows + (place + 1) * dim].copy_from_slice(values);
}
