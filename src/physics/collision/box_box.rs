//! Contacts of two boxes: the separating axis theorem finds the direction of least penetration (Gottschalk, Lin,
//! Manocha 1996), then either one edge pair touches or one face is clipped against another (Sutherland, Hodgman
//! 1974).
//!
//! Everything is computed in the frame of the first box, or of the box that owns the reference face.

use super::shape::{PreContact, Shape};
use super::sphere::clip;
use crate::math::{Mat3, Vec3, add, add_scaled, column, dot, mul_mat_t_mat, mul_mat_t_vec, mul_mat_vec};
use crate::math::{row, scale, sub, transpose};
use crate::model::bounds::{MAXVAL, MINVAL};

/// Slack of the separation tests against rounding, in units of the summed half-sizes.
const SEPARATION_SLACK: f64 = 1e-13;
/// Squared sine below which two edges count as parallel.
const PARALLEL: f64 = 1e-16;
/// Component of the axis below which the supporting edge is ambiguous.
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

/// Two boxes: up to eight contacts.
pub fn box_box(a: &Shape, b: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let axes = mul_mat_t_mat(&a.mat, &b.mat);
    let seen_from_b = View {
        own: b.size,
        other: a.size,
        axes: transpose(&axes),
        offset: mul_mat_t_vec(&b.mat, sub(a.pos, b.pos)),
    };
    let seen_from_a =
        View { own: a.size, other: b.size, axes, offset: mul_mat_t_vec(&a.mat, sub(b.pos, a.pos)) };
    let extent = a.size[0] + a.size[1] + a.size[2] + b.size[0] + b.size[1] + b.size[2];
    let boxes = Boxes { views: [seen_from_a, seen_from_b], reach: margin + SEPARATION_SLACK * extent };
    match boxes.least_penetration() {
        None => {}
        Some(Axis::Face { owner, axis }) => {
            let owners = [a, b];
            let outward = boxes.views[owner].side(axis);
            let face = ReferenceFace { view: &boxes.views[owner], shape: owners[owner], axis, outward };
            // The normal leads from the first box to the second.
            let order = if owner == 0 { 1.0 } else { -1.0 };
            face.contacts(scale(column(&owners[owner].mat, axis), order * outward), margin, out);
        }
        Some(Axis::Edges(pair)) => out.extend(boxes.edge_contact(pair).map(|c| PreContact {
            pos: add(mul_mat_vec(&a.mat, c.pos), a.pos),
            normal: mul_mat_vec(&a.mat, c.normal),
            ..c
        })),
    }
}

/// One box as another sees it: vectors are in the frame of the observer.
struct View {
    /// Half-sizes of the observer.
    own: Vec3,
    /// Half-sizes of the box seen.
    other: Vec3,
    /// Axes of the box seen, as columns.
    axes: Mat3,
    /// Centre of the box seen.
    offset: Vec3,
}

impl View {
    /// The gap along a face normal of the observer: distance of the centres less the half-widths of the boxes.
    fn gap(&self, axis: usize) -> f64 {
        self.offset[axis].abs() - self.own[axis] - dot(row(&self.axes, axis).map(f64::abs), self.other)
    }

    /// The side of an axis, 1 or -1, on which the other box lies.
    fn side(&self, axis: usize) -> f64 {
        if self.offset[axis] >= 0.0 { 1.0 } else { -1.0 }
    }
}

/// Direction in which two boxes are compared.
#[derive(Clone, Copy)]
enum Axis {
    /// Normal of a face of box `owner`.
    Face { owner: usize, axis: usize },
    /// Common normal of two edges.
    Edges(EdgePair),
}

/// An edge of the first box and one of the second, by the axes along which they lie.
#[derive(Clone, Copy)]
struct EdgePair {
    first: usize,
    second: usize,
}

/// Both boxes.
struct Boxes {
    /// The second as the first sees it, and the first as the second does.
    views: [View; 2],
    /// Gap above which there is no contact.
    reach: f64,
}

/// The boxes are apart.
struct Apart;

/// The two axes after `axis`, in cyclic order: a plane normal to it.
fn plane_across(axis: usize) -> [usize; 2] {
    [(axis + 1) % 3, (axis + 2) % 3]
}

