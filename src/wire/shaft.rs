//! Where a servo sits.

use crate::plant::{Drive, Plant};

/// The shaft of a motor of the plant: a servo's angle \[rad\] is joint × scale + offset.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shaft {
    /// The motor.
    pub(crate) motor: usize,
    pub(crate) scale: f64,
    pub(crate) offset: f64,
}

impl Shaft {
    /// The servo's angle now \[rad\].
    pub(crate) fn angle(&self, plant: &Plant) -> f64 {
        plant.position(self.motor) * self.scale + self.offset
    }

    /// The servo's velocity now \[rad/s\].
    pub(crate) fn velocity(&self, plant: &Plant) -> f64 {
        plant.velocity(self.motor) * self.scale
    }

    /// The servo's torque in the last time step, as the joint feels it, with the servo's sign.
    pub(crate) fn effort(&self, plant: &Plant) -> f64 {
        plant.effort(self.motor) * self.scale
    }

    /// The torque that something outside the robot exerts, with the servo's sign.
    pub(crate) fn external(&self, plant: &Plant) -> f64 {
        plant.external(self.motor) * self.scale
    }

    /// What moves the joint with this torque of the servo, beside what gravity and motion ask for.
    pub(crate) fn torque(&self, plant: &Plant, torque: f64) -> Drive {
        Drive::Effort(torque * self.scale + plant.bias(self.motor))
    }

    /// The joint's position at an angle of the servo.
    pub(crate) fn joint(&self, angle: f64) -> f64 {
        (angle - self.offset) / self.scale
    }
}
