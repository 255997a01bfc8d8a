//! Convex hull of the vertices of a mesh: Quickhull with merged facets (Barber, Dobkin & Huhdanpaa
//! 1996, "The Quickhull algorithm for convex hulls", ACM TOMS 22(4)).
//!
//! Points are added one by one, each time the one farthest above some facet; the facets it sees are
//! replaced by a cone to the horizon. A new facet within round-off of the plane of its horizon facet is
//! merged with it, so that facets are polygons; they are cut into triangles at the end. Tolerances,
//! order of insertion and order of every list are those of Qhull, because contacts depend on which of
//! several nearly coplanar points is a vertex, and on the order of vertices and faces.

mod cone;
mod convexity;
mod cycle;
mod locate;
mod merge;
mod polytope;
mod simplex;
mod triangulate;
mod vertices;

use crate::vector::{cross, dot, sub};
use polytope::Polytope;

/// A triangulated convex hull; all indices are input points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Hull {
    /// Points on the hull.
    pub vert: Vec<i32>,
    /// Hull neighbours of each entry of `vert`, as points.
    pub neighbours: Vec<Vec<i32>>,
    /// Triangles, counter-clockwise seen from outside.
    pub face: Vec<[i32; 3]>,
}

/// A numerical accident the construction cannot continue from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Failure(&'static str);

/// Lengths and relative distances below this count as zero.
const MINVAL: f64 = 1e-15;

/// Hull of `points`; at most `max_vert` vertices unless that is -1. The error says why there is none.
pub fn convex_hull(points: &[[f64; 3]], max_vert: i32) -> Result<Hull, String> {
    check_spread(points)?;
    let limit = usize::try_from(max_vert).ok();
    match build(points, limit) {
        Ok(hull) => Ok(hull),
        Err(_) => {
            // Moving the points by far less than they are apart avoids the coincidence.
            let moved = joggle(points);
            build(&moved, limit).map_err(|Failure(why)| format!("no convex hull: {why}"))
        }
    }
}

fn build(points: &[[f64; 3]], limit: Option<usize>) -> Result<Hull, Failure> {
    let mut hull = Polytope::simplex(points)?;
    hull.partition_all();
    hull.grow(limit)?;
    hull.triangulate()?;
    Ok(hull.export())
}

/// Points that are not within `MINVAL` of a plane, as MuJoCo tests it.
fn check_spread(points: &[[f64; 3]]) -> Result<(), String> {
    let fail = |what: &str| Err(format!("vertices are {what}, there is no convex hull"));
    let length = |v: [f64; 3]| dot(v, v).sqrt();
    let Some(&origin) = points.first() else { return fail("missing") };
    let Some(second) = points.iter().position(|&p| length(sub(p, origin)) > MINVAL) else {
        return fail("at one place");
    };
    let edge = sub(points[second], origin);
    let normal = points.iter().enumerate().skip(1).filter(|(k, _)| *k != second).find_map(|(_, &p)| {
        let other = sub(p, origin);
        let n = cross(edge, other);
        let (size, span) = (length(n), length(other));
        (span >= MINVAL && size > MINVAL * length(edge) * span).then(|| n.map(|x| x / size))
    });
    let Some(normal) = normal else { return fail("on a line") };
    let offset = dot(normal, origin);
    if points.iter().all(|&p| (dot(normal, p) - offset).abs() <= MINVAL * length(edge)) {
        return fail("on a plane");
    }
    Ok(())
}

/// The points displaced by up to 1e-11 of their largest coordinate, the same way on every run.
fn joggle(points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let reach = points.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
    let mut state = 1u64;
    let mut displaced = |x: f64| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        x + 1e-11 * reach * ((state >> 11) as f64 / (1u64 << 52) as f64 - 1.0)
    };
    points.iter().map(|p| p.map(&mut displaced)).collect()
}
