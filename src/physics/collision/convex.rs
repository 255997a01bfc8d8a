//! Contacts and distances between convex geoms (documentation: Computation, "Convex collisions").
//!
//! GJK measures the distance of separated bodies, polytope expansion the depth of overlapping ones. A sphere or
//! capsule is first taken as its point or segment: as long as that lies outside the other body, GJK alone gives the
//! exact penetration. With the native algorithms disabled, portal refinement finds one contact of overlapping bodies.

use super::epa::{self, Failure};
use super::gjk::{BEYOND, Limits, gjk};
use super::mpr::overlap;
use super::multicontact::Witness;
use super::round_normal;
pub use super::scratch::ConvexScratch;
use super::shape::{PreContact, Shape};
use super::support::{ConvexBody, Solid};
use crate::math::{
    Mat3, Vec3, add, add_scaled, cross, distance, dot, mul_mat, mul_mat_vec, normalize, quat_from_axis_angle,
    quat_to_mat, scale, sub, transpose,
};
use crate::model::{Disable, Model, Options};
use crate::stages::Kinematics;

/// Angle by which geoms are rocked to find more contacts \[rad\].
const ROCKING_ANGLE: f64 = 1e-3;
/// Contacts nearer than this fraction of the smaller bounding radius are one contact.
const SAME_CONTACT: f64 = 1e-3;

impl Limits {
    /// Limits of a model's options.
    pub fn new(opt: &Options, cutoff: f64) -> Self {
        let iterations = usize::try_from(opt.ccd_iterations).unwrap_or(0);
        Limits { iterations, tolerance: opt.ccd_tolerance, cutoff }
    }
}

/// Signed distance between two bodies, 0 when they touch or the depth could not be found, [`BEYOND`] past the
/// cut-off. Leaves the nearest points in `scratch.witness`; several when `max_contacts` allows.
fn measure(
    a: &mut ConvexBody,
    b: &mut ConvexBody,
    limits: &Limits,
    max_contacts: usize,
    scratch: &mut ConvexScratch,
) -> f64 {
    scratch.witness.clear();
    if let Some(dist) = measure_cores(a, b, limits, scratch) {
        return dist;
    }
    let proximity = gjk(a, b, limits, &mut scratch.simplex);
    let inside = proximity.dist <= limits.tolerance && proximity.n > 1 && !proximity.separated;
    let dist = if inside { 0.0 } else { proximity.dist };
    scratch.witness.extend(proximity.nearest.map(|points| Witness { dist, points }));
    if !inside {
        return dist;
    }
    match epa::penetration(a, b, limits, &scratch.simplex[..proximity.n], &mut scratch.polytope) {
        Err(Failure::Broken) => scratch.witness.clear(),
        Err(_) => {}
        Ok(penetration) => {
            scratch.witness.clear();
            scratch.witness.push(Witness { dist: penetration.dist, points: penetration.nearest });
            if max_contacts > 1 {
                scratch.clipper.spread(a, b, &penetration, max_contacts, &mut scratch.witness);
            }
        }
    }
    scratch.witness.iter().map(|w| w.dist).reduce(|least, d| if d < least { d } else { least }).unwrap_or(0.0)
}

/// Distance by way of the points and segments within spheres and capsules; `None` without any, or when they are
/// in the other body.
fn measure_cores(
    a: &mut ConvexBody,
    b: &mut ConvexBody,
    limits: &Limits,
    scratch: &mut ConvexScratch,
) -> Option<f64> {
    let (mut core_a, mut core_b) = (a.core(), b.core());
    if core_a.is_none() && core_b.is_none() {
        return None;
    }
    let radius = [core_a.map_or(0.0, |c| c.1), core_b.map_or(0.0, |c| c.1)];
    let widened = Limits { cutoff: limits.cutoff + (radius[0] + radius[1]), ..*limits };
    let proximity = gjk(
        core_a.as_mut().map_or(a, |core| &mut core.0),
        core_b.as_mut().map_or(b, |core| &mut core.0),
        &widened,
        &mut scratch.simplex,
    );
    if proximity.dist <= limits.tolerance {
        return None;
    }
    let Some([x1, x2]) = proximity.nearest else { return Some(BEYOND) };
    let dist = proximity.dist - (radius[0] + radius[1]);
    let (normal, _) = normalize(sub(x2, x1));
    let points = [add_scaled(x1, normal, radius[0]), add_scaled(x2, normal, -radius[1])];
    scratch.witness.push(Witness { dist, points });
    Some(if dist > limits.cutoff { BEYOND } else { dist })
}

/// Appends the contacts of two overlapping bodies and returns how many there are. `margin` is how much the bodies
/// are inflated together.
pub fn penetration(
    opt: &Options,
    a: &mut ConvexBody,
    b: &mut ConvexBody,
    max_contacts: usize,
    margin: f64,
    scratch: &mut ConvexScratch,
    out: &mut Vec<PreContact>,
) -> usize {
    let limits = Limits::new(opt, 0.0);
    if !is_native(opt) {
        return portal_penetration(a, b, &limits, margin, out);
    }
    let overlapping = measure(a, b, &limits, max_contacts, scratch) < 0.0;
    if !overlapping {
        return 0;
    }
    out.extend(scratch.witness.iter().map(|w| {
        let [x1, x2] = w.points;
        PreContact {
            dist: margin + w.dist,
            pos: scale(add(x1, x2), 0.5),
            normal: normalize(sub(x1, x2)).0,
            tangent: [0.0; 3],
        }
    }));
    scratch.witness.len()
}

