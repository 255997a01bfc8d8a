//! The first tetrahedron.
//!
//! Four points far from each other keep the first planes accurate. The extreme points along the axes are
//! tried first; all points are measured only where those span little.

use super::builder::{Builder, Search};
use super::failure::Failure;
use super::id::{FacetId, Marks, VertexId};
use super::plane::{Plane, Singular};
use super::slivers::Slivers;
use super::surface::{Side, Surface};
use super::tolerance::{Slack, Tolerances};

/// A tetrahedron with a dihedral angle of a cosine below this is narrow.
const NARROW_COSINE: f64 = -0.99999999;
/// Extreme points that span less than this share of what is possible are compared with all points.
const FLAT_RATIO: f64 = 1.0e-3;

/// A point and the size of what it spans with the corners before it.
#[derive(Clone, Copy)]
struct Corner {
    point: usize,
    size: f64,
}

/// Twice the area, in the plane of the first two coordinates, or six times the volume that `p` spans with
/// two or three corners.
fn span(p: [f64; 3], corners: &[[f64; 3]]) -> f64 {
    let from = |v: [f64; 3]| [v[0] - p[0], v[1] - p[1], v[2] - p[2]];
    let determinant = match corners {
        &[a, b] => {
            let (a, b) = (from(a), from(b));
            a[0] * b[1] - a[1] * b[0]
        }
        _ => {
            let [a, b, c] = [from(corners[0]), from(corners[1]), from(corners[2])];
            let minor = |p: [f64; 3], q: [f64; 3]| p[1] * q[2] - p[2] * q[1];
            a[0] * minor(b, c) - b[0] * minor(a, c) + c[0] * minor(a, b)
        }
    };
    determinant.abs()
}

/// Four points that span a large volume: the extremes in x, then those that span most with the ones before;
/// the first of equals.
fn corners(points: &[[f64; 3]], extreme: &[usize; 6], tol: &Tolerances) -> Result<[usize; 4], Failure> {
    let x = |p: usize| points[p][0];
    let least = extreme[1..].iter().fold(extreme[0], |least, &p| if x(p) < x(least) { p } else { least });
    let most = extreme[1..].iter().fold(extreme[0], |most, &p| if x(p) > x(most) { p } else { most });
    if least == most {
        return Err(Failure("all points have the same x"));
    }
    let mut size = x(most) - x(least);
    let mut corners = [least, most, least, least];
    for known in 2..4 {
        let best = next_corner(points, extreme, &corners[..known], tol, size * tol.width)?;
        corners[known] = best.point;
        size = best.size;
    }
    Ok(corners)
}

/// The point that spans most with `corners`, which could span `possible` at best.
fn next_corner(
    points: &[[f64; 3]],
    extreme: &[usize; 6],
    corners: &[usize],
    tol: &Tolerances,
    possible: f64,
) -> Result<Corner, Failure> {
    let zero = 10.0 * tol.zero[corners.len() - 1];
    let at: Vec<[f64; 3]> = corners.iter().map(|&p| points[p]).collect();
    let mut best: Option<Corner> = None;
    let improve = |best: &mut Option<Corner>, point: usize| {
        let size = span(points[point], &at);
        let better = size > best.map_or(-1.0, |best| best.size);
        if better {
            *best = Some(Corner { point, size });
        }
        better
    };
    for &point in extreme.iter().filter(|p| !corners.contains(p)) {
        improve(&mut best, point);
    }
    let flat = |best: Corner| best.size < zero || (best.size > 0.0 && best.size / possible < FLAT_RATIO);
    if best.is_none_or(flat) {
        for point in (0..points.len()).filter(|p| !extreme.contains(p) && !corners.contains(p)) {
            let large = |best: Corner| best.size >= zero && best.size > 10.0 * FLAT_RATIO * possible;
            if improve(&mut best, point) && best.is_some_and(large) {
                break;
            }
        }
    }
    best.ok_or(Failure("too few points"))
}

impl<'a> Builder<'a> {
    /// The hull of four of the points.
    pub(super) fn tetrahedron(points: &'a [[f64; 3]]) -> Result<Self, Failure> {
        let (tol, extreme) = Tolerances::of(points);
        let mut surface = Surface::default();
        let mut vertices = corners(points, &extreme, &tol)?.map(|point| surface.add_vertex(point));
        vertices.reverse();
        let mut interior = [0.0; 3];
        for (axis, mean) in interior.iter_mut().enumerate() {
            for &vertex in &vertices {
                *mean += points[surface.vertices[vertex].point][axis];
            }
            *mean /= 4.0;
        }
        let facets = join(&mut surface, vertices);
        let (slack, search, slivers) = (Slack::default(), Search::default(), Slivers::default());
        let grown = Marks::default();
        let mut builder =
            Self { points, tol, slack, interior, narrow: false, surface, search, slivers, grown };
        builder.orient(facets)?;
        builder.surface.finish_step();
        Ok(builder)
    }

    /// Planes of the first facets, all with the interior below them.
    fn orient(&mut self, facets: [FacetId; 4]) -> Result<(), Failure> {
        self.set_plane(facets[0]);
        if self.height(self.interior, facets[0]) > self.tol.round {
            for facet in facets {
                let facet = &mut self.surface.facets[facet];
                facet.side = facet.side.opposite();
            }
            self.set_plane(facets[0]);
        }
        facets[1..].iter().for_each(|&facet| self.set_plane(facet));
        if facets.iter().any(|&facet| self.surface.facets[facet].inverted) {
            return Err(Failure("the initial simplex is flat"));
        }
        let plane = |facet: FacetId| &self.surface.facets[facet].plane;
        self.narrow = facets
            .iter()
            .any(|&f| facets.iter().any(|&g| f != g && plane(f).cosine(plane(g)) < NARROW_COSINE));
        Ok(())
    }

    /// Plane of a triangle. One through nearly collinear corners may come out upside down, as its elimination
    /// loses the orientation, so the interior decides.
    pub(super) fn set_plane(&mut self, facet: FacetId) {
        let Self { points, tol, interior, surface, .. } = self;
        let Surface { facets, vertices, .. } = surface;
        let facet = &mut facets[facet];
        let corners = std::array::from_fn(|k| points[vertices[facet.corners[k]].point]);
        facet.plane = match Plane::through(corners, facet.side == Side::Right, tol.round, &tol.zero) {
            Err(Singular(plane)) if plane.height(*interior) > 0.0 => plane.reversed(),
            Ok(plane) | Err(Singular(plane)) => plane,
        };
        facet.inverted = facet.plane.height(*interior) >= -tol.round;
    }
}

/// The four triangles between four vertices, which are given the newest first. Their orientations agree;
/// whether they are inside out depends on the points.
fn join(surface: &mut Surface, vertices: [VertexId; 4]) -> [FacetId; 4] {
    for vertex in vertices {
        surface.vertex_order.remove(vertex);
        surface.vertex_order.push(vertex);
    }
    let [a, b, c, d] = vertices;
    let (right, left) = (Side::Right, Side::Left);
    let facets = [([b, c, d], right), ([a, c, d], left), ([a, b, d], right), ([a, b, c], left)]
        .map(|(corners, side)| surface.add_triangle(corners, side));
    for facet in facets {
        surface.facets[facet].neighbors = facets.into_iter().filter(|&other| other != facet).collect();
    }
    facets
}
