//! Volume, inertia, bounding sphere and bounding box of the primitive shapes.
//!
//! Solids: textbook formulas. Shells have their mass on the surface; the ellipsoid's area is Thomsen's
//! approximation and its shell inertia the difference of two solids (XML reference, `geom/shellinertia`).
//!
//! ```
//! use robohive_physics::geometry::shape::{bounding_radius, inertia, volume};
//! use robohive_physics::model::GeomType;
//!
//! let size = [0.1, 0.2, 0.3];
//! let mass = 1000.0 * volume(GeomType::Box, size, false);
//! assert!((mass - 48.0).abs() < 1e-9);
//! let [x, _, _] = inertia(GeomType::Box, size, mass, false);
//! assert!((x - mass * (0.4 * 0.4 + 0.6 * 0.6) / 12.0).abs() < 1e-12);
//! assert!((bounding_radius(GeomType::Box, size) - 0.14_f64.sqrt()).abs() < 1e-15);
//! ```

use crate::arrays::GeomType;
use crate::arrays::bounds::MAXVAL;
use crate::math::Legible;
use crate::math::Vec3;
use crate::math::ops;
use std::f64::consts::PI;
use std::fmt;

/// Number of size parameters a shape needs.
pub fn size_count(kind: GeomType) -> usize {
    match kind {
        GeomType::Plane | GeomType::Ellipsoid | GeomType::Box => 3,
        GeomType::Capsule | GeomType::Cylinder => 2,
        GeomType::Sphere => 1,
        GeomType::Hfield | GeomType::Mesh | GeomType::Sdf | GeomType::None => 0,
    }
}

/// A size that no shape has.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SizeError {
    /// A size that the shape needs is zero, negative or not a number.
    NotPositive {
        /// Which of the sizes, counted from 0.
        index: usize,
        /// The size \[m\].
        value: f64,
    },
    /// A size that the shape does not need is not a number.
    NotANumber,
}

impl fmt::Display for SizeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SizeError::NotPositive { index, value } => {
                write!(f, "size {} must be positive, is {}", index + 1, Legible(value))
            }
            SizeError::NotANumber => f.write_str("size is not a number"),
        }
    }
}

impl std::error::Error for SizeError {}

/// Checks the sizes \[m\] that a shape needs; a plane needs only its grid spacing.
///
/// # Errors
/// The first size that is not positive.
pub fn check_size(kind: GeomType, size: Vec3) -> Result<(), SizeError> {
    let needed = if kind == GeomType::Plane { 2..3 } else { 0..size_count(kind) };
    for k in needed {
        if size[k] <= 0.0 || size[k].is_nan() {
            return Err(SizeError::NotPositive { index: k, value: size[k] });
        }
    }
    if size.iter().any(|s| s.is_nan()) { Err(SizeError::NotANumber) } else { Ok(()) }
}

/// Volume in m³, or area in m² of a shell.
pub fn volume(kind: GeomType, s: Vec3, shell: bool) -> f64 {
    let (r, height) = (s[0], 2.0 * s[1]);
    match (kind, shell) {
        (GeomType::Sphere, false) => 4.0 * PI * r * r * r / 3.0,
        (GeomType::Sphere, true) => 4.0 * PI * r * r,
        (GeomType::Capsule, false) => PI * (r * r * height + 4.0 * r * r * r / 3.0),
        (GeomType::Capsule, true) => 4.0 * PI * r * r + 2.0 * PI * r * height,
        (GeomType::Cylinder, false) => PI * r * r * height,
        (GeomType::Cylinder, true) => 2.0 * PI * r * r + 2.0 * PI * r * height,
        (GeomType::Ellipsoid, false) => 4.0 * PI * s[0] * s[1] * s[2] / 3.0,
        (GeomType::Ellipsoid, true) => {
            let p = 1.6075;
            let sum = ops::pow(s[0] * s[1], p) + ops::pow(s[1] * s[2], p) + ops::pow(s[2] * s[0], p);
            4.0 * PI * ops::pow(sum / 3.0, 1.0 / p)
        }
        (GeomType::Hfield | GeomType::Box, false) => s[0] * s[1] * s[2] * 8.0,
        (GeomType::Hfield | GeomType::Box, true) => 8.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]),
        (GeomType::Plane | GeomType::Mesh | GeomType::Sdf | GeomType::None, _) => 0.0,
    }
}

