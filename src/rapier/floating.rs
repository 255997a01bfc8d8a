//! Converts velocities of floating bodies between MuJoCo's and rapier's conventions.
//!
//! MuJoCo moves the origin of the body's frame by its velocity, and turns the body by an angular velocity in its own frame.
//! Rapier moves the centre of mass. Over a step that turns the body by `R' = exp(h w) R`, an origin that moves by `h v` carries
//! the centre of mass, at `r` in the frame of the body, by `h v + (R' - R) r`: the quotient by `h` is the velocity given to
//! rapier, and subtracted again afterwards with the rotation that rapier made. So motion without contacts equals that of our pipeline up
//! to rounding, for any offset of the centre of mass.
//!
//! Rapier rotates single rigid bodies by a quaternion of the linearised rotation, which is an angle of `2 atan(h w / 2)` instead
//! of `h w`: their velocity is scaled so that the angle is right.

use crate::convert::array;
use rapier3d_f64::math::{Rotation, Vector};

/// Length of a step of rapier, and number of its solver iterations.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pace {
    pub dt: f64,
    pub iterations: usize,
}

/// A body with a free joint at the start of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Floating {
    /// Centre of mass in the frame of the body.
    pub com: Vector,
    pub orientation: Rotation,
    /// Whether it is a single rigid body, which rapier rotates by the linearised rotation.
    pub alone: bool,
}

/// Angle of half a part of a step beyond which its tangent is of no use.
const LARGE: f64 = 1.0;

impl Floating {
    /// Velocity of the centre of mass, and angular velocity in the world, for six numbers of `qvel`.
    pub fn to_rapier(self, qvel: &[f64], pace: Pace) -> (Vector, Vector) {
        let angular = self.orientation * Vector::from_slice(&qvel[3..6]);
        let after = Rotation::from_scaled_axis(angular * pace.dt) * self.orientation;
        let arm = after * self.com - self.orientation * self.com;
        let half = angular.length() * pace.dt / pace.iterations as f64 / 2.0;
        let faster = if self.alone && half > 0.0 && half < LARGE { half.tan() / half } else { 1.0 };
        (Vector::from_slice(&qvel[..3]) + arm / pace.dt, angular * faster)
    }

    /// The six numbers of `qvel` after the step that ended with these.
    pub fn to_qvel(self, after: Rotation, (linear, angular): (Vector, Vector), pace: Pace, qvel: &mut [f64]) {
        let arm = after * self.com - self.orientation * self.com;
        let half = angular.length() * pace.dt / pace.iterations as f64 / 2.0;
        let slower = if self.alone && half > 0.0 && half < LARGE.tan() { half.atan() / half } else { 1.0 };
        qvel[..3].copy_from_slice(&array(linear - arm / pace.dt));
        qvel[3..6].copy_from_slice(&array(after.inverse() * angular * slower));
    }
}
