//! Minimum-jerk motion: the quintic polynomial that begins and ends with given positions, velocities and accelerations, and among
//! all such motions has the least integral of squared jerk (Flash and Hogan, The coordination of arm movements: an experimentally
//! confirmed mathematical model, Journal of Neuroscience 5, 1985).

use super::NoSolution;

/// Peak speed of a motion from rest to rest, as a multiple of its mean speed.
const PEAK: f64 = 1.875;

/// Position, velocity and acceleration of a coordinate, in its unit and seconds.
pub type Boundary = [f64; 3];

/// A motion of several coordinates. Outside its duration the coordinates stay where it begins and ends.
///
/// ```
/// use robohive_control::maths::MinimumJerk;
///
/// let motion = MinimumJerk::between(&[0.0, 1.0], &[1.0, -1.0], 2.0)?;
/// let mut place = [0.0; 2];
/// motion.position(1.0, &mut place);
/// assert_eq!(place, [0.5, 0.0]);
/// # Ok::<(), robohive_control::maths::NoSolution>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MinimumJerk {
    /// Coefficients of each coordinate's polynomial in the share of the duration that has passed.
    coefficients: Vec<[f64; 6]>,
    duration: f64,
}

impl MinimumJerk {
    /// The motion from rest at `start` to rest at `end` in `duration` seconds.
    ///
    /// # Errors
    /// A duration that is not positive, or numbers of coordinates that differ.
    pub fn between(start: &[f64], end: &[f64], duration: f64) -> Result<Self, NoSolution> {
        let resting = |places: &[f64]| places.iter().map(|&place| [place, 0.0, 0.0]).collect::<Vec<_>>();
        Self::joining(&resting(start), &resting(end), duration)
    }

    /// The motion between two boundaries in `duration` seconds.
    ///
    /// # Errors
    /// A duration that is not positive, or numbers of coordinates that differ.
    pub fn joining(start: &[Boundary], end: &[Boundary], duration: f64) -> Result<Self, NoSolution> {
        let wrong = |message: String| NoSolution::new("minimum jerk", message);
        if !(duration > 0.0 && duration.is_finite()) {
            return Err(wrong(format!("a motion takes a positive time, not {duration} s")));
        }
        if start.len() != end.len() {
            let message =
                format!("the motion begins with {} coordinates and ends with {}", start.len(), end.len());
            return Err(wrong(message));
        }
        let each = start.iter().zip(end);
        Ok(MinimumJerk { coefficients: each.map(|(a, b)| quintic(*a, *b, duration)).collect(), duration })
    }

    /// The shortest time \[s\] in which every coordinate moves from rest at `start` to rest at `end` below its speed limit.
    pub fn shortest(start: &[f64], end: &[f64], limits: &[f64]) -> f64 {
        let each = start.iter().zip(end).zip(limits);
        each.map(|((start, end), limit)| PEAK * (end - start).abs() / limit).fold(0.0, f64::max)
    }

    /// How long it takes \[s\].
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// Writes the positions at a time \[s\] since the beginning.
    pub fn position(&self, time: f64, out: &mut [f64]) {
        self.derivative(0, time, out);
    }

    /// Writes the velocities at a time \[s\] since the beginning.
    pub fn velocity(&self, time: f64, out: &mut [f64]) {
        self.derivative(1, time, out);
    }

    /// Writes the accelerations at a time \[s\] since the beginning.
    pub fn acceleration(&self, time: f64, out: &mut [f64]) {
        self.derivative(2, time, out);
    }

    fn derivative(&self, order: usize, time: f64, out: &mut [f64]) {
        let outside = !(0.0..=self.duration).contains(&time);
        let share = (time / self.duration).clamp(0.0, 1.0);
        let scale = self.duration.powi(order as i32);
        for (value, coefficients) in out.iter_mut().zip(&self.coefficients) {
            *value = if outside && order > 0 { 0.0 } else { polynomial(coefficients, order, share) / scale };
        }
    }
}

/// Coefficients of the quintic in `time / duration`.
fn quintic(start: Boundary, end: Boundary, duration: f64) -> [f64; 6] {
    let in_shares = |[place, speed, acceleration]: Boundary| {
        [place, speed * duration, acceleration * duration * duration]
    };
    let ([p0, v0, a0], [p1, v1, a1]) = (in_shares(start), in_shares(end));
    // What the last three terms must add at the end.
    let position = p1 - p0 - v0 - a0 / 2.0;
    let velocity = v1 - v0 - a0;
    let acceleration = a1 - a0;
    [
        p0,
        v0,
        a0 / 2.0,
        10.0 * position - 4.0 * velocity + acceleration / 2.0,
        -15.0 * position + 7.0 * velocity - acceleration,
        6.0 * position - 3.0 * velocity + acceleration / 2.0,
    ]
}

