//! Several contacts from one penetration of boxes and meshes: where a face of one body lies against a face or an
//! edge of the other, the corners of what they share are the contacts.
//!
//! 1. `Clipper::find_overlap` decides which face the contacts lie on and what of the other body is over it.
//! 2. A `Prism` over that face clips what is over it, plane by plane (Sutherland and Hodgman, Reentrant Polygon Clipping,
//!    1974).
//! 3. `Selection` decides which of the corners become contacts.

use super::epa::Penetration;
use super::polyhedron::{Edge, FACE_ALIGNMENT, FaceNormal, Feature, Polyhedron};
use super::support::ConvexBody;
use crate::math::{Vec3, add, add_scaled, cross, dot, norm, normalize, scale, sub};
use crate::model::bounds::{MAXCONPAIR, MINVAL};

/// Sine of the angle, about 5.1 degrees, within which an edge counts as parallel to a face.
const EDGE_ALIGNMENT: f64 = 0.0888;

/// Nearest points of two bodies and their signed distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Witness {
    /// Signed distance; negative in penetration \[m\].
    pub dist: f64,
    /// A point of each body.
    pub points: [Vec3; 2],
}

/// Reused memory: features of the two bodies, and the polygons to be clipped.
#[derive(Clone, Debug, Default)]
pub struct Clipper {
    faces: [Vec<FaceNormal>; 2],
    edges: Vec<Edge>,
    /// The face that the contacts lie on.
    base: Vec<Vec3>,
    prism: Prism,
}

/// How two polyhedra lie against each other.
struct Overlap {
    /// The body, 0 or 1, that has the base.
    body: usize,
    /// The face that the contacts lie on.
    base: FaceNormal,
    over: Over,
}

/// What of the other body lies over the face.
enum Over {
    Face(FaceNormal),
    Edge([Vec3; 2]),
}

impl Clipper {
    /// Replaces the single witness in `out` by the corners of the overlap, if the bodies have parallel features at
    /// the point of penetration; a `limit` below 5 keeps at most 4.
    pub fn spread(
        &mut self,
        a: &ConvexBody,
        b: &ConvexBody,
        penetration: &Penetration,
        limit: usize,
        out: &mut Vec<Witness>,
    ) {
        let (Some(a), Some(b)) = (Polyhedron::new(a), Polyhedron::new(b)) else { return };
        let bodies = [a, b];
        let Some(overlap) = self.find_overlap(&bodies, penetration) else { return };
        let (normal, face) = overlap.base;
        bodies[overlap.body].polygon(face, &mut self.base);
        let polygon = &mut self.prism.polygon;
        let against = match overlap.over {
            Over::Face((opposite, face)) => {
                bodies[1 - overlap.body].polygon(face, polygon);
                opposite
            }
            Over::Edge(ends) => {
                polygon.clear();
                polygon.extend(ends);
                scale(normal, -1.0)
            }
        };
        let is_edge = matches!(overlap.over, Over::Edge(_));
        if let &[origin, _, _, ..] = self.base.as_slice() {
            let ground = Plane { normal, point: origin };
            let corners = self.prism.clip(&self.base, &ground);
            if !corners.is_empty() {
                out.clear();
                let witness = |&p: &Vec3| ground.witness(p, against);
                match Selection::of(corners, limit, is_edge) {
                    Selection::All => out.extend(corners.iter().take(MAXCONPAIR).map(witness)),
                    Selection::Quadrilateral(four) => out.extend(four.map(|i| witness(&corners[i]))),
                    Selection::Ends(two) => out.extend(two.map(|i| witness(&corners[i]))),
                }
            }
        }
        if overlap.body == 1 {
            // The first point lies on the face, so here on the second body. MuJoCo exchanges the points even if nothing was
            // left and the single witness stands.
            out.iter_mut().for_each(|w| w.points.swap(0, 1));
        }
    }

