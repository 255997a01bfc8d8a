//! The motion that a servo makes to its goal: a trapezoid of velocity.

/// Where a profile has the servo \[units of position, units a second\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Profile {
    pub(crate) position: f64,
    velocity: f64,
}

impl Profile {
    /// A profile at rest.
    pub(crate) fn at(position: f64) -> Profile {
        Profile { position, velocity: 0.0 }
    }

    /// Goes on towards `goal` for `dt` seconds, no faster than `fastest` and with at most `acceleration`; 0 is no limit.
    pub(crate) fn advance(&mut self, goal: f64, fastest: f64, acceleration: f64, dt: f64) {
        let left = goal - self.position;
        let fastest = if fastest > 0.0 { fastest } else { f64::INFINITY };
        let acceleration = if acceleration > 0.0 { acceleration } else { f64::INFINITY };
        if fastest.is_infinite() && acceleration.is_infinite() {
            *self = Profile::at(goal);
            return;
        }
        // The velocity from which the goal is just reached by braking, in steps of dt.
        let braking = if acceleration.is_infinite() {
            f64::INFINITY
        } else {
            let step = acceleration * dt;
            (step * step / 4.0 + 2.0 * acceleration * left.abs()).sqrt() - step / 2.0
        };
        let wanted = left.signum() * fastest.min(braking).min(left.abs() / dt);
        let change = (wanted - self.velocity).clamp(-acceleration * dt, acceleration * dt);
        self.velocity += change;
        self.position += self.velocity * dt;
        if (goal - self.position).abs() < 0.5 && self.velocity.abs() <= acceleration * dt {
            *self = Profile::at(goal);
        }
    }

    /// Whether it has come to rest at `goal`.
    pub(crate) fn done(&self, goal: f64) -> bool {
        self.position == goal && self.velocity == 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trapezoid_keeps_its_limits_and_ends_at_its_goal() {
        let (goal, fastest, acceleration, dt) = (1000.0, 800.0, 4000.0, 0.001);
        let mut profile = Profile::at(0.0);
        let (mut before, mut ticks, mut peak) = (0.0, 0, 0.0_f64);
        while !profile.done(goal) {
            profile.advance(goal, fastest, acceleration, dt);
            assert!((profile.velocity - before).abs() <= acceleration * dt + 1e-9 || profile.done(goal));
            assert!(profile.position <= goal + 0.5);
            peak = peak.max(profile.velocity);
            before = profile.velocity;
            ticks += 1;
            assert!(ticks < 3000);
        }
        // 0.2 s up, 0.2 s down, between them 840 at full speed.
        assert_eq!(peak, fastest);
        assert!((1440..1470).contains(&ticks), "{ticks}");
    }
}
