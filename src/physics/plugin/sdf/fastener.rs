//! Bolt and nut, with one thread.
//!
//! But for the hexagon and the ends of the shaft, all their surfaces are at 45° to the axis: the flanks of the thread, a V
//! groove of 90°, and the cones of the chamfers. In the half-plane through the axis and a point, such a surface is a line. With
//! `beyond` the distance of the point from the cylinder of the nominal radius, and `height` its distance along the
//! axis from where the surface meets that cylinder, the line is `beyond = height`, and the distance from it
//! `(beyond − height) / √2`.

use super::{Field, fields, intersection, length, positive, subtraction, union};
use crate::math::{Vec3, ops};
use crate::model::AttributeError;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

fields! {
    /// `mujoco.sdf.bolt`: a hexagonal head on a threaded shaft along negative z.
    Bolt = "mujoco.sdf.bolt" { radius = 0.26, } Screw;
    /// `mujoco.sdf.nut`: the hexagonal head with a threaded hole.
    Nut = "mujoco.sdf.nut" { radius = 0.26, } Hole;
}

/// Distance along the axis from turn to turn.
const PITCH: f64 = 1.0 / 12.0;
/// Where the shaft of a bolt ends.
const TIP: f64 = -1.0;
/// Height of the head and of a nut, below z = 0.
const THICKNESS: f64 = 0.5;
/// Distance of each flat from the axis.
const FLAT: f64 = 0.5;
/// Where the chamfer of the head meets the cylinder of the nominal radius, above the head.
const CHAMFER: f64 = 0.22;
/// Depth of the countersink of a nut.
const COUNTERSINK: f64 = 0.05;

/// Distance from a surface at 45°, which widens as `height` grows.
fn slanted(beyond: f64, height: f64) -> f64 {
    (beyond - height) * FRAC_1_SQRT_2
}

/// Distance from the layer from `bottom` to `top`.
fn layer(z: f64, bottom: f64, top: f64) -> f64 {
    intersection(bottom - z, z - top)
}

/// Distance from a thread without ends, whose grooves reach down to the nominal radius.
///
/// The groove climbs one pitch a turn and crosses the half-plane of azimuth 0 half a pitch above the origin. Seen in the
/// half-plane of the point, grooves are a pitch apart, and flanks rise on both sides of each.
fn thread(beyond: f64, [x, y, z]: Vec3) -> f64 {
    let above = z / PITCH - ops::angle(y, x) / (2.0 * PI) - 0.5;
    slanted(beyond, (above - above.round()).abs() * PITCH)
}

/// Distance from the head: three pairs of opposite flats, 60° from pair to pair, between two planes, with
/// a chamfer around its top.
fn head(beyond: f64, [x, y, z]: Vec3) -> f64 {
    let (sin, cos) = (3.0_f64.sqrt() / 2.0, 0.5);
    let across = intersection(x.abs(), cos * x.abs() + sin * y.abs());
    let prism = intersection(across - FLAT, layer(z, -THICKNESS, 0.0));
    intersection(prism, slanted(beyond, CHAMFER - z))
}

/// A box around both.
const BOUNDS: [f64; 6] = [0.0, 0.0, 0.0, 0.6, 0.6, 1.0];

#[derive(Debug)]
struct Screw {
    radius: f64,
}

impl Screw {
    fn check(&self) -> Result<(), AttributeError> {
        positive("radius", self.radius)
    }
}

impl Field for Screw {
    fn distance(&self, point: Vec3) -> f64 {
        let [x, y, z] = point;
        let beyond = length(x, y) - self.radius;
        let pointed = slanted(beyond, z - TIP);
        let shaft = intersection(intersection(thread(beyond, point), pointed), layer(z, TIP, 0.0));
        union(head(beyond, point), shaft)
    }

    fn bounds(&self) -> [f64; 6] {
        BOUNDS
    }
}

#[derive(Debug)]
struct Hole {
    radius: f64,
}

impl Hole {
    fn check(&self) -> Result<(), AttributeError> {
        positive("radius", self.radius)
    }
}

impl Field for Hole {
    fn distance(&self, point: Vec3) -> f64 {
        let [x, y, z] = point;
        let beyond = length(x, y) - self.radius;
        let tapped = intersection(thread(beyond, point), slanted(beyond, z + THICKNESS));
        let countersink = slanted(beyond, z + COUNTERSINK);
        subtraction(head(beyond, point), union(tapped, countersink))
    }

    fn bounds(&self) -> [f64; 6] {
        BOUNDS
    }
}
