//! OptiTrack: frames of NatNet, and the packet that RoboHive's own server sends.
//!
//! Source: NaturalPoint, "NatNet SDK" documentation and the sample client that documents the direct depacketisation;
//! bitstreams 3.0 and 4.1.

pub mod natnet;
pub mod robohive;

/// Pose of a rigid body in the tracker's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Body {
    /// Its number at the tracker.
    pub id: i32,
    /// Position \[m\].
    pub position: [f64; 3],
    /// Orientation, w-x-y-z.
    pub orientation: [f64; 4],
    /// Mean distance of its markers from where they should be \[m\].
    pub error: f64,
    /// Whether it was seen in this frame; if not, the pose is an old one.
    pub tracked: bool,
}

/// Angles of RoboHive's rigid body for the orientation w-x-y-z of a tracker's: the intrinsic angles x-y-z of the rotation,
/// turned as RoboHive's markers sit on its robots (π − x, y, −z).
///
/// Source: RoboHive 0.7, `robot.py`, the branch for the interface `optitrack`.
pub fn turned_angles(orientation: [f64; 4]) -> [f64; 3] {
    let [w, x, y, z] = orientation;
    let sine = (2.0 * (x * z + w * y)).clamp(-1.0, 1.0);
    let a = (2.0 * (w * x - y * z)).atan2(w * w - x * x - y * y + z * z);
    let c = (2.0 * (w * z - x * y)).atan2(w * w + x * x - y * y - z * z);
    [std::f64::consts::PI - a, sine.asin(), -c]
}

/// The orientation that has these [`turned_angles`].
pub fn quaternion_of_turned([a, b, c]: [f64; 3]) -> [f64; 4] {
    let half = [std::f64::consts::PI - a, b, -c].map(|angle| angle / 2.0);
    let ([sx, sy, sz], [cx, cy, cz]) = (half.map(f64::sin), half.map(f64::cos));
    // A turn about x, then about the new y, then about the new z.
    [
        cx * cy * cz - sx * sy * sz,
        sx * cy * cz + cx * sy * sz,
        cx * sy * cz - sx * cy * sz,
        cx * cy * sz + sx * sy * cz,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_and_orientations_are_each_others_inverse() {
        assert_eq!(quaternion_of_turned([std::f64::consts::PI, 0.0, 0.0]), [1.0, 0.0, 0.0, 0.0]);
        // A quarter turn about z: c = -π/2, and a = π.
        let quarter = std::f64::consts::FRAC_1_SQRT_2;
        let [a, b, c] = turned_angles([quarter, 0.0, 0.0, quarter]);
        assert!((a - std::f64::consts::PI).abs() < 1e-12 && b.abs() < 1e-12);
        assert!((c + std::f64::consts::FRAC_PI_2).abs() < 1e-12);
        for angles in [[0.1, -0.2, 0.3], [0.5, 1.2, -2.0], [-1.0, 0.4, 0.9]] {
            for (there, back) in angles.iter().zip(turned_angles(quaternion_of_turned(angles))) {
                let away = (there - back).rem_euclid(std::f64::consts::TAU);
                assert!(away.min(std::f64::consts::TAU - away) < 1e-12, "{angles:?}");
            }
        }
    }
}
