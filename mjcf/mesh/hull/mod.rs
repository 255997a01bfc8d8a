//! Convex hull of the vertices of a mesh, after Barber, Dobkin & Huhdanpaa 1996, "The Quickhull algorithm
//! for convex hulls", ACM TOMS 22(4).
//!
//! A tetrahedron of four points grows by one point at a time. Every point that is still above some facet
//! waits at one such facet; the facet at the head of the agenda gives the point farthest above it. The
//! facets below that point disappear, and a cone of triangles joins it to the horizon around them.
//! Coordinates have round-off, so neighbouring facets are united where they are not clearly convex, and a
//! finished facet may be a polygon; polygons are cut into triangles at the end.
//!
//! | step | file |
//! |---|---|
//! | first tetrahedron | `seed` |
//! | points above facets, and which facet a point belongs to | `waiting`, `locate` |
//! | facets below a point, horizon, cone | `cone` |
//! | facets that are not clearly convex, their union | `convexity`, `merge`, `slivers`, `unite`, `dissolve` |
//! | triangles | `fan` |
//! | the hull while it grows: facets, ridges, vertices and their orders | `builder`, `surface`, `sequence`, `id` |
//! | planes and error bounds | `plane`, `tolerance` |
//!
//! Contacts depend on which of several nearly coplanar points are vertices, and the compiled arrays on the
//! order of vertices and triangles. Both follow from the order in which points are added, facets are searched
//! and neighbours are listed; comments say where an order or a tie matters to the result. The error bounds
//! and these orders agree with the hulls that MuJoCo compiles.

mod builder;
mod cone;
mod convexity;
mod dissolve;
mod failure;
mod fan;
mod id;
mod locate;
mod merge;
mod plane;
mod seed;
mod sequence;
mod slivers;
mod surface;
mod tolerance;
mod unite;
mod waiting;

pub use fan::Hull;

use crate::vector::{cross, dot, sub};
use builder::Builder;
use failure::Failure;
use id::FacetId;
use std::fmt;

/// Lengths and relative distances below this count as zero.
const MINVAL: f64 = 1e-15;

/// Why points have no convex hull.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum HullError {
    /// The points span no volume; what they are instead.
    Flat(&'static str),
    /// A numerical accident that the construction cannot continue from.
    Accident(&'static str),
}

impl fmt::Display for HullError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            HullError::Flat(what) => write!(f, "vertices are {what}, there is no convex hull"),
            HullError::Accident(why) => write!(f, "no convex hull: {why}"),
        }
    }
}

impl std::error::Error for HullError {}

/// Hull of `points` \[m\]; at most `max_vert` vertices unless that is -1.
///
/// # Errors
/// The points span no volume, or the construction meets a numerical accident.
pub fn convex_hull(points: &[[f64; 3]], max_vert: i32) -> Result<Hull, HullError> {
    check_spread(points)?;
    let limit = usize::try_from(max_vert).ok();
    match build(points, limit) {
        Ok(hull) => Ok(hull),
        Err(_) => {
            // Moving the points by far less than they are apart avoids the coincidence.
            let moved = joggle(points);
            build(&moved, limit).map_err(|Failure(why)| HullError::Accident(why))
        }
    }
}

fn build(points: &[[f64; 3]], limit: Option<usize>) -> Result<Hull, Failure> {
    let mut builder = Builder::tetrahedron(points)?;
    builder.assign_all();
    // A point that a union takes from the hull may come again, but not forever.
    let mut room = 4 * points.len() + 100;
    while let Some((point, facet)) = builder.next_point(limit.is_some()) {
        room = room.checked_sub(1).ok_or(Failure("points leave the hull and come again"))?;
        if limit.is_some_and(|limit| builder.surface.vertex_order.len() >= limit) {
            break;
        }
        builder.add_point(point, facet)?;
    }
    builder.surface.triangulated()
}

impl Builder<'_> {
    /// Extends the hull by a point that waited at `facet`.
    fn add_point(&mut self, point: usize, facet: FacetId) -> Result<(), Failure> {
        self.slack.raise_limit(&self.tol);
        let horizon = self.trace_horizon(point, facet)?;
        let level = self.raise_cone(point, horizon)?;
        self.make_convex(level)?;
        self.reassign();
        self.surface.finish_step();
        Ok(())
    }
}

/// Points that are not within `MINVAL` of a plane, as MuJoCo tests it.
fn check_spread(points: &[[f64; 3]]) -> Result<(), HullError> {
    let fail = |what| Err(HullError::Flat(what));
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