/// A derivative of a polynomial, by Horner's rule.
fn polynomial(coefficients: &[f64; 6], order: usize, x: f64) -> f64 {
    let factor = |power: usize| (power + 1 - order..=power).map(|n| n as f64).product::<f64>();
    (order..6).rev().fold(0.0, |sum, power| sum * x + factor(power) * coefficients[power])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(motion: &MinimumJerk, time: f64) -> [f64; 3] {
        let mut out = [[0.0]; 3];
        motion.position(time, &mut out[0]);
        motion.velocity(time, &mut out[1]);
        motion.acceleration(time, &mut out[2]);
        out.map(|[value]| value)
    }

    fn near(a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    #[test]
    fn boundaries_are_met() {
        let (start, end) = ([0.3, -1.0, 2.0], [1.1, 0.4, -3.0]);
        let motion = MinimumJerk::joining(&[start], &[end], 0.7).unwrap();
        assert!(near(at(&motion, 0.0), start), "{:?}", at(&motion, 0.0));
        assert!(near(at(&motion, 0.7), end), "{:?}", at(&motion, 0.7));
        assert!(near(at(&motion, 0.8), [1.1, 0.0, 0.0]), "the motion is over");
    }

    #[test]
    fn velocities_and_accelerations_are_slopes() {
        let motion = MinimumJerk::joining(&[[0.3, -1.0, 2.0]], &[[1.1, 0.4, -3.0]], 0.7).unwrap();
        for time in [0.1, 0.35, 0.6] {
            let (before, after, now) =
                (at(&motion, time - 1e-5), at(&motion, time + 1e-5), at(&motion, time));
            assert!(((after[0] - before[0]) / 2e-5 - now[1]).abs() < 1e-7);
            assert!(((after[1] - before[1]) / 2e-5 - now[2]).abs() < 1e-7);
        }
    }

    /// The published profile from rest to rest: 10 s^3 - 15 s^4 + 6 s^5, with 1.875 of the mean speed in the middle.
    #[test]
    fn from_rest_to_rest_it_is_the_published_profile() {
        let motion = MinimumJerk::between(&[0.0], &[2.0], 4.0).unwrap();
        for share in [0.1_f64, 0.25, 0.5, 0.9] {
            let profile = 10.0 * share.powi(3) - 15.0 * share.powi(4) + 6.0 * share.powi(5);
            assert!((at(&motion, 4.0 * share)[0] - 2.0 * profile).abs() < 1e-12);
        }
        assert!((at(&motion, 2.0)[1] - PEAK * 0.5).abs() < 1e-12);
        assert!((MinimumJerk::shortest(&[0.0], &[2.0], &[PEAK * 0.5]) - 4.0).abs() < 1e-12);
    }

    /// Any other motion with the same boundaries has more jerk: here the quintic with a sixth-order term that vanishes with two
    /// derivatives at both ends.
    #[test]
    fn no_other_motion_has_less_jerk() {
        let jerk = |extra: f64| {
            let steps = 2000;
            let each = (0..steps).map(|k| {
                let s = (k as f64 + 0.5) / steps as f64;
                // Third derivatives of 10 s^3 - 15 s^4 + 6 s^5, and of s^3 (1 - s)^3.
                let quintic = 60.0 - 360.0 * s + 360.0 * s * s;
                let bump = 6.0 - 72.0 * s + 180.0 * s * s - 120.0 * s * s * s;
                (quintic + extra * bump).powi(2)
            });
            each.sum::<f64>() / f64::from(steps)
        };
        assert!((jerk(0.0) - 720.0).abs() < 1e-2, "{}", jerk(0.0));
        assert!([-1.0, -0.1, 0.1, 1.0].into_iter().all(|extra| jerk(extra) > jerk(0.0)));
    }

    #[test]
    fn impossible_motions_are_refused() {
        let error = MinimumJerk::between(&[0.0], &[1.0], 0.0).unwrap_err().to_string();
        assert_eq!(error, "minimum jerk: a motion takes a positive time, not 0 s");
        let error = MinimumJerk::between(&[0.0], &[1.0, 2.0], 1.0).unwrap_err().to_string();
        assert!(error.contains("begins with 1 coordinates and ends with 2"), "{error}");
    }
}
