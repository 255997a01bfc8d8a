//! The divergent component of motion of a body that walks on two feet (Englsberger, Ott, Albu-Schaeffer, "Three-Dimensional Bipedal
//! Walking Control Based on Divergent Component of Motion", IEEE Transactions on Robotics 31(2), 2015).
//!
//! Over a centre of pressure p at a constant height h, a centre of mass x moves by x'' = w² (x - p), w² = g/h. Its divergent
//! component ξ = x + x'/w moves away from p, ξ' = w (ξ - p), and x follows ξ. Who sets the next foot down where ξ will be, less
//! what ξ has of it at the start of a regular step, walks regularly from then on.

use physics::math::ops;

/// A centre of mass that moves at one height over a centre of pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pendulum {
    /// Rate at which it falls away from the centre of pressure, sqrt(g/h) \[1/s\].
    pub rate: f64,
}

/// A walk of equal steps: what a step covers, from one foot to the other one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Velocity forward and to the left \[m/s\].
    pub velocity: [f64; 2],
    /// Distance of the feet to the sides \[m\].
    pub width: f64,
    /// Duration of a step \[s\].
    pub period: f64,
}

impl Pendulum {
    /// Of a centre of mass at this height \[m\] under 9.81 m/s².
    pub fn of_height(height: f64) -> Self {
        Pendulum { rate: (9.81 / height).sqrt() }
    }

    /// The divergent component of a position \[m\] and velocity \[m/s\].
    pub fn divergent(&self, position: f64, velocity: f64) -> f64 {
        position + velocity / self.rate
    }

    /// Where a divergent component is after `time` seconds over a centre of pressure \[m\].
    pub fn later(&self, divergent: f64, pressure: f64, time: f64) -> f64 {
        pressure + (divergent - pressure) * ops::exp(self.rate * time)
    }

    /// Position \[m\] and velocity \[m/s\] after `time` seconds over a centre of pressure \[m\].
    pub fn moved(&self, [position, velocity]: [f64; 2], pressure: f64, time: f64) -> [f64; 2] {
        let (w, away) = (self.rate, position - pressure);
        let growth = ops::exp(w * time);
        let (cosh, sinh) = ((growth + 1.0 / growth) / 2.0, (growth - 1.0 / growth) / 2.0);
        [pressure + away * cosh + velocity / w * sinh, away * w * sinh + velocity * cosh]
    }

    /// The divergent component, from the foot that stands, when a step begins in a walk of equal steps: forward and to the left
    /// \[m\]. `side` is 1 while the right foot stands, -1 while the left one does.
    pub fn begin(&self, pace: &Pace, side: f64) -> [f64; 2] {
        let growth = ops::exp(self.rate * pace.period);
        let drift = |velocity: f64| velocity * pace.period / (growth - 1.0);
        [drift(pace.velocity[0]), side * pace.width / (growth + 1.0) + drift(pace.velocity[1])]
    }

    /// Time in which a divergent component comes from `begin` to `now` \[m\] over a centre of pressure at 0 \[s\]. What is on the other
    /// side of the centre of pressure counts as a micrometre.
    pub fn time(&self, now: f64, begin: f64) -> f64 {
        ops::log(now.max(1e-6) / begin.max(1e-6)) / self.rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regular_steps_continue() {
        let pendulum = Pendulum::of_height(0.22);
        let pace = Pace { velocity: [0.2, 0.03], width: 0.093, period: 0.3 };
        let (mut foot, mut side) = ([0.0; 2], 1.0);
        let mut divergent = pendulum.begin(&pace, side);
        for _ in 0..20 {
            divergent = [0, 1].map(|i| pendulum.later(divergent[i], foot[i], pace.period));
            side = -side;
            let begin = pendulum.begin(&pace, side);
            let next = [0, 1].map(|i| divergent[i] - begin[i]);
            let expected = [foot[0] + 0.06, foot[1] - side * pace.width + 0.009];
            assert!((0..2).all(|i| (next[i] - expected[i]).abs() < 1e-9), "{next:?}, not {expected:?}");
            foot = next;
        }
    }

    #[test]
    fn the_centre_of_mass_follows_its_divergent_component() {
        let pendulum = Pendulum::of_height(0.9);
        let (mut state, pressure) = ([0.05, -0.1], 0.02);
        let begin = pendulum.divergent(state[0], state[1]);
        for step in 1..=50 {
            state = pendulum.moved(state, pressure, 0.01);
            let expected = pendulum.later(begin, pressure, 0.01 * f64::from(step));
            assert!((pendulum.divergent(state[0], state[1]) - expected).abs() < 1e-12);
        }
        assert!((pendulum.time(pendulum.later(0.01, 0.0, 0.3), 0.01) - 0.3).abs() < 1e-12);
    }
}
