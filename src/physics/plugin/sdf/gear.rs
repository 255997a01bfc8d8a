//! A spur gear with involute teeth.
//!
//! The cross-section has `n` equal teeth, each the mirror image of itself, so a point is described by its distance `ρ` from
//! the axis and the angle `δ` to the middle of the nearest tooth. Lengths follow from the diametral pitch `n / D` (Dudley,
//! "Handbook of Practical Gear Design", chapter 2): the addendum is `D / n`, the whole depth `2.2 D / n`.
//!
//! **Flank.** A string unwound from the base circle of radius `b` draws an involute. At distance `ρ` its free part is
//! `t = √(ρ² − b²)` long and spans the angle `a = arccos(b / ρ)` seen from the axis, while the angle `t / b` has come off
//! the circle; the involute has therefore turned by `inv a = tan a − a` since it left the circle. A tooth that is `w`
//! radians wide on each side at its base is `w − inv a` wide at `ρ`. The string is normal to every involute of the circle and
//! involutes that start an angle apart cut it at that angle times `b`, so the distance from the flank is
//! `b (inv a − (w − δ)) = t − b (a + w − δ)`.
//!
//! **Width.** At the pitch circle, where `a` is the pressure angle `ψ`, tooth and gap are equally wide: a quarter of the angle
//! between teeth on each side. Hence `w = π / (2 n) + inv ψ`.

use super::{Field, fields, intersection, length, positive, subtraction, union};
use crate::math::Legible;
use crate::math::{Vec3, ops};
use crate::model::AttributeError;
use std::f64::consts::PI;

fields! {
    /// `mujoco.sdf.gear`: a gear about the z axis.
    Gear = "mujoco.sdf.gear" {
        alpha = 0.0, diameter = 2.8, teeth = 25.0, thickness = 0.2, innerdiameter = -1.0,
    } Wheel;
}

#[derive(Debug)]
struct Wheel {
    /// Angle by which it is turned, clockwise \[rad\]. Without it a flank leaves the base circle on the x axis.
    alpha: f64,
    /// Of the pitch circle.
    diameter: f64,
    teeth: f64,
    thickness: f64,
    /// Of the hole; negative for the usual one.
    innerdiameter: f64,
}

/// Distance from the tip circle at which the teeth no longer count.
const FAR: f64 = 0.2;
/// Rounding of the tips, in diameters.
const TIP_ROUNDING: f64 = 0.0035;
/// Ring between the teeth and the usual hole, in diameters.
const RING: f64 = 0.14;

/// What rounds the edge between two surfaces whose distances differ by `gap`, over differences less than `reach`.
///
/// The smaller of two distances is their mean less half of `gap`, which has a kink at `gap = 0`. Subtracting
/// `β = c (reach − gap)²` takes it away if the slope of `gap / 2 + β` is zero there, that is for `c = 1 / (4 reach)`. At
/// `gap = reach`, `β` ends with zero slope.
fn rounding(gap: f64, reach: f64) -> f64 {
    let overlap = reach - gap;
    if overlap > 0.0 { overlap * overlap / (4.0 * reach) } else { 0.0 }
}

/// The union of two, with a fillet.
fn filleted_union(a: f64, b: f64, reach: f64) -> f64 {
    union(a, b) - rounding((a - b).abs(), reach)
}

/// The intersection of two, with its edge rounded off.
fn rounded_intersection(a: f64, b: f64, reach: f64) -> f64 {
    intersection(a, b) + rounding((a - b).abs(), reach)
}

/// As [`rounded_intersection`], for a sharp edge farther out: there, beyond the corner where the distances cancel, the rounding
/// counts from the other surface's mirror image, so that it fades.
fn rounded_tip(a: f64, b: f64, reach: f64) -> f64 {
    let (near, far) = (union(a, b), intersection(a, b));
    intersection(far, union(far, -near) + rounding(far - near, reach))
}

impl Wheel {
    fn check(&self) -> Result<(), AttributeError> {
        positive("diameter", self.diameter)?;
        positive("thickness", self.thickness)?;
        match self.teeth >= 1.0 {
            true => Ok(()),
            false => Err(format!("attribute 'teeth' is {}: set it to 1 or more", Legible(self.teeth)).into()),
        }
    }

    /// Pressure angle [rad]: fewer teeth need more. A fit over the usual numbers of teeth, which MuJoCo's gears have.
    fn pressure_angle(&self) -> f64 {
        0.551 + self.teeth * (-6.557e-3 + self.teeth * 3.096e-5)
    }

    /// Bound of the distance from the tooth nearest to a point at a polar angle, before its tip is cut.
    fn flank(&self, rho: f64, polar: f64, base: f64) -> f64 {
        let (pressure, spacing) = (self.pressure_angle(), 2.0 * PI / self.teeth);
        let half_width = spacing / 4.0 + (ops::tangent(pressure) - pressure);
        let turned = polar + self.alpha - half_width;
        let from_middle = (turned - spacing * (turned / spacing).round()).abs();
        // Beside the sector that the tooth takes on the base circle; the angle stands for a distance.
        let beside = from_middle - half_width;
        if rho <= base {
            return beside;
        }
        let string = (rho * rho - base * base).sqrt();
        intersection(beside, string - base * (ops::arc_cosine(base / rho) - beside))
    }

    /// Distance in the plane of the gear.
    fn profile(&self, x: f64, y: f64) -> f64 {
        let (rho, pitch) = (length(x, y), self.diameter / 2.0);
        let addendum = self.diameter / self.teeth;
        let (tip, root) = (pitch + addendum, pitch - 1.2 * addendum);
        let hole =
            if self.innerdiameter >= 0.0 { self.innerdiameter / 2.0 } else { root - RING * self.diameter };
        if rho < hole {
            return hole - rho;
        }
        if rho > tip + FAR {
            return rho - tip;
        }
        let base = pitch * ops::cos(self.pressure_angle());
        let flank = self.flank(rho, ops::angle(y, x), base);
        let teeth = rounded_tip(rho - tip, flank, TIP_ROUNDING * self.diameter);
        // The fillet reaches from the root circle to the base circle. With more than about a hundred teeth the base circle is
        // the smaller one, and teeth are left only inside the root circle.
        let fillet = base - root;
        let wheel = if fillet >= 0.0 {
            filleted_union(rho - root, teeth, fillet)
        } else {
            rounded_intersection(rho - root, teeth, -fillet)
        };
        subtraction(wheel, rho - hole)
    }
}

impl Field for Wheel {
    /// The profile extended along the axis. Outside of both its side and its end, the nearest point is on the edge.
    fn distance(&self, [x, y, z]: Vec3) -> f64 {
        let side = self.profile(x, y);
        let end = z.abs() - self.thickness / 2.0;
        if side > 0.0 && end > 0.0 { length(side, end) } else { intersection(side, end) }
    }

    fn bounds(&self) -> [f64; 6] {
        let across = self.diameter / 2.0 * 1.25;
        [0.0, 0.0, 0.0, across, across, self.thickness / 2.0 * 1.1]
    }
}
