//! Contacts of two boxes: the separating axis theorem finds the direction of least penetration (Gottschalk, Lin,
//! Manocha 1996), then either one edge pair touches or one face is clipped against another (Sutherland, Hodgman
//! 1974).
//!
//! Everything is computed in the frame of the first box, or of the box that owns the reference face.

use super::sphere::clip;
use super::{PreContact, Shape};
use crate::math::{Mat3, Vec3, add, add_scaled, column, dot, mul_mat_t_mat, mul_mat_t_vec, mul_mat_vec};
use crate::math::{normalize, scale, sub, transpose};
use crate::model::bounds::{MAXVAL, MINVAL};

/// Slack of the separation tests against rounding, in units of the summed half-sizes.
const SEPARATION_SLACK: f64 = 1e-13;
/// Squared sine below which two edges count as parallel.
const PARALLEL: f64 = 1e-16;
/// Component of the axis below which the supporting corner is ambiguous.
const AMBIGUOUS: f64 = 1e-9;
/// Squared distance of equal vertices, relative to the reference face.
const DUPLICATE: f64 = 1e-14;
/// What an edge axis must win by over a face axis.
const EDGE_BIAS: f64 = 1e-6;
/// Cosine above which an edge axis repeats a face axis.
const ALIGNED: f64 = 0.99;
/// Part of the face depth that the face may lose against an aligned edge axis.
const FACE_PREFERENCE: f64 = 0.05;
/// Vertices a clipped quadrilateral may have.
const MAX_VERTICES: usize = 12;

/// Two boxes seen from the first.
struct Boxes {
    size1: Vec3,
    size2: Vec3,
    /// Axes of the second box as columns, in the frame of the first.
    rot: Mat3,
    /// Centre of the second box in the frame of the first.
    pos21: Vec3,
    /// Centre of the first box in the frame of the second.
    pos12: Vec3,
    /// Separation above which there is no contact.
    reach: f64,
}

/// Direction of least penetration.
#[derive(Clone, Copy)]
enum Axis {
    /// Face normal of the first box.
    First(usize),
    /// Face normal of the second box.
    Second(usize),
    /// Cross product of an edge of the first and one of the second.
    Edges(usize, usize),
}

/// Two boxes: up to eight contacts.
pub fn box_box(a: &Shape, b: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let (size1, size2) = (a.size, b.size);
    let boxes = Boxes {
        size1,
        size2,
        rot: mul_mat_t_mat(&a.mat, &b.mat),
        pos21: mul_mat_t_vec(&a.mat, sub(b.pos, a.pos)),
        pos12: mul_mat_t_vec(&b.mat, sub(a.pos, b.pos)),
        reach: margin + SEPARATION_SLACK * (size1[0] + size1[1] + size1[2] + size2[0] + size2[1] + size2[2]),
    };
    match boxes.separating_axis() {
        None => {}
        Some(Axis::Edges(i, j)) => out.extend(boxes.edge_contact(i, j).map(|c| PreContact {
            pos: add(mul_mat_vec(&a.mat, c.pos), a.pos),
            normal: mul_mat_vec(&a.mat, c.normal),
            ..c
        })),
        Some(Axis::First(i)) => {
            let reference = Face { owner: a, other: size2, rot: boxes.rot, offset: boxes.pos21, axis: i };
            reference.contacts(1.0, margin, out);
        }
        Some(Axis::Second(j)) => {
            let rot = transpose(&boxes.rot);
            let reference = Face { owner: b, other: size1, rot, offset: boxes.pos12, axis: j };
            reference.contacts(-1.0, margin, out);
        }
    }
}

impl Boxes {
    /// Axis of the largest separation, none when it exceeds the reach. Faces win ties: they carry more points.
    fn separating_axis(&self) -> Option<Axis> {
        let abs = self.rot.map(f64::abs);
        let (size1, size2) = (self.size1, self.size2);
        let mut face = (-MAXVAL, Axis::First(0));
        for i in 0..3 {
            let radius2 = abs[3 * i] * size2[0] + abs[3 * i + 1] * size2[1] + abs[3 * i + 2] * size2[2];
            let sep = self.pos21[i].abs() - size1[i] - radius2;
            if sep > self.reach {
                return None;
            }
            if sep > face.0 {
                face = (sep, Axis::First(i));
            }
        }
        for j in 0..3 {
            let radius1 = abs[j] * size1[0] + abs[3 + j] * size1[1] + abs[6 + j] * size1[2];
            let sep = self.pos12[j].abs() - size2[j] - radius1;
            if sep > self.reach {
                return None;
            }
            if sep > face.0 {
                face = (sep, Axis::Second(j));
            }
        }
        let mut best = face;
        for i in 0..3 {
            for j in 0..3 {
                let Some(sep) = self.edge_separation(i, j) else { continue };
                if sep > self.reach {
                    return None;
                }
                if sep - EDGE_BIAS * sep.abs() > best.0 && sep > face.0 {
                    best = (sep, Axis::Edges(i, j));
                }
            }
        }
        // The edge pair that won may stand for the best face: stacks would flip between the two.
        if let Axis::Edges(i, j) = best.1 {
            let cosine = match face.1 {
                Axis::First(f) => self.edge_axis(i, j)[f].abs(),
                Axis::Second(f) => dot(self.edge_axis(i, j), column(&self.rot, f)).abs(),
                Axis::Edges(..) => 0.0,
            };
            if cosine > ALIGNED && best.0 < face.0 + FACE_PREFERENCE * face.0.abs() + MINVAL {
                best = face;
            }
        }
        Some(best.1)
    }

