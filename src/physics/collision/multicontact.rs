//! Several contacts from one penetration of boxes and meshes: where a face of one body lies against a face or an
//! edge of the other, the overlap of the two is clipped out (Sutherland and Hodgman, Reentrant Polygon Clipping,
//! 1974) and its corners are the contacts.

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
    /// Signed distance; negative in penetration [m].
    pub dist: f64,
    /// A point of each body.
    pub points: [Vec3; 2],
}

/// Reused memory: features and polygons of the two bodies.
#[derive(Clone, Debug, Default)]
pub struct Clipper {
    faces: [Vec<FaceNormal>; 2],
    edges: Vec<Edge>,
    polygons: [Vec<Vec3>; 2],
    clip: Clip,
}

/// Reused memory of one clipping.
#[derive(Clone, Debug, Default)]
struct Clip {
    /// Inward normal and offset of the plane through each edge of the clipping face.
    sides: Vec<(Vec3, f64)>,
    polygon: Vec<Vec3>,
    clipped: Vec<Vec3>,
}

/// How two polyhedra lie against each other: indices into the lists of faces and edges.
enum Match {
    FaceFace(usize, usize),
    /// Edge of the first body, face of the second.
    EdgeFace(usize, usize),
    /// Face of the first body, edge of the second.
    FaceEdge(usize, usize),
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
        let (Some(pa), Some(pb)) = (Polyhedron::new(a), Polyhedron::new(b)) else { return };
        let features = [Feature::new(&penetration.face, 0), Feature::new(&penetration.face, 1)];
        let [x1, x2] = penetration.nearest;
        pa.faces_at(&features[0], sub(x1, x2), &mut self.faces[0]);
        pb.faces_at(&features[1], sub(x2, x1), &mut self.faces[1]);
        let Some(matched) = self.find_match(&pa, &pb, &features) else { return };

        let [first, second] = &mut self.polygons;
        match matched {
            Match::FaceFace(i, j) => {
                let ((normal, f1), (opposite, f2)) = (self.faces[0][i], self.faces[1][j]);
                pa.polygon(f1, first);
                pb.polygon(f2, second);
                self.clip.run(first, second, normal, opposite, limit, out);
            }
            Match::FaceEdge(i, j) => {
                let (normal, face) = self.faces[0][i];
                pa.polygon(face, first);
                second.clear();
                second.extend([features[1].corner(), self.edges[j].1]);
                self.clip.run(first, second, normal, scale(normal, -1.0), limit, out);
            }
            Match::EdgeFace(i, j) => {
                let (normal, face) = self.faces[1][j];
                pb.polygon(face, second);
                first.clear();
                first.extend([features[0].corner(), self.edges[i].1]);
                self.clip.run(second, first, normal, scale(normal, -1.0), limit, out);
                // The clipping face was the second body's. MuJoCo exchanges the points even if nothing was left
                // and the single witness stands.
                out.iter_mut().for_each(|w| w.points.swap(0, 1));
            }
        }
    }

    fn find_match(&mut self, pa: &Polyhedron, pb: &Polyhedron, features: &[Feature; 2]) -> Option<Match> {
        if let Some((i, j)) = opposed_faces(&self.faces[0], &self.faces[1]) {
            return Some(Match::FaceFace(i, j));
        }
        let [d1, d2] = [features[0].dim, features[1].dim];
        if d1 < 3 && d1 <= d2 {
            pa.edges_at(&features[0], &mut self.edges);
            return parallel_edge(&self.edges, &self.faces[1]).map(|(e, f)| Match::EdgeFace(e, f));
        }
        if d2 < 3 {
            pb.edges_at(&features[1], &mut self.edges);
            return parallel_edge(&self.edges, &self.faces[0]).map(|(e, f)| Match::FaceEdge(f, e));
        }
        None
    }
}

/// First pair of faces that look at each other.
fn opposed_faces(first: &[FaceNormal], second: &[FaceNormal]) -> Option<(usize, usize)> {
    for (i, &(n, _)) in first.iter().enumerate() {
        if let Some(j) = second.iter().position(|&(o, _)| dot(n, o) < -FACE_ALIGNMENT) {
            return Some((i, j));
        }
    }
    None
}

/// First edge along a face: index of the edge, index of the face.
fn parallel_edge(edges: &[Edge], faces: &[FaceNormal]) -> Option<(usize, usize)> {
    for (f, &(n, _)) in faces.iter().enumerate() {
        if let Some(e) = edges.iter().position(|&(d, _)| dot(d, n).abs() < EDGE_ALIGNMENT) {
            return Some((e, f));
        }
    }
    None
}