    /// Two faces that look at each other or, where there are none, an edge along a face. The body whose feature has fewer
    /// vertices gives the edge, the first of equal ones.
    fn find_overlap(&mut self, bodies: &[Polyhedron; 2], penetration: &Penetration) -> Option<Overlap> {
        let features = [0, 1].map(|body| Feature::new(&penetration.face, body));
        let [x1, x2] = penetration.nearest;
        for (body, outward) in [sub(x1, x2), sub(x2, x1)].into_iter().enumerate() {
            bodies[body].faces_at(&features[body], outward, &mut self.faces[body]);
        }
        if let Some((base, opposite)) = opposed_faces(&self.faces[0], &self.faces[1]) {
            return Some(Overlap { body: 0, base, over: Over::Face(opposite) });
        }
        let edged = usize::from(features[1].dim < features[0].dim);
        if features[edged].dim == 3 {
            return None;
        }
        bodies[edged].edges_at(&features[edged], &mut self.edges);
        let ((_, end), base) = parallel_edge(&self.edges, &self.faces[1 - edged])?;
        Some(Overlap { body: 1 - edged, base, over: Over::Edge([features[edged].corner(), end]) })
    }
}

/// First pair of faces that look at each other.
fn opposed_faces(first: &[FaceNormal], second: &[FaceNormal]) -> Option<(FaceNormal, FaceNormal)> {
    let mut pairs = first.iter().flat_map(|one| second.iter().map(move |other| (*one, *other)));
    pairs.find(|(one, other)| dot(one.0, other.0) < -FACE_ALIGNMENT)
}

/// First edge along a face, of the first face that has one.
fn parallel_edge(edges: &[Edge], faces: &[FaceNormal]) -> Option<(Edge, FaceNormal)> {
    let mut pairs = faces.iter().flat_map(|face| edges.iter().map(move |edge| (*edge, *face)));
    pairs.find(|(edge, face)| dot(edge.0, face.0).abs() < EDGE_ALIGNMENT)
}

/// A plane through a point.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: Vec3,
    point: Vec3,
}

impl Plane {
    fn height(&self, p: Vec3) -> f64 {
        dot(sub(p, self.point), self.normal)
    }

    /// The corner `p` and the point of the plane, the face of the other body, that it is moved to against `direction`.
    fn witness(&self, p: Vec3, direction: Vec3) -> Witness {
        let dist = self.height(p);
        Witness { dist, points: [add_scaled(p, direction, -dist.abs()), p] }
    }

    /// Where the plane cuts the segment from `p` to `q`.
    fn cut(&self, p: Vec3, q: Vec3) -> Option<Vec3> {
        let along = sub(q, p);
        let slope = dot(self.normal, along);
        let t = (dot(self.normal, self.point) - dot(self.normal, p)) / slope;
        (slope != 0.0 && (0.0..=1.0).contains(&t)).then(|| add_scaled(p, along, t))
    }
}

/// The space under a face, bounded by its plane and by the planes through its edges; clips polygons in reused memory.
#[derive(Clone, Debug, Default)]
struct Prism {
    polygon: Vec<Vec3>,
    clipped: Vec<Vec3>,
}

impl Prism {
    /// Leaves of the polygon what is in the prism under `face`.
    fn clip(&mut self, face: &[Vec3], ground: &Plane) -> &[Vec3] {
        for (i, &corner) in face.iter().enumerate() {
            let next = face[(i + 1) % face.len()];
            // The normal with the rounding that it gets at the corner, as in MuJoCo.
            let up = sub(add(corner, ground.normal), corner);
            let (inward, _) = normalize(cross(sub(next, corner), up));
            self.keep_inside(&Plane { normal: inward, point: corner });
        }
        self.polygon.retain(|&p| ground.height(p) <= 0.0);
        &self.polygon
    }