    /// Separation along the cross product of two edges; none when they are parallel.
    fn edge_separation(&self, i: usize, j: usize) -> Option<f64> {
        let rot = &self.rot;
        let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
        let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
        let (a1, a2) = (-rot[3 * i2 + j], rot[3 * i1 + j]);
        let norm2 = a1 * a1 + a2 * a2;
        if norm2 < PARALLEL {
            return None;
        }
        let inv = 1.0 / norm2.sqrt();
        let (a1, a2) = (a1 * inv, a2 * inv);
        let radius1 = self.size1[i1] * a1.abs() + self.size1[i2] * a2.abs();
        let b1 = a1 * rot[3 * i1 + j1] + a2 * rot[3 * i2 + j1];
        let b2 = a1 * rot[3 * i1 + j2] + a2 * rot[3 * i2 + j2];
        let radius2 = self.size2[j1] * b1.abs() + self.size2[j2] * b2.abs();
        Some((a1 * self.pos21[i1] + a2 * self.pos21[i2]).abs() - radius1 - radius2)
    }

    /// Unit cross product of edge `i` of the first box and edge `j` of the second.
    fn edge_axis(&self, i: usize, j: usize) -> Vec3 {
        let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
        let mut axis = [0.0; 3];
        axis[i1] = -self.rot[3 * i2 + j];
        axis[i2] = self.rot[3 * i1 + j];
        normalize(axis).0
    }

    /// Midpoint of the nearest points of the two supporting edges, in the frame of the first box.
    fn edge_contact(&self, i: usize, j: usize) -> Option<PreContact> {
        let mut axis = self.edge_axis(i, j);
        if dot(axis, self.pos21) < 0.0 {
            axis = [-axis[0], -axis[1], -axis[2]];
        }
        let axis2 = mul_mat_t_vec(&self.rot, axis);
        let corners1 = supporting_edges(axis, self.size1, i);
        let corners2 = supporting_edges(axis2.map(|x| -x), self.size2, j);

        let mut nearest = MAXVAL;
        let mut witness = ([0.0; 3], [0.0; 3]);
        for &c1 in corners1.iter().flatten() {
            for &c2 in corners2.iter().flatten() {
                let c2 = add(mul_mat_vec(&self.rot, c2), self.pos21);
                let (p1, p2) = self.nearest_on_edges(i, j, c1, c2);
                let gap = sub(p2, p1);
                if dot(gap, gap) < nearest {
                    nearest = dot(gap, gap);
                    witness = (p1, p2);
                }
            }
        }
        let (p1, p2) = witness;
        let dist = dot(sub(p2, p1), axis);
        let pos = std::array::from_fn(|k| 0.5 * (p1[k] + p2[k]));
        (dist <= self.reach).then_some(PreContact { dist, pos, normal: axis, tangent: [0.0; 3] })
    }

    /// Nearest points of the edges with midpoints `c1` and `c2`.
    fn nearest_on_edges(&self, i: usize, j: usize, c1: Vec3, c2: Vec3) -> (Vec3, Vec3) {
        let d2 = column(&self.rot, j);
        let cosine = d2[i];
        let sine2 = 1.0 - cosine * cosine;
        let e = sub(c2, c1);
        let (d1e, d2e) = (e[i], dot(d2, e));
        let s = if sine2 < MINVAL { 0.0 } else { (d1e - cosine * d2e) / sine2 };
        let s = clip(s, self.size1[i]);
        let t = clip(cosine * s - d2e, self.size2[j]);
        let s = clip(d1e + cosine * t, self.size1[i]);
        let mut p1 = c1;
        p1[i] += s;
        (p1, add_scaled(c2, d2, t))
    }
}

/// Midpoints of the edges of a box along `edge` that are farthest along `axis`: two when the axis does not tell.
fn supporting_edges(axis: Vec3, size: Vec3, edge: usize) -> [Option<Vec3>; 2] {
    let (k1, k2) = ((edge + 1) % 3, (edge + 2) % 3);
    let mut middle = [0.0; 3];
    for k in [k1, k2] {
        middle[k] = if axis[k] >= 0.0 { size[k] } else { -size[k] };
    }
    let ambiguous = [k1, k2].into_iter().find(|&k| axis[k].abs() < AMBIGUOUS);
    let other = ambiguous.map(|k| {
        let mut other = middle;
        other[k] = -other[k];
        other
    });
    [Some(middle), other]
}