impl Clip {
    /// Clips `subject` (a polygon or an edge) by the prism over `face`, drops what is above the face, and writes
    /// a witness for each corner that remains: on `subject`, and moved against `dir` onto the face.
    /// Leaves `out` alone when nothing remains.
    fn run(
        &mut self,
        face: &[Vec3],
        subject: &[Vec3],
        normal: Vec3,
        dir: Vec3,
        limit: usize,
        out: &mut Vec<Witness>,
    ) {
        if face.len() < 3 {
            return;
        }
        self.set_sides(face, normal);
        self.polygon.clear();
        self.polygon.extend_from_slice(subject);
        for (&corner, &side) in face.iter().zip(&self.sides) {
            cut(&self.polygon, corner, side, &mut self.clipped);
            std::mem::swap(&mut self.polygon, &mut self.clipped);
        }
        self.polygon.retain(|&p| dot(sub(p, face[0]), normal) <= 0.0);
        if self.polygon.is_empty() {
            return;
        }
        let witness = |p: Vec3| {
            let dist = dot(sub(p, face[0]), normal);
            Witness { dist, points: [add_scaled(p, dir, -dist.abs()), p] }
        };
        let polygon = &self.polygon;
        out.clear();
        if limit < 5 && polygon.len() > 4 {
            out.extend(largest_quadrilateral(polygon).map(|i| witness(polygon[i])));
        } else if subject.len() == 2 && polygon.len() > 2 {
            out.extend(most_distant(polygon).map(|i| witness(polygon[i])));
        } else {
            out.extend(polygon.iter().take(MAXCONPAIR).map(|&p| witness(p)));
        }
    }

    fn set_sides(&mut self, face: &[Vec3], normal: Vec3) {
        self.sides.clear();
        for (i, &v) in face.iter().enumerate() {
            let next = face[(i + 1) % face.len()];
            let up = sub(add(v, normal), v);
            let (side, _) = normalize(cross(sub(next, v), up));
            self.sides.push((side, dot(side, v)));
        }
    }
}

/// Keeps the part of a polygon on the inner side of a plane through `corner`.
fn cut(polygon: &[Vec3], corner: Vec3, (side, offset): (Vec3, f64), out: &mut Vec<Vec3>) {
    out.clear();
    let inside = |p: Vec3| dot(sub(p, corner), side) > -MINVAL;
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (p_in, q_in) = (inside(p), inside(q));
        if p_in != q_in {
            let along = sub(q, p);
            let slope = dot(side, along);
            let t = (offset - dot(side, p)) / slope;
            if slope != 0.0 && (0.0..=1.0).contains(&t) {
                out.push(add_scaled(p, along, t));
            }
        }
        if q_in {
            out.push(q);
        }
    }
}

/// Corners of the quadrilateral of largest area, found by rotating calipers.
fn largest_quadrilateral(polygon: &[Vec3]) -> [usize; 4] {
    let n = polygon.len();
    let next = |i: usize| (i + 1) % n;
    let area = |q: [usize; 4]| area(q.map(|i| polygon[i]));
    let mut q = [0, 1, 2, 3];
    let (mut best, mut largest) = (q, area(q));
    for a in 0..n {
        q[0] = a;
        // The last corner advances while the area grows; after each advance the third and the second follow.
        let mut advance = |q: &mut [usize; 4], corner: usize| {
            let mut moved = *q;
            moved[corner] = next(q[corner]);
            let larger = area(moved);
            let grows = larger > largest;
            if grows {
                (*q, best, largest) = (moved, moved, larger);
            }
            grows
        };
        while advance(&mut q, 3) {
            while advance(&mut q, 2) {}
            while advance(&mut q, 1) {}
        }
        for corner in 1..4 {
            if q[corner] != q[corner - 1] {
                break;
            }
            q[corner] = next(q[corner]);
        }
    }
    best
}

fn area([a, b, c, d]: [Vec3; 4]) -> f64 {
    0.5 * norm(add(cross(sub(d, a), sub(b, d)), cross(sub(c, b), sub(a, c))))
}

/// The two corners farthest from each other.
fn most_distant(polygon: &[Vec3]) -> [usize; 2] {
    let (mut best, mut farthest) = ([0, 1], 0.0);
    for i in 0..polygon.len() {
        for j in i + 1..polygon.len() {
            let d = sub(polygon[j], polygon[i]);
            if dot(d, d) > farthest {
                farthest = dot(d, d);
                best = [i, j];
            }
        }
    }
    best
}