/// Principal moments of a shape of the given mass about its centre, kg m².
pub fn inertia(kind: GeomType, s: Vec3, mass: f64, shell: bool) -> Vec3 {
    match kind {
        GeomType::Sphere => [2.0 * mass * s[0] * s[0] / if shell { 3.0 } else { 5.0 }; 3],
        GeomType::Capsule => capsule(s[0], s[1], mass, shell),
        GeomType::Cylinder if shell => cylinder_shell(s[0], s[1], mass),
        GeomType::Cylinder => {
            let (r, height) = (s[0], 2.0 * s[1]);
            let across = mass * (3.0 * r * r + height * height) / 12.0;
            [across, across, mass * r * r / 2.0]
        }
        GeomType::Ellipsoid if shell => ellipsoid_shell(s, mass),
        GeomType::Ellipsoid => solid(s, mass, 5.0),
        GeomType::Hfield | GeomType::Box if shell => box_shell(s, mass),
        GeomType::Hfield | GeomType::Box => solid(s, mass, 3.0),
        GeomType::Plane | GeomType::Mesh | GeomType::Sdf | GeomType::None => [0.0; 3],
    }
}

/// Solids whose moments are sums of two squared half sizes over `divisor`.
fn solid(s: Vec3, mass: f64, divisor: f64) -> Vec3 {
    let (x, y, z) = (s[0] * s[0], s[1] * s[1], s[2] * s[2]);
    [mass * (y + z) / divisor, mass * (x + z) / divisor, mass * (x + y) / divisor]
}

fn capsule(r: f64, half: f64, mass: f64, shell: bool) -> Vec3 {
    let height = 2.0 * half;
    if !shell {
        let caps = mass * 4.0 * r / (4.0 * r + 3.0 * height);
        let tube = mass - caps;
        let ball = 2.0 * caps * r * r / 5.0;
        let across = tube * (3.0 * r * r + height * height) / 12.0;
        let across = across + (ball + caps * height * (3.0 * r + 2.0 * height) / 8.0);
        return [across, across, tube * r * r / 2.0 + ball];
    }
    let (cap_area, tube_area) = (4.0 * PI * r * r, 2.0 * PI * r * height);
    let caps = mass * cap_area / (cap_area + tube_area);
    let tube = mass - caps;
    let ball = 2.0 * caps * r * r / 3.0;
    let com = r / 2.0;
    let offset = half + com;
    let across = tube * (6.0 * r * r + height * height) / 12.0;
    let across = across + (ball + caps * (offset * offset - com * com));
    [across, across, tube * r * r + ball]
}

fn cylinder_shell(r: f64, half: f64, mass: f64) -> Vec3 {
    let height = 2.0 * half;
    let (disk_area, tube_area) = (PI * r * r, 2.0 * PI * r * height);
    let disk = mass * disk_area / (2.0 * disk_area + tube_area);
    let tube = mass - 2.0 * disk;
    let disk_across = disk * r * r / 4.0 + disk * half * half;
    let across = tube * (6.0 * r * r + height * height) / 12.0 + 2.0 * disk_across;
    [across, across, tube * r * r + 2.0 * (disk * r * r / 2.0)]
}

fn ellipsoid_shell(s: Vec3, mass: f64) -> Vec3 {
    let grown = s.map(|x| x + 1e-6);
    let inner = 4.0 * PI * s[0] * s[1] * s[2] / 3.0;
    let outer = 4.0 * PI * grown[0] * grown[1] * grown[2] / 3.0;
    let density = mass / (outer - inner);
    let a = solid(s, inner * density, 5.0);
    let b = solid(grown, outer * density, 5.0);
    [b[0] - a[0], b[1] - a[1], b[2] - a[2]]
}

