//! Contacts between two capsules: of the nearest points of their segments (Ericson, "Real-Time Collision
//! Detection", 5.1.9).

use super::sphere::{Ball, balls, clip};
use super::{PreContact, Shape};
use crate::math::{add_scaled, dot, scale, sub};
use crate::model::bounds::MINVAL;

/// Two capsules: one contact, or up to two when the segments are parallel.
pub fn capsule_capsule(a: &Shape, b: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let axis1 = scale(a.axis(), a.size[1]);
    let axis2 = scale(b.axis(), b.size[1]);
    let dif = sub(a.pos, b.pos);

    // Normal equations of the squared distance in the segment parameters, each in [-1, 1].
    let ma = dot(axis1, axis1);
    let mb = -dot(axis1, axis2);
    let mc = dot(axis2, axis2);
    let u = -dot(axis1, dif);
    let v = dot(axis2, dif);
    let det = ma * mc - mb * mb;

    let at = |x1: f64, x2: f64| {
        let p1 = Ball { centre: add_scaled(a.pos, axis1, x1), radius: a.size[0], mat: &a.mat };
        let p2 = Ball { centre: add_scaled(b.pos, axis2, x2), radius: b.size[0], mat: &b.mat };
        balls(p1, p2, margin)
    };
    if det.abs() >= MINVAL {
        let (x1, x2) = nearest_parameters(ma, mb, mc, u, v, det);
        out.extend(at(x1, x2));
        return;
    }

    // Parallel: the ends of the first against the second, then the reverse, until there are two.
    let first = out.len();
    for x1 in [1.0, -1.0] {
        out.extend(at(x1, clip((v - x1 * mb) / mc, 1.0)));
    }
    for x2 in [1.0, -1.0] {
        if out.len() >= first + 2 {
            return;
        }
        out.extend(at(clip((u - x2 * mb) / ma, 1.0), x2));
    }
}

/// Parameters of the nearest points, clipped to the first segment, then to the second.
fn nearest_parameters(ma: f64, mb: f64, mc: f64, u: f64, v: f64, det: f64) -> (f64, f64) {
    let mut x1 = (mc * u - mb * v) / det;
    let mut x2 = (ma * v - mb * u) / det;
    if x1 > 1.0 {
        x1 = 1.0;
        x2 = (v - mb) / mc;
    } else if x1 < -1.0 {
        x1 = -1.0;
        x2 = (v + mb) / mc;
    }
    if x2 > 1.0 {
        x2 = 1.0;
        x1 = clip((u - mb) / ma, 1.0);
    } else if x2 < -1.0 {
        x2 = -1.0;
        x1 = clip((u + mb) / ma, 1.0);
    }
    (x1, x2)
}