fn dot2(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl Boxes {
    /// Axis of the largest gap; `None` when one of them exceeds the reach.
    fn least_penetration(&self) -> Option<Axis> {
        let (face, face_gap) = self.widest_face_gap().ok()?;
        let Some((edges, edge_gap)) = self.widest_edge_gap(face_gap).ok()? else { return Some(face) };
        // An edge pair along the best face stands for that face: stacks would flip between the two.
        let nearly_as_wide = edge_gap < face_gap + FACE_PREFERENCE * face_gap.abs() + MINVAL;
        let repeats_face = nearly_as_wide && self.cosine(face, self.edge_axis(edges)).abs() > ALIGNED;
        Some(if repeats_face { face } else { Axis::Edges(edges) })
    }

    /// The face normal of the largest gap. Earlier ones win ties.
    fn widest_face_gap(&self) -> Result<(Axis, f64), Apart> {
        let mut widest = (Axis::Face { owner: 0, axis: 0 }, -MAXVAL);
        for (owner, view) in self.views.iter().enumerate() {
            for axis in 0..3 {
                let gap = self.within_reach(view.gap(axis))?;
                if gap > widest.1 {
                    widest = (Axis::Face { owner, axis }, gap);
                }
            }
        }
        Ok(widest)
    }

    /// The pair of edges of the largest gap among those that beat the faces. Faces win ties: they carry more points.
    fn widest_edge_gap(&self, face_gap: f64) -> Result<Option<(EdgePair, f64)>, Apart> {
        let (mut widest, mut to_beat) = (None, face_gap);
        for first in 0..3 {
            for second in 0..3 {
                let pair = EdgePair { first, second };
                let Some(normal) = self.edge_normal(pair) else { continue };
                let gap = self.within_reach(self.edge_gap(pair, normal))?;
                if gap - EDGE_BIAS * gap.abs() > to_beat && gap > face_gap {
                    widest = Some((pair, gap));
                    to_beat = gap;
                }
            }
        }
        Ok(widest)
    }

    fn within_reach(&self, gap: f64) -> Result<f64, Apart> {
        if gap > self.reach { Err(Apart) } else { Ok(gap) }
    }

    /// The common normal of two edges, as a unit vector of the plane across the first: looking along the first, the
    /// second is a line, and this its normal. `None` for parallel edges, whose normal is noise; the faces stand for
    /// those.
    fn edge_normal(&self, pair: EdgePair) -> Option<[f64; 2]> {
        let [u, v] = plane_across(pair.first).map(|k| self.views[0].axes[3 * k + pair.second]);
        let quarter_turn = [-v, u];
        let length2 = dot2(quarter_turn, quarter_turn);
        (length2 >= PARALLEL).then(|| {
            let inverse = 1.0 / length2.sqrt();
            quarter_turn.map(|x| x * inverse)
        })
    }

    /// The gap along the normal of two edges. Seen along its own edge, each box is a rectangle.
    fn edge_gap(&self, pair: EdgePair, normal: [f64; 2]) -> f64 {
        let View { own, other, axes, offset } = &self.views[0];
        let (plane, other_plane) = (plane_across(pair.first), plane_across(pair.second));
        let turned = other_plane.map(|k| dot2(normal, plane.map(|p| axes[3 * p + k])));
        let half_width = dot2(plane.map(|p| own[p]), normal.map(f64::abs));
        let other_half_width = dot2(other_plane.map(|k| other[k]), turned.map(f64::abs));
        dot2(normal, plane.map(|p| offset[p])).abs() - half_width - other_half_width
    }

    /// The normal of two edges in the frame of the first box; zero for parallel ones.
    fn edge_axis(&self, pair: EdgePair) -> Vec3 {
        let mut axis = [0.0; 3];
        for (k, x) in plane_across(pair.first).into_iter().zip(self.edge_normal(pair).unwrap_or_default()) {
            axis[k] = x;
        }
        axis
    }

    /// Cosine of the angle between a face normal and a direction in the frame of the first box.
    fn cosine(&self, face: Axis, direction: Vec3) -> f64 {
        match face {
            Axis::Face { owner: 0, axis } => direction[axis],
            Axis::Face { axis, .. } => dot(direction, column(&self.views[0].axes, axis)),
            Axis::Edges(..) => 0.0,
        }
    }

    /// Midpoint between the nearest points of the two supporting edges, in the frame of the first box.
    fn edge_contact(&self, pair: EdgePair) -> Option<PreContact> {
        let View { own, other, axes, offset } = &self.views[0];
        let mut normal = self.edge_axis(pair);
        if dot(normal, *offset) < 0.0 {
            normal = normal.map(|x| -x);
        }
        let first = supporting_edges(normal, *own, pair.first);
        let against = mul_mat_t_vec(axes, normal).map(|x| -x);
        let second =
            supporting_edges(against, *other, pair.second).map(|edge| edge.map(|e| e.placed(axes, *offset)));

        let mut witness = [[0.0; 3]; 2];
        let mut nearest = MAXVAL;
        for e1 in first.iter().flatten() {
            for e2 in second.iter().flatten() {
                let points = e1.nearest_points(e2);
                let gap = sub(points[1], points[0]);
                if dot(gap, gap) < nearest {
                    (nearest, witness) = (dot(gap, gap), points);
                }
            }
        }
        let [p1, p2] = witness;
        let dist = dot(sub(p2, p1), normal);
        let pos = scale(add(p1, p2), 0.5);
        (dist <= self.reach).then_some(PreContact { dist, pos, normal, tangent: [0.0; 3] })
    }
}

/// An edge of a box.
struct Edge {
    middle: Vec3,
    /// Unit vector.
    direction: Vec3,
    half_length: f64,
}

impl Edge {
    /// The edge in the frame in which its box has these axes and this centre.
    fn placed(&self, axes: &Mat3, centre: Vec3) -> Edge {
        Edge {
            middle: add(mul_mat_vec(axes, self.middle), centre),
            direction: mul_mat_vec(axes, self.direction),
            half_length: self.half_length,
        }
    }

    /// A point of each edge, nearest to each other. The two lines are nearest where the span between them is normal to
    /// both; where that lies beyond the end of an edge, the other edge is asked for the point nearest to that end.
    fn nearest_points(&self, other: &Edge) -> [Vec3; 2] {
        let between = sub(other.middle, self.middle);
        let (along, along_other) = (dot(self.direction, between), dot(other.direction, between));
        let cosine = dot(self.direction, other.direction);
        let sine2 = 1.0 - cosine * cosine;
        let on_line = if sine2 < MINVAL { 0.0 } else { (along - cosine * along_other) / sine2 };
        let start = clip(on_line, self.half_length);
        let t = clip(cosine * start - along_other, other.half_length);
        let s = clip(along + cosine * t, self.half_length);
        [add_scaled(self.middle, self.direction, s), add_scaled(other.middle, other.direction, t)]
    }
}

/// Edges of a box along `axis` that are farthest in a direction normal to it: two when one component of that direction
/// is too small to tell its sign, because then rounding could choose the wrong side of the box.
fn supporting_edges(toward: Vec3, size: Vec3, axis: usize) -> [Option<Edge>; 2] {
    let plane = plane_across(axis);
    let mut direction = [0.0; 3];
    direction[axis] = 1.0;
    let mut middle = [0.0; 3];
    for k in plane {
        middle[k] = if toward[k] >= 0.0 { size[k] } else { -size[k] };
    }
    let edge = |middle: Vec3| Edge { middle, direction, half_length: size[axis] };
    let ambiguous = plane.into_iter().find(|&k| toward[k].abs() < AMBIGUOUS);
    let opposite = ambiguous.map(|k| {
        let mut opposite = middle;
        opposite[k] = -opposite[k];
        edge(opposite)
    });
    [Some(edge(middle)), opposite]
}

/// The face whose normal is the axis of least penetration. In its coordinates the first two are in the plane of the
/// face, along the axes after its own, and the third is the height above it.
struct ReferenceFace<'a> {
    view: &'a View,
    /// The box that the face belongs to.
    shape: &'a Shape<'a>,
    axis: usize,
    /// Side of the axis on which the face is.
    outward: f64,
}

