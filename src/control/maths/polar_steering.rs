//! Steering a unicycle to a pose by its polar coordinates (Aicardi, Casalino, Bicchi and Balestrino, Closed loop steering of unicycle-like
//! vehicles via Lyapunov techniques, IEEE Robotics and Automation Magazine 2, 1995).

use physics::math::ops;

/// Gains of the law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PolarSteering {
    /// Speed by distance \[1/s\].
    pub speed: f64,
    /// Turning by the angle between heading and goal \[1/s\].
    pub bearing: f64,
    /// Weight of the angle between goal and final heading.
    pub heading: f64,
}

impl PolarSteering {
    /// Speed \[m/s\] and turning \[rad/s\] from a pose (x, y \[m\], heading \[rad\]) towards the origin, looking along x. The motion
    /// goes backwards where the goal is behind.
    pub fn command(&self, [x, y, heading]: [f64; 3]) -> [f64; 2] {
        let distance = x.hypot(y);
        // Direction to the origin from its own axis, and from where the vehicle looks.
        let direction = ops::angle(-y, -x);
        let bearing = wrap(direction - heading);
        let rate = self.speed * ops::cos(bearing);
        let ratio = if bearing.abs() < 1e-6 { 1.0 } else { ops::sin(bearing) / bearing };
        let turning = self.bearing * bearing + rate * ratio * (bearing + self.heading * direction);
        [rate * distance, turning]
    }
}

/// An angle within half a turn of zero.
pub fn wrap(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    (angle + PI).rem_euclid(TAU) - PI
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From all around, at all headings, the pose is reached.
    #[test]
    fn every_pose_leads_to_the_goal() {
        let law = PolarSteering { speed: 0.5, bearing: 1.5, heading: 1.0 };
        for k in 0..64 {
            let (place, look) = (f64::from(k % 8) * 0.785 + 0.1, f64::from(k / 8) * 0.785 + 0.05);
            let mut pose = [place.cos(), place.sin(), look];
            for _ in 0..20_000 {
                let [speed, turning] = law.command(pose);
                pose[0] += 0.002 * speed * pose[2].cos();
                pose[1] += 0.002 * speed * pose[2].sin();
                pose[2] += 0.002 * turning;
            }
            assert!(pose[0].hypot(pose[1]) < 1e-3 && wrap(pose[2]).abs() < 0.02, "{place} {look}: {pose:?}");
        }
    }
}
