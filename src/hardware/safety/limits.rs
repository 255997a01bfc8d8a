//! Limits of commands: their values, and how fast they may change.

use robot::Fault;

/// What the command of one actuator may be, in the units of the command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Smallest and largest value.
    pub value: [f64; 2],
    /// Largest rate of change \[1/s\]: of positions the velocity.
    pub rate: f64,
    /// Largest change of the rate \[1/s²\]: of positions the acceleration.
    pub acceleration: f64,
    /// Largest change of that \[1/s³\]: of positions the jerk.
    pub jerk: f64,
}

impl Limits {
    /// No limits.
    pub const NONE: Limits = Limits {
        value: [f64::NEG_INFINITY, f64::INFINITY],
        rate: f64::INFINITY,
        acceleration: f64::INFINITY,
        jerk: f64::INFINITY,
    };

    /// Limits of values alone.
    pub fn of_value(value: [f64; 2]) -> Limits {
        Limits { value, ..Limits::NONE }
    }
}

/// The course of one command: value, rate, acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Course {
    pub(crate) value: f64,
    pub(crate) rate: f64,
    acceleration: f64,
}

/// Keeps commands within limits, from where the device stands on.
#[derive(Clone, Debug, Default)]
pub(crate) struct Limiter {
    limits: Vec<Limits>,
    courses: Vec<Course>,
    /// When the last command was \[s\].
    time: f64,
    /// Commands that were not what was asked for.
    limited: u64,
}

impl Limiter {
    pub(crate) fn new(limits: Vec<Limits>) -> Limiter {
        let courses = vec![Course::default(); limits.len()];
        Limiter { limits, courses, time: 0.0, limited: 0 }
    }

    /// Other limits from the next beginning on.
    pub(crate) fn set_limits(&mut self, limits: Vec<Limits>) {
        self.courses.resize(limits.len(), Course::default());
        self.limits = limits;
    }

    /// Begins at rest, at `present`.
    pub(crate) fn begin(&mut self, time: f64, present: &[f64]) {
        self.time = time;
        for (course, value) in self.courses.iter_mut().zip(present) {
            *course = Course::at(*value);
        }
    }

    /// Commands that limits changed so far.
    pub(crate) fn limited(&self) -> u64 {
        self.limited
    }

    /// Changes `commands` to what the limits allow at `time`.
    ///
    /// # Errors
    /// Values that are no finite numbers; nothing is changed then.
    pub(crate) fn limit(&mut self, time: f64, commands: &mut [f64]) -> Result<(), Fault> {
        if commands.len() != self.limits.len() {
            return Err(Fault::Length { given: commands.len(), expected: self.limits.len() });
        }
        if let Some(bad) = commands.iter().position(|command| !command.is_finite()) {
            return Err(Fault::BadValue(bad));
        }
        let dt = time - self.time;
        self.time = time;
        for ((command, limits), course) in commands.iter_mut().zip(&self.limits).zip(&mut self.courses) {
            let allowed = course.advance(*command, limits, dt);
            self.limited += u64::from(allowed != *command);
            *command = allowed;
        }
        Ok(())
    }
}

impl Course {
    /// At rest.
    pub(crate) fn at(value: f64) -> Course {
        Course { value, ..Course::default() }
    }

    /// The value nearest to `wanted` that may follow `dt` seconds after the last.
    pub(crate) fn advance(&mut self, wanted: f64, limits: &Limits, dt: f64) -> f64 {
        let [low, high] = limits.value;
        let bounded = wanted.max(low).min(high);
        if limits.rate == f64::INFINITY
            && limits.acceleration == f64::INFINITY
            && limits.jerk == f64::INFINITY
        {
            *self = Course::at(bounded);
            return bounded;
        }
        if dt <= 0.0 {
            return self.value;
        }
        let asked = (bounded - self.value) / dt;
        let left = (bounded - self.value).abs();
        let braking = limits.rate.min(braking(left, limits.acceleration, dt));
        let mut rate = asked.clamp(-braking, braking);
        if limits.acceleration < f64::INFINITY || limits.jerk < f64::INFINITY {
            let mut acceleration = (rate - self.rate) / dt;
            let change = limits.jerk * dt;
            acceleration = acceleration.clamp(self.acceleration - change, self.acceleration + change);
            acceleration = acceleration.clamp(-limits.acceleration, limits.acceleration);
            self.acceleration = acceleration;
            rate = self.rate + acceleration * dt;
        }
        self.rate = rate;
        let untouched = rate == asked;
        self.value = if untouched { bounded } else { (self.value + rate * dt).max(low).min(high) };
        self.value
    }
}

/// The largest rate from which a distance `left` is covered in steps of `dt` by braking with `acceleration`: n steps whose
/// rates fall by `acceleration × dt` each, where n is the fewest that suffice.
fn braking(left: f64, acceleration: f64, dt: f64) -> f64 {
    if acceleration == f64::INFINITY {
        return f64::INFINITY;
    }
    let step = acceleration * dt;
    let count = (((1.0 + 8.0 * left / (step * dt)).sqrt() - 1.0) / 2.0).ceil().max(1.0);
    left / (count * dt) + step * (count - 1.0) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_within_limits_pass_to_the_bit() {
        let limits = Limits { rate: 2.0, ..Limits::of_value([-1.0, 1.0]) };
        let mut limiter = Limiter::new(vec![limits]);
        limiter.begin(0.0, &[0.1]);
        let mut command = [0.2999];
        limiter.limit(0.1, &mut command).unwrap();
        assert_eq!((command, limiter.limited()), ([0.2999], 0));
        command = [5.0];
        limiter.limit(0.2, &mut command).unwrap();
        assert!((command[0] - 0.4999).abs() < 1e-12);
        assert_eq!(limiter.limited(), 1);
    }

    #[test]
    fn values_that_are_no_numbers_change_nothing() {
        let mut limiter = Limiter::new(vec![Limits::NONE; 2]);
        limiter.begin(0.0, &[0.0, 0.0]);
        let mut command = [0.5, f64::NAN];
        assert_eq!(limiter.limit(0.1, &mut command), Err(Fault::BadValue(1)));
        assert_eq!(limiter.courses[0], Course::default());
    }

    #[test]
    fn rate_and_acceleration_stay_within_their_limits_on_any_command() {
        let limits = Limits { rate: 1.5, acceleration: 4.0, jerk: f64::INFINITY, value: [-2.0, 2.0] };
        let mut limiter = Limiter::new(vec![limits]);
        limiter.begin(0.0, &[0.0]);
        let (mut before, mut speed, dt) = (0.0, 0.0, 0.01);
        for k in 1..2400 {
            let mut command = [if k / 400 % 2 == 0 { 3.0 } else { -3.0 }];
            limiter.limit(f64::from(k) * dt, &mut command).unwrap();
            let rate = (command[0] - before) / dt;
            assert!(rate.abs() <= 1.5 + 1e-9, "{k}: {rate}");
            assert!((rate - speed).abs() / dt <= 4.0 + 1e-6, "{k}: {rate} after {speed}");
            assert!(command[0].abs() <= 2.0);
            (before, speed) = (command[0], rate);
        }
        // It gets somewhere too: from one bound to the other in less than four seconds.
        assert!(before < -1.999, "{before}");
    }
}