impl ReferenceFace<'_> {
    /// A contact for each corner that is left of the other box's facing side when it is clipped to this face.
    fn contacts(&self, normal: Vec3, margin: f64, out: &mut Vec<PreContact>) {
        let sides = plane_across(self.axis).map(|k| self.view.own[k]);
        let mut patch = self.opposed_face();
        for (coordinate, limit) in sides.into_iter().enumerate() {
            patch = patch.clipped(|v| v[coordinate] - limit);
            patch = patch.clipped(|v| -v[coordinate] - limit);
        }
        let same = DUPLICATE * dot2(sides, sides);
        let mut taken = Polygon::default();
        for &v in patch.vertices() {
            let near = |q: &Vec3| {
                let apart = [q[0] - v[0], q[1] - v[1]];
                dot2(apart, apart) < same
            };
            if v[2] > margin || taken.vertices().iter().any(near) {
                continue;
            }
            taken.push(v);
            out.push(PreContact { dist: v[2], pos: self.midway(v), normal, tangent: [0.0; 3] });
        }
    }

    /// The point midway between this face and `v`, in the world.
    fn midway(&self, v: Vec3) -> Vec3 {
        let mut local = [0.0; 3];
        for (k, x) in plane_across(self.axis).into_iter().zip(v) {
            local[k] = x;
        }
        local[self.axis] = self.outward * (self.view.own[self.axis] + 0.5 * v[2]);
        add(mul_mat_vec(&self.shape.mat, local), self.shape.pos)
    }

    /// The face of the other box that looks most against this one.
    fn opposed_face(&self) -> Polygon {
        let View { own, other, axes, offset } = self.view;
        let [x, y] = plane_across(self.axis);
        let facing = row(axes, self.axis);
        let steeper = |a: usize, b: usize| if facing[b].abs() > facing[a].abs() { b } else { a };
        let normal = steeper(steeper(0, 1), 2);
        let side = if self.outward * facing[normal] > 0.0 { -1.0 } else { 1.0 };

        let seen = |v: Vec3| [v[x], v[y], self.outward * v[self.axis]];
        let half_edge = |k: usize| seen(scale(column(axes, k), other[k]));
        let mut centre = seen(add_scaled(*offset, column(axes, normal), side * other[normal]));
        centre[2] -= own[self.axis];
        let [u, v] = plane_across(normal).map(half_edge);
        let mut face = Polygon::default();
        for (su, sv) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
            face.push(add_scaled(add_scaled(centre, u, su), v, sv));
        }
        face
    }
}