fn box_shell(s: Vec3, mass: f64) -> Vec3 {
    let (x2, y2, z2) = (s[0] * s[0], s[1] * s[1], s[2] * s[2]);
    let [lx, ly, lz] = s.map(|x| 2.0 * x);
    let (a0, a1, a2) = (lx * ly, ly * lz, lz * lx);
    let total = 2.0 * (a0 + a1 + a2);
    let (m0, m1, m2) = (mass * a0 / total, mass * a1 / total, mass * a2 / total);
    let (x0, y0, z0) = (m0 * ly * ly / 12.0, m0 * lx * lx / 12.0, m0 * (lx * lx + ly * ly) / 12.0);
    let (x1, y1, z1) = (m1 * (ly * ly + lz * lz) / 12.0, m1 * lz * lz / 12.0, m1 * ly * ly / 12.0);
    let (x_2, y_2, z_2) = (m2 * lz * lz / 12.0, m2 * (lx * lx + lz * lz) / 12.0, m2 * lx * lx / 12.0);
    [
        2.0 * (m0 * z2 + m2 * y2 + x0 + x1 + x_2),
        2.0 * (m0 * z2 + m1 * x2 + y0 + y1 + y_2),
        2.0 * (m1 * x2 + m2 * y2 + z0 + z1 + z_2),
    ]
}

/// Radius of the sphere about the geom frame's origin that contains the shape; 0 for a plane.
pub fn bounding_radius(kind: GeomType, s: Vec3) -> f64 {
    match kind {
        GeomType::Sphere => s[0],
        GeomType::Capsule => s[0] + s[1],
        GeomType::Cylinder => (s[0] * s[0] + s[1] * s[1]).sqrt(),
        GeomType::Ellipsoid => s[0].max(s[1]).max(s[2]),
        GeomType::Box | GeomType::Mesh | GeomType::Sdf => (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]).sqrt(),
        GeomType::Plane | GeomType::Hfield | GeomType::None => 0.0,
    }
}

/// Bounding box in the geom frame: centre, half sizes.
pub fn bounding_box(kind: GeomType, s: Vec3) -> [f64; 6] {
    let half = match kind {
        GeomType::Sphere => [s[0]; 3],
        GeomType::Capsule => [s[0], s[0], s[0] + s[1]],
        GeomType::Cylinder => [s[0], s[0], s[1]],
        GeomType::Plane => {
            return [0.0, 0.0, -MAXVAL / 2.0, MAXVAL, MAXVAL, MAXVAL / 2.0];
        }
        _ => s,
    };
    [0.0, 0.0, 0.0, half[0], half[1], half[2]]
}

/// Bounding box of a height field: it rises by `size[2]` and reaches down by `size[3]`.
pub fn hfield_box(size: [f64; 4]) -> [f64; 6] {
    [0.0, 0.0, (size[2] - size[3]) / 2.0, size[0], size[1], (size[2] + size[3]) / 2.0]
}

/// Bounding radius of a height field.
pub fn hfield_radius(size: [f64; 4]) -> f64 {
    let rise = (size[2] * size[2]).max(size[3] * size[3]);
    (size[0] * size[0] + size[1] * size[1] + rise).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capsule_without_tube_is_a_sphere() {
        for shell in [false, true] {
            let ball = inertia(GeomType::Sphere, [0.3, 0.0, 0.0], 2.0, shell);
            let pill = inertia(GeomType::Capsule, [0.3, 0.0, 0.0], 2.0, shell);
            assert!(ball[0] > 0.05);
            for k in 0..3 {
                assert!((ball[k] - pill[k]).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn shell_is_the_derivative_of_the_solid() {
        // Growing all sizes of a unit-density solid by h adds area·h of volume and the shell's moment.
        let (s, h) = ([0.2, 0.3, 0.4], 1e-6);
        let grown = s.map(|x| x + h);
        let area = volume(GeomType::Box, s, true);
        assert!(
            (volume(GeomType::Box, grown, false) - volume(GeomType::Box, s, false) - area * h).abs() < 1e-11
        );
        let moment = |s: Vec3| inertia(GeomType::Box, s, volume(GeomType::Box, s, false), false);
        let shell = inertia(GeomType::Box, s, area, true);
        for k in 0..3 {
            let derivative = (moment(grown)[k] - moment(s)[k]) / h;
            assert!((derivative - shell[k]).abs() < 1e-5 * shell[k], "{derivative} {}", shell[k]);
        }
    }
}
