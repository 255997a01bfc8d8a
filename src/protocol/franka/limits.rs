//! What an arm lets its joints be commanded.
//!
//! Source: "Franka Control Interface documentation", "Robot and interface specifications"; the constants of libfranka 0.9.2
//! for the FER and of version 5.9 of the FR3's system image.

use super::command::Version;

/// Joints of an arm.
pub const JOINTS: usize = 7;
/// Largest torque \[N m\].
pub const TORQUE: [f64; JOINTS] = [87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0];
/// Largest change of a torque \[N m/s\].
pub const TORQUE_RATE: f64 = 1000.0;

/// Limits of the joints of one kind of arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArmLimits {
    /// Positions \[rad\].
    pub position: [[f64; 2]; JOINTS],
    /// Largest velocity \[rad/s\].
    pub velocity: [f64; JOINTS],
    /// Largest acceleration \[rad/s²\].
    pub acceleration: [f64; JOINTS],
    /// Largest jerk \[rad/s³\].
    pub jerk: [f64; JOINTS],
    /// `(offset, deceleration)` of the bound that the FR3 sets near the ends of a joint \[rad/s, rad/s²\].
    approach: Option<[(f64, f64); JOINTS]>,
}

/// Panda, also called FER.
pub const FER: ArmLimits = ArmLimits {
    position: [
        [-2.8973, 2.8973],
        [-1.7628, 1.7628],
        [-2.8973, 2.8973],
        [-3.0718, -0.0698],
        [-2.8973, 2.8973],
        [-0.0175, 3.7525],
        [-2.8973, 2.8973],
    ],
    velocity: [2.175, 2.175, 2.175, 2.175, 2.61, 2.61, 2.61],
    acceleration: [15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0],
    jerk: [7500.0, 3750.0, 5000.0, 6250.0, 7500.0, 10000.0, 10000.0],
    approach: None,
};

/// FR3.
pub const FR3: ArmLimits = ArmLimits {
    position: [
        [-2.9007, 2.9007],
        [-1.8361, 1.8361],
        [-2.9007, 2.9007],
        [-3.0770, -0.1169],
        [-2.8763, 2.8763],
        [0.4398, 4.6216],
        [-3.0508, 3.0508],
    ],
    velocity: [2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26],
    acceleration: [10.0; JOINTS],
    jerk: [5000.0; JOINTS],
    approach: Some([
        (0.6599, 6.0),
        (0.2517, 2.585),
        (0.2, 3.5),
        (0.3533, 4.0),
        (0.5757, 17.0),
        (0.4878, 5.5),
        (0.4628, 17.0),
    ]),
};

impl ArmLimits {
    /// Those of the arm that speaks a version.
    pub fn of(version: Version) -> &'static ArmLimits {
        match version {
            Version::V5 => &FER,
            Version::V10 => &FR3,
        }
    }

    /// Smallest and largest velocity of a joint that stands at `q` \[rad/s\].
    pub fn velocity_at(&self, joint: usize, q: f64) -> [f64; 2] {
        let largest = self.velocity[joint];
        let Some((offset, deceleration)) = self.approach.map(|all| all[joint]) else {
            return [-largest, largest];
        };
        let [low, high] = self.position[joint];
        let bound = |left: f64| largest.min(((2.0 * deceleration * left).max(0.0).sqrt() - offset).max(0.0));
        [-bound(q - low), bound(high - q)]
    }

    /// `(offset, deceleration)` of a joint's bound near its ends \[rad/s, rad/s²\]; zeros where it has none.
    pub fn approach(&self, joint: usize) -> (f64, f64) {
        self.approach.map_or((0.0, 0.0), |all| all[joint])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fr3_slows_down_towards_its_ends() {
        assert_eq!(FER.velocity_at(0, 2.89), [-2.175, 2.175]);
        assert_eq!(FR3.velocity_at(0, 0.0), [-2.62, 2.62]);
        let [down, up] = FR3.velocity_at(0, 2.8007);
        assert_eq!(down, -2.62);
        assert!((up - (1.2_f64.sqrt() - 0.6599)).abs() < 1e-9, "{up}");
        assert_eq!(FR3.velocity_at(0, 2.9), [-2.62, 0.0]);
    }
}
