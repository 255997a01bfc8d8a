//! The motion to where an episode begins.

/// A motion of minimum jerk: rest to rest along a polynomial of the fifth degree (Flash and Hogan 1985; the one that RoboHive resets by).
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    from: Vec<f64>,
    to: Vec<f64>,
    /// When it begins \[s\].
    begun: f64,
    duration: f64,
    done: bool,
}

impl Motion {
    /// A motion between two commands.
    pub(crate) fn new(from: &[f64], to: &[f64], begun: f64, duration: f64) -> Motion {
        Motion { from: from.to_vec(), to: to.to_vec(), begun, duration, done: false }
    }

    /// One that has ended where it is.
    pub(crate) fn none(here: &[f64]) -> Motion {
        Motion { done: true, ..Motion::new(here, here, 0.0, 0.0) }
    }

    /// Whether its end has been commanded.
    pub(crate) fn done(&self) -> bool {
        self.done
    }

    /// The command at `now` \[s\].
    pub(crate) fn command(&mut self, now: f64) -> Vec<f64> {
        let t = ((now - self.begun) / self.duration).min(1.0);
        self.done = t >= 1.0;
        let share = t * t * t * (10.0 - t * (15.0 - 6.0 * t));
        self.from.iter().zip(&self.to).map(|(from, to)| from + (to - from) * share).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rests_at_both_ends_and_is_fastest_in_the_middle() {
        let mut motion = Motion::new(&[1.0], &[3.0], 10.0, 4.0);
        let at: Vec<f64> = (0..=400).map(|k| motion.command(10.0 + f64::from(k) * 0.01)[0]).collect();
        assert!(motion.done());
        assert_eq!((at[0], at[200], at[400]), (1.0, 2.0, 3.0));
        let speed = |k: usize| (at[k + 1] - at[k]) / 0.01;
        // The peak is 15/8 of the mean, in the middle.
        assert!((speed(200) - 15.0 / 8.0 * 0.5).abs() < 1e-3);
        assert!(speed(0) < 1e-3 && speed(399) < 1e-3);
    }
}