fn is_native(opt: &Options) -> bool {
    !opt.disableflags.contains(Disable::NATIVECCD)
}

fn portal_penetration(
    a: &mut ConvexBody,
    b: &mut ConvexBody,
    limits: &Limits,
    margin: f64,
    out: &mut Vec<PreContact>,
) -> usize {
    match overlap(a, b, limits) {
        Some(found) if found.direction != [0.0; 3] => {
            let dist = margin - found.depth;
            out.push(PreContact { dist, pos: found.pos, normal: found.direction, tangent: [0.0; 3] });
            1
        }
        _ => 0,
    }
}

/// Appends the contacts of convex geoms `g1` and `g2`.
pub fn convex(
    m: &Model,
    kin: &Kinematics,
    g1: usize,
    g2: usize,
    margin: f64,
    scratch: &mut ConvexScratch,
    out: &mut Vec<PreContact>,
) {
    let shapes = [g1, g2].map(|g| Shape::new(m, kin, g));
    let bodies = shapes.map(|shape| ConvexBody::new(&shape, margin));
    let [Some(a), Some(b)] = bodies else { return };
    let mut pair = Pair { opt: &m.opt, shapes, bodies: [a, b], margin };
    let many = !m.opt.disableflags.contains(Disable::MULTICCD);
    let max_contacts = if is_native(&m.opt) { one_pass_contacts(&a, &b, many) } else { 1 };
    let first = out.len();
    let found = pair.find(max_contacts, scratch, out);
    if found == 1 && max_contacts == 1 && many && can_rock(&a) && can_rock(&b) {
        let same = SAME_CONTACT * m.geom_rbound[g1].min(m.geom_rbound[g2]);
        pair.rock(first, same, scratch, out);
    }
}

/// How many contacts one pass may find: only polyhedra without margin give several.
fn one_pass_contacts(a: &ConvexBody, b: &ConvexBody, many: bool) -> usize {
    match (&a.solid, &b.solid) {
        _ if a.margin > 0.0 || b.margin > 0.0 => 1,
        (Solid::Box(_), Solid::Box(_)) => 8,
        (Solid::Box(_) | Solid::Mesh(_), Solid::Box(_) | Solid::Mesh(_)) if many => 4,
        _ => 1,
    }
}

fn can_rock(body: &ConvexBody) -> bool {
    !matches!(body.solid, Solid::Ellipsoid(_) | Solid::Sphere(_))
}

/// Two geoms and the inflated bodies that stand for them.
struct Pair<'m> {
    opt: &'m Options,
    shapes: [Shape<'m>; 2],
    bodies: [ConvexBody<'m>; 2],
    margin: f64,
}

impl Pair<'_> {
    fn find(&mut self, max_contacts: usize, scratch: &mut ConvexScratch, out: &mut Vec<PreContact>) -> usize {
        let [a, b] = &mut self.bodies;
        let found = penetration(self.opt, a, b, max_contacts, self.margin, scratch, out);
        if found > 0 && !is_native(self.opt) {
            let contact = out.len() - 1;
            round_normal::correct(&mut out[contact], &self.shapes[0], &self.shapes[1]);
        }
        found
    }

    /// Turns the bodies against each other about contact `first`, to and fro about both tangents, and appends the
    /// contacts that this brings out, with the depth of the first.
    fn rock(&mut self, first: usize, same: f64, scratch: &mut ConvexScratch, out: &mut Vec<PreContact>) {
        let PreContact { pos: pivot, normal, dist, .. } = out[first];
        for axis in tangents(normal) {
            for angle in [-ROCKING_ANGLE, ROCKING_ANGLE] {
                let turn = quat_to_mat(quat_from_axis_angle(axis, angle));
                self.turn(0, pivot, &turn);
                self.turn(1, pivot, &transpose(&turn));
                let last = out.len();
                if self.find(1, scratch, out) > 0 {
                    let pos = out[last].pos;
                    if out[first..last].iter().any(|c| distance(c.pos, pos) <= same) {
                        out.truncate(last);
                    } else {
                        out[last].dist = dist;
                    }
                }
            }
        }
    }

    /// Places a body as its geom turned about a point.
    fn turn(&mut self, i: usize, pivot: Vec3, turn: &Mat3) {
        let Shape { pos, mat, .. } = self.shapes[i];
        let arm = sub(pivot, pos);
        self.bodies[i].pos = sub(pos, sub(mul_mat_vec(turn, arm), arm));
        self.bodies[i].mat = mul_mat(turn, &mat);
    }
}

/// Two unit vectors that make a right-handed frame with a unit normal.
fn tangents(normal: Vec3) -> [Vec3; 2] {
    let (normal, _) = normalize(normal);
    let guess = if normal[1].abs() < 0.5 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    let (y, _) = normalize(sub(guess, scale(normal, dot(normal, guess))));
    [y, cross(normal, y)]
}

/// Signed distance between two convex geoms, at most `limit`, and the segment between their nearest points where
/// the search computed it.
pub fn convex_distance(
    m: &Model,
    kin: &Kinematics,
    g1: usize,
    g2: usize,
    limit: f64,
    scratch: &mut ConvexScratch,
) -> (f64, Option<[Vec3; 2]>) {
    let bodies = [g1, g2].map(|g| ConvexBody::new(&Shape::new(m, kin, g), 0.0));
    let [Some(mut a), Some(mut b)] = bodies else { return (limit, None) };
    let dist = measure(&mut a, &mut b, &Limits::new(&m.opt, limit), 1, scratch);
    (if dist < limit { dist } else { limit }, scratch.witness.first().map(|w| w.points))
}
