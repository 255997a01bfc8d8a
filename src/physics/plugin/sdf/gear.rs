//! A spur gear with involute teeth.

use super::{Field, fields, intersection, length, subtraction, union};
use crate::math::{Vec3, ops};
use std::f64::consts::PI;

fields! {
    /// `mujoco.sdf.gear`: a gear about the z axis.
    Gear = "mujoco.sdf.gear" {
        alpha = 0.0, diameter = 2.8, teeth = 25.0, thickness = 0.2, innerdiameter = -1.0,
    } Wheel;
}

#[derive(Debug)]
struct Wheel {
    /// Angle by which it is turned [rad].
    alpha: f64,
    /// Of the pitch circle.
    diameter: f64,
    teeth: f64,
    thickness: f64,
    /// Of the hole; negative for the usual one.
    innerdiameter: f64,
}

/// The union of two, rounded over a length `k`.
fn smooth_union(a: f64, b: f64, k: f64) -> f64 {
    let h = (0.5 + 0.5 * (b - a) / k).clamp(0.0, 1.0);
    b * (1.0 - h) + a * h - k * h * (1.0 - h)
}

/// The intersection of two, rounded over a length `k`.
fn smooth_intersection(a: f64, b: f64, k: f64) -> f64 {
    subtraction(intersection(a, b), smooth_union(subtraction(a, b), subtraction(b, a), k))
}

/// `x` less whole multiples of `y`.
fn remainder(x: f64, y: f64) -> f64 {
    x - y * (x / y).floor()
}

impl Wheel {
    /// Distance in the plane of the gear.
    fn profile(&self, x: f64, y: f64) -> f64 {
        let (pitch, n) = (self.diameter, self.teeth);
        let pressure = 3.096e-5 * n * n - 6.557e-3 * n + 0.551;
        let pitch_radius = pitch / 2.0;
        let rho = length(x, y);
        let density = n / pitch;
        let outer = (pitch + 2.0 * (1.0 / density)) / 2.0;
        let depth = 2.2 / density;
        let inner =
            if self.innerdiameter >= 0.0 { self.innerdiameter / 2.0 } else { outer - depth - 0.14 * pitch };
        if inner - rho > 0.0 {
            return inner - rho;
        }
        if outer - rho < -0.2 {
            return rho - outer;
        }
        let base = pitch * ops::cos(pressure) / 2.0;
        let angle = ops::angle(y, x) + self.alpha;
        let stride = PI / density / pitch_radius;
        let involute = ops::arc_cosine(base / pitch_radius);
        let shift = stride / 2.0 - 2.0 * (ops::tangent(involute) - involute);
        let ahead = remainder(angle + shift / 2.0, stride) - shift / 2.0;
        let behind = remainder(-angle - shift + shift / 2.0, stride) - shift / 2.0;
        let flanks = if base < rho {
            let unwound = ops::arc_cosine(base / rho);
            let tangent = (rho * rho - base * base).sqrt();
            intersection(tangent - base * (ahead + unwound), tangent - base * (behind + unwound))
        } else {
            -1.0e6
        };
        let walls = intersection(ahead - (stride - shift), behind - (stride - shift));
        let teeth = smooth_intersection(rho - outer, intersection(walls, flanks), 0.0035 * pitch);
        let teeth = smooth_union(rho - (outer - depth), teeth, base - outer + depth);
        subtraction(teeth, rho - inner)
    }
}

impl Field for Wheel {
    fn distance(&self, [x, y, z]: Vec3) -> f64 {
        let across = self.profile(x, y);
        let along = z.abs() - self.thickness / 2.0;
        let outside = length(intersection(across, 0.0), intersection(along, 0.0));
        union(intersection(across, along), 0.0) + outside
    }

    fn bounds(&self) -> [f64; 6] {
        let across = self.diameter / 2.0 * 1.25;
        [0.0, 0.0, 0.0, across, across, self.thickness / 2.0 * 1.1]
    }
}