/// The reference face: the one whose normal separates the boxes.
struct Face<'a> {
    owner: &'a Shape<'a>,
    /// Half-sizes of the other box.
    other: Vec3,
    /// Axes of the other box as columns, in the frame of the owner.
    rot: Mat3,
    /// Centre of the other box in the frame of the owner.
    offset: Vec3,
    /// Axis of the normal.
    axis: usize,
}

type Polygon = ([Vec3; MAX_VERTICES], usize);

impl Face<'_> {
    /// Vertices of the other box's facing side, clipped to this face. `order` is 1 when the owner is the first geom.
    fn contacts(&self, order: f64, margin: f64, out: &mut Vec<PreContact>) {
        let a = self.axis;
        let (ax, ay) = ((a + 1) % 3, (a + 2) % 3);
        let size = self.owner.size;
        let sign = if self.offset[a] >= 0.0 { 1.0 } else { -1.0 };

        let mut polygon = self.incident_face(sign);
        for (coordinate, limit) in [(0, size[ax]), (1, size[ay])] {
            for side in [1.0, -1.0] {
                polygon = clip_polygon(polygon, coordinate, side, limit);
            }
        }
        let normal = scale(column(&self.owner.mat, a), order * sign);
        let near = DUPLICATE * (size[ax] * size[ax] + size[ay] * size[ay]);
        let (vertices, n) = polygon;
        let mut accepted = ([[0.0; 3]; MAX_VERTICES], 0);
        for v in &vertices[..n] {
            let repeated = accepted.0[..accepted.1].iter().any(|q: &Vec3| {
                let (dx, dy) = (q[0] - v[0], q[1] - v[1]);
                dx * dx + dy * dy < near
            });
            if v[2] > margin || repeated {
                continue;
            }
            accepted.0[accepted.1] = *v;
            accepted.1 += 1;
            let mut local = [0.0; 3];
            local[ax] = v[0];
            local[ay] = v[1];
            local[a] = sign * (size[a] + 0.5 * v[2]);
            out.push(PreContact {
                dist: v[2],
                pos: add(mul_mat_vec(&self.owner.mat, local), self.owner.pos),
                normal,
                tangent: [0.0; 3],
            });
        }
    }

    /// Corners of the other box's face most opposed to this one: in-plane coordinates and height above this face.
    fn incident_face(&self, sign: f64) -> Polygon {
        let a = self.axis;
        let rot = &self.rot;
        let opposed = |k: usize| rot[3 * a + k].abs();
        let mut b = 0;
        for k in 1..3 {
            if opposed(k) > opposed(b) {
                b = k;
            }
        }
        let side = if sign * rot[3 * a + b] > 0.0 { -1.0 } else { 1.0 };
        let (bu, bv) = ((b + 1) % 3, (b + 2) % 3);

        let rows = [(a + 1) % 3, (a + 2) % 3, a];
        let mut centre = rows.map(|c| self.offset[c] + side * self.other[b] * rot[3 * c + b]);
        let mut du = rows.map(|c| self.other[bu] * rot[3 * c + bu]);
        let mut dv = rows.map(|c| self.other[bv] * rot[3 * c + bv]);
        centre[2] = sign * centre[2] - self.owner.size[a];
        du[2] *= sign;
        dv[2] *= sign;

        let mut vertices = [[0.0; 3]; MAX_VERTICES];
        for (v, (su, sv)) in vertices.iter_mut().zip([(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]) {
            *v = std::array::from_fn(|r| centre[r] + su * du[r] + sv * dv[r]);
        }
        (vertices, 4)
    }
}

/// The part of a polygon where `side * coordinate <= limit`.
fn clip_polygon(polygon: Polygon, coordinate: usize, side: f64, limit: f64) -> Polygon {
    let (vertices, n) = polygon;
    let mut beyond = [0.0; MAX_VERTICES];
    for k in 0..n {
        beyond[k] = side * vertices[k][coordinate] - limit;
    }
    if beyond[..n].iter().all(|&d| d <= 0.0) {
        return polygon;
    }
    let mut clipped = ([[0.0; 3]; MAX_VERTICES], 0);
    let mut emit = |v: Vec3| {
        if clipped.1 < MAX_VERTICES {
            clipped.0[clipped.1] = v;
            clipped.1 += 1;
        }
    };
    for k in 0..n {
        let next = if k + 1 == n { 0 } else { k + 1 };
        let (p, q) = (vertices[k], vertices[next]);
        let (dp, dq) = (beyond[k], beyond[next]);
        if dp <= 0.0 {
            emit(p);
        }
        if (dp < 0.0 && dq > 0.0) || (dp > 0.0 && dq < 0.0) {
            let t = dp / (dp - dq);
            emit(std::array::from_fn(|i| p[i] + t * (q[i] - p[i])));
        }
    }
    clipped
}