/// Corners in order.
#[derive(Clone, Copy, Default)]
struct Polygon {
    corners: [Vec3; MAX_VERTICES],
    count: usize,
}

impl Polygon {
    fn vertices(&self) -> &[Vec3] {
        &self.corners[..self.count]
    }

    /// Adds a corner; one more than there is room for is dropped.
    fn push(&mut self, corner: Vec3) {
        if let Some(slot) = self.corners.get_mut(self.count) {
            *slot = corner;
            self.count += 1;
        }
    }

    /// The part where a linear function of the point is not positive: corners that lie there, and the point at which
    /// each edge crosses zero.
    fn clipped(self, excess: impl Fn(&Vec3) -> f64) -> Polygon {
        let mut outside = [0.0; MAX_VERTICES];
        for (e, v) in outside.iter_mut().zip(self.vertices()) {
            *e = excess(v);
        }
        let outside = &outside[..self.count];
        if outside.iter().all(|&e| e <= 0.0) {
            return self;
        }
        let mut kept = Polygon::default();
        for (k, (&here, &from)) in self.vertices().iter().zip(outside).enumerate() {
            if from <= 0.0 {
                kept.push(here);
            }
            let next = if k + 1 == self.count { 0 } else { k + 1 };
            let to = outside[next];
            if from.min(to) < 0.0 && from.max(to) > 0.0 {
                kept.push(add_scaled(here, sub(self.corners[next], here), from / (from - to)));
            }
        }
        kept
    }
}
