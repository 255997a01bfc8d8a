//! Control periods in real time.

use std::time::{Duration, Instant};

/// A clock that can be waited for.
pub trait Clock {
    /// Seconds since some moment in the past; never less than before.
    fn now(&mut self) -> f64;
    /// Returns after `seconds`, which are positive.
    fn wait(&mut self, seconds: f64);
}

impl<C: Clock + ?Sized> Clock for Box<C> {
    fn now(&mut self) -> f64 {
        (**self).now()
    }

    fn wait(&mut self, seconds: f64) {
        (**self).wait(seconds);
    }
}

/// The machine's clock; it waits by sleeping.
#[derive(Clone, Copy, Debug)]
pub struct WallClock {
    start: Instant,
}

impl Default for WallClock {
    fn default() -> Self {
        WallClock { start: Instant::now() }
    }
}

impl Clock for WallClock {
    fn now(&mut self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    fn wait(&mut self, seconds: f64) {
        std::thread::sleep(Duration::try_from_secs_f64(seconds).unwrap_or_default());
    }
}

/// Keeps control periods as long as they say, and counts those that took longer. A period that is late begins when the
/// one before ended: lost time is not caught up with shorter periods.
///
/// ```
/// use robohive_robot::{Clock, Pacer};
///
/// struct Stopwatch(f64);
/// impl Clock for Stopwatch {
///     fn now(&mut self) -> f64 { self.0 }
///     fn wait(&mut self, seconds: f64) { self.0 += seconds }
/// }
///
/// let mut pacer = Pacer::new(Stopwatch(0.0));
/// pacer.start();
/// pacer.clock().0 += 0.25; // what the period computed
/// assert_eq!(pacer.finish(1.0), 0.0);
/// assert_eq!(pacer.clock().0, 1.0);
/// pacer.clock().0 += 1.5;
/// assert_eq!(pacer.finish(1.0), 0.5);
/// assert_eq!((pacer.clock().0, pacer.overruns()), (2.5, 1));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Pacer<C> {
    clock: C,
    /// When the current period began \[s\].
    begun: Option<f64>,
    periods: u64,
    overruns: u64,
    worst: f64,
}

impl<C: Clock> Pacer<C> {
    /// A pacer by this clock.
    pub fn new(clock: C) -> Self {
        Pacer { clock, begun: None, periods: 0, overruns: 0, worst: 0.0 }
    }

    /// Begins a period now; the end of each period begins the next.
    pub fn start(&mut self) {
        self.begun = Some(self.clock.now());
    }

    /// Waits until the current period has lasted `duration` seconds; returns how much longer it took already \[s\]. The
    /// first period begins here where [`Pacer::start`] was not called.
    pub fn finish(&mut self, duration: f64) -> f64 {
        let now = self.clock.now();
        let end = self.begun.unwrap_or(now) + duration;
        self.periods += 1;
        let late = (now - end).max(0.0);
        if late > 0.0 {
            self.overruns += 1;
            self.worst = self.worst.max(late);
        } else if end > now {
            self.clock.wait(end - now);
        }
        self.begun = Some(now.max(end));
        late
    }

    /// Its clock.
    pub fn clock(&mut self) -> &mut C {
        &mut self.clock
    }

    /// Periods that ended.
    pub fn periods(&self) -> u64 {
        self.periods
    }

    /// Periods that took longer than they should.
    pub fn overruns(&self) -> u64 {
        self.overruns
    }

    /// By how much the longest overran \[s\].
    pub fn worst_overrun(&self) -> f64 {
        self.worst
    }
}