    /// Walks around the polygon and keeps what is on the inner side of a plane: corners there, and the points where the walk
    /// passes the plane.
    fn keep_inside(&mut self, plane: &Plane) {
        let inside = |p: Vec3| plane.height(p) > -MINVAL;
        self.clipped.clear();
        let Some(&first) = self.polygon.first() else { return };
        let (mut here, mut here_inside) = (first, inside(first));
        for &next in self.polygon[1..].iter().chain([&first]) {
            let next_inside = inside(next);
            if here_inside != next_inside {
                self.clipped.extend(plane.cut(here, next));
            }
            if next_inside {
                self.clipped.push(next);
            }
            (here, here_inside) = (next, next_inside);
        }
        std::mem::swap(&mut self.polygon, &mut self.clipped);
    }
}

/// Which corners of an overlap become contacts.
enum Selection {
    All,
    /// Those of the largest quadrilateral.
    Quadrilateral([usize; 4]),
    /// The two that are farthest apart: an edge has no more, the rest are repetitions.
    Ends([usize; 2]),
}

impl Selection {
    fn of(corners: &[Vec3], limit: usize, is_edge: bool) -> Self {
        if limit < 5 && corners.len() > 4 {
            Selection::Quadrilateral(largest_quadrilateral(corners))
        } else if is_edge && corners.len() > 2 {
            Selection::Ends(most_distant(corners))
        } else {
            Selection::All
        }
    }
}

/// Corners of a large quadrilateral: as its first corner goes around a convex polygon, the other corners of the largest
/// quadrilateral with that corner go around in the same sense (Dobkin and Snyder, On a General Method for Maximizing and
/// Minimizing among Certain Geometric Problems, 1979). A corner advances only to more area than any quadrilateral had before.
fn largest_quadrilateral(polygon: &[Vec3]) -> [usize; 4] {
    let mut calipers = Calipers::new(polygon);
    for first in 0..polygon.len() {
        calipers.corners[0] = first;
        while calipers.advance(3) {
            while calipers.advance(2) {}
            while calipers.advance(1) {}
        }
        calipers.push_ahead();
    }
    calipers.best
}

/// A quadrilateral on the corners of a polygon, and the largest one so far.
struct Calipers<'p> {
    polygon: &'p [Vec3],
    corners: [usize; 4],
    best: [usize; 4],
    area: f64,
}

impl<'p> Calipers<'p> {
    fn new(polygon: &'p [Vec3]) -> Self {
        let corners = [0, 1, 2, 3];
        Calipers { polygon, corners, best: corners, area: area(corners.map(|i| polygon[i])) }
    }

    fn after(&self, corner: usize) -> usize {
        (self.corners[corner] + 1) % self.polygon.len()
    }

    /// Moves a corner on if that gives the largest area so far.
    fn advance(&mut self, corner: usize) -> bool {
        let mut moved = self.corners;
        moved[corner] = self.after(corner);
        let area = area(moved.map(|i| self.polygon[i]));
        let grows = area > self.area;
        if grows {
            (self.corners, self.best, self.area) = (moved, moved, area);
        }
        grows
    }

    /// Moves on the corners that the ones before them have reached.
    fn push_ahead(&mut self) {
        for corner in 1..4 {
            if self.corners[corner] != self.corners[corner - 1] {
                break;
            }
            self.corners[corner] = self.after(corner);
        }
    }
}

/// Area of a quadrilateral, half the length of the sum of the normals of two triangles.
fn area([a, b, c, d]: [Vec3; 4]) -> f64 {
    0.5 * norm(add(cross(sub(d, a), sub(b, d)), cross(sub(c, b), sub(a, c))))
}

/// The two corners farthest from each other, the first two of equally far ones.
fn most_distant(polygon: &[Vec3]) -> [usize; 2] {
    let pairs = (0..polygon.len()).flat_map(|i| (i + 1..polygon.len()).map(move |j| [i, j]));
    let farther = |best: ([usize; 2], f64), pair: [usize; 2]| {
        let gap = sub(polygon[pair[1]], polygon[pair[0]]);
        let distance2 = dot(gap, gap);
        if distance2 > best.1 { (pair, distance2) } else { best }
    };
    pairs.fold(([0, 1], 0.0), farther).0
}
