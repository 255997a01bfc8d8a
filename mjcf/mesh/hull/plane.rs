//! Planes through three points. The order of the operations decides the last bits of every height, and so
//! which of several nearly coplanar points is a vertex.

use crate::vector::{dot, sub};

/// Points `p` with `normal · p + offset = 0`; the normal is a unit vector that points outwards.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Plane {
    pub normal: [f64; 3],
    pub offset: f64,
}

/// Elimination met a pivot that round-off may have made.
pub(super) struct Singular(pub Plane);

impl Plane {
    /// Signed distance of a point, positive outside.
    pub(super) fn height(&self, p: [f64; 3]) -> f64 {
        let n = self.normal;
        self.offset + p[0] * n[0] + p[1] * n[1] + p[2] * n[2]
    }

    /// Projection of a point onto the plane.
    pub(super) fn project(&self, p: [f64; 3]) -> [f64; 3] {
        let height = self.height(p);
        std::array::from_fn(|k| p[k] - height * self.normal[k])
    }

    pub(super) fn cosine(&self, other: &Self) -> f64 {
        dot(self.normal, other.normal)
    }

    pub(super) fn reversed(self) -> Self {
        Self { normal: self.normal.map(|x| -x), offset: -self.offset }
    }

    /// Plane through three corners that are clockwise seen from outside if `clockwise`: from the cross
    /// product of two edges, or by elimination if a corner lies farther from that than `round`.
    pub(super) fn through(
        corners: [[f64; 3]; 3],
        clockwise: bool,
        round: f64,
        zero: &[f64; 3],
    ) -> Result<Self, Singular> {
        let [p, q, r] = corners;
        let (a, b) = (sub(q, p), sub(r, p));
        let cross = [b[1] * a[2] - b[2] * a[1], a[0] * b[2] - a[2] * b[0], b[0] * a[1] - b[1] * a[0]];
        let normal = unit(cross, clockwise);
        let along = |v: [f64; 3]| v[0] * normal[0] + v[1] * normal[1] + v[2] * normal[2];
        let offset = -along(p);
        if [q, r].iter().any(|&corner| (offset + along(corner)).abs() > round) {
            return Self::by_elimination(p, [a, b], clockwise, zero);
        }
        Ok(Self { normal, offset })
    }

    /// Plane through `p` along two edges: their echelon form gives the normal from its last component on.
    fn by_elimination(
        p: [f64; 3],
        [mut upper, mut lower]: [[f64; 3]; 2],
        clockwise: bool,
        zero: &[f64; 3],
    ) -> Result<Self, Singular> {
        let swapped = lower[0].abs() > upper[0].abs();
        if swapped {
            std::mem::swap(&mut upper, &mut lower);
        }
        let mut singular = upper[0].abs() <= zero[0];
        if upper[0] != 0.0 {
            let factor = lower[0] / upper[0];
            lower[1] -= factor * upper[1];
            lower[2] -= factor * upper[2];
        }
        singular |= lower[1].abs() <= zero[1];
        let negative = clockwise ^ swapped ^ (upper[0] < 0.0) ^ (lower[1] < 0.0);
        let z = if negative { -1.0 } else { 1.0 };
        let mut normal = [0.0, 0.0, z];
        if lower[1] != 0.0 {
            normal[1] = (0.0 - lower[2] * z) / lower[1];
        } else {
            normal = [0.0, z, 0.0];
        }
        if upper[0] != 0.0 {
            normal[0] = (0.0 - upper[1] * normal[1] - upper[2] * normal[2]) / upper[0];
        } else {
            normal = [z, 0.0, 0.0];
        }
        let normal = unit(normal, true);
        let offset = -(p[0] * normal[0]) - p[1] * normal[1] - p[2] * normal[2];
        let plane = Self { normal, offset };
        if singular { Err(Singular(plane)) } else { Ok(plane) }
    }
}

/// `n` at length one, reversed unless `positive`; an arbitrary unit vector for zero.
fn unit(n: [f64; 3], positive: bool) -> [f64; 3] {
    let norm = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    if norm == 0.0 {
        return [(1.0f64 / 3.0).sqrt(); 3];
    }
    let norm = if positive { norm } else { -norm };
    n.map(|x| x / norm)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f64; 3]; 3] = [[1.0, 2.0, 3.0], [4.0, 1.0, 2.5], [0.5, 3.0, 7.0]];

    fn height_of_corners(plane: &Plane) -> f64 {
        CORNERS.iter().map(|&corner| plane.height(corner).abs()).fold(0.0, f64::max)
    }

    /// A bound that no plane meets makes the elimination take over: the same plane, up to round-off.
    #[test]
    fn elimination_agrees_with_the_cross_product() {
        for clockwise in [false, true] {
            let plane = |round: f64| Plane::through(CORNERS, clockwise, round, &[1e-15; 3]).ok().unwrap();
            let (direct, eliminated) = (plane(1e-12), plane(-1.0));
            assert!(height_of_corners(&direct) < 1e-14 && height_of_corners(&eliminated) < 1e-14);
            assert!((direct.cosine(&eliminated) - 1.0).abs() < 1e-15);
            let [p, q, r] = CORNERS;
            let counter_clockwise = crate::vector::cross(sub(q, p), sub(r, p));
            assert_eq!(dot(direct.normal, counter_clockwise) < 0.0, clockwise);
        }
    }

    #[test]
    fn collinear_corners_are_singular() {
        let line = [[0.0; 3], [1.0, 1.0, 1.0], [2.0, 2.0, 2.0]];
        assert!(Plane::through(line, false, -1.0, &[1e-15; 3]).is_err());
    }

    #[test]
    fn projection_and_reversal() {
        let plane = Plane::through(CORNERS, false, 1e-12, &[1e-15; 3]).ok().unwrap();
        let p = [9.0, -4.0, 2.0];
        assert!(plane.height(plane.project(p)).abs() < 1e-14);
        assert_eq!(plane.reversed().height(p), -plane.height(p));
    }
}
