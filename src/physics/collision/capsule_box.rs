//! Contacts of a capsule and a box: the ball at the capsule's point nearest to the box and, when the capsule lies
//! along a face or an edge, a second ball where it leaves the box.
//!
//! The capsule's segment is seen from the frame of the box. If the nearest point of the box is inside a face, the nearest
//! point of the segment is one of its ends, unless the segment is parallel to the face, where an end is as near. Otherwise
//! the nearest point is on one of the twelve edges, and the distance of two segments has a closed form (Ericson, Real-Time
//! Collision Detection, 2005, section 5.1.9).
//!
//! From that first ball the second one slides along the segment, in the direction in which the segment stays over the box,
//! until the segment ends or leaves the box (`Slide`).

use super::shape::{PreContact, Shape};
use super::sphere::ball_box;
use crate::math::{Vec3, add, add_scaled, dot, mul_mat_t_vec, mul_mat_vec, scale, sub};
use crate::model::bounds::MINVAL;

/// The capsule's segment in the frame of the box; points are `centre + x half` with x in \[-1, 1\].
struct Segment {
    centre: Vec3,
    axis: Vec3,
    half: Vec3,
    half_length: f64,
}

/// The part of the box nearest to the segment.
#[derive(Clone, Copy)]
enum Feature {
    /// The face with its normal along this axis.
    Face(usize),
    /// The inside of the box.
    Inside,
    /// A corner, by its side of the box along each axis.
    Corner(Vec3),
    /// The inside of an edge, at `along` in \[-1, 1\].
    Edge { edge: Edge, along: f64 },
}

/// A point of the segment and the part of the box it is nearest to.
#[derive(Clone, Copy)]
struct Nearest {
    /// Place of the point on the segment.
    at: f64,
    feature: Feature,
}

/// An edge along an axis of the box. Along the other two axes it is on this `side` of the box, 1 or -1.
#[derive(Clone, Copy)]
struct Edge {
    axis: usize,
    side: Vec3,
}

/// The edges of a box. Of equally near ones the first counts.
const EDGES: [Edge; 12] = [
    Edge { axis: 0, side: [0.0, -1.0, -1.0] },
    Edge { axis: 0, side: [0.0, 1.0, -1.0] },
    Edge { axis: 0, side: [0.0, -1.0, 1.0] },
    Edge { axis: 0, side: [0.0, 1.0, 1.0] },
    Edge { axis: 1, side: [-1.0, 0.0, -1.0] },
    Edge { axis: 1, side: [1.0, 0.0, -1.0] },
    Edge { axis: 1, side: [-1.0, 0.0, 1.0] },
    Edge { axis: 1, side: [1.0, 0.0, 1.0] },
    Edge { axis: 2, side: [-1.0, -1.0, 0.0] },
    Edge { axis: 2, side: [1.0, -1.0, 0.0] },
    Edge { axis: 2, side: [-1.0, 1.0, 0.0] },
    Edge { axis: 2, side: [1.0, 1.0, 0.0] },
];

/// Capsule and box.
pub fn capsule_box(capsule: &Shape, cuboid: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let [radius, half_length, _] = capsule.size;
    let axis = mul_mat_t_vec(&cuboid.mat, capsule.axis());
    let segment = Segment {
        centre: mul_mat_t_vec(&cuboid.mat, sub(capsule.pos, cuboid.pos)),
        axis,
        half: scale(axis, half_length),
        half_length,
    };
    let size = cuboid.size;
    let limit = margin + 2.0 * (radius + half_length + size[0] + size[1] + size[2]);
    let Some(nearest) = segment.nearest(size, limit) else { return };
    let ball = |x: f64| {
        let local = segment.point(x);
        ball_box(add(mul_mat_vec(&cuboid.mat, local), cuboid.pos), radius, cuboid, margin)
    };
    out.extend(ball(nearest.at));
    let slide = match nearest.feature {
        Feature::Inside => None,
        Feature::Face(normal) => Some(segment.slide_over_face(size, nearest.at, normal)),
        Feature::Corner(corner) => segment.slide_from_corner(size, nearest.at, corner),
        Feature::Edge { edge, along } => segment.slide_from_edge(size, nearest.at, edge, along),
    };
    out.extend(slide.and_then(|slide| ball(slide.step() + nearest.at)));
}

/// The shortest way from the segment to an edge.
struct Gap {
    distance2: f64,
    along_edge: Limited,
    along_segment: f64,
}

impl Gap {
    fn nearest(&self, edge: &Edge) -> Nearest {
        let feature = match self.along_edge.beyond {
            None => Feature::Edge { edge: *edge, along: self.along_edge.value },
            Some(end) => {
                let mut corner = edge.side;
                corner[edge.axis] = end;
                Feature::Corner(corner)
            }
        };
        Nearest { at: self.along_segment, feature }
    }
}

impl Segment {
    fn point(&self, x: f64) -> Vec3 {
        add_scaled(self.centre, self.half, x)
    }

    /// The nearest point of the segment; `None` for squared distances above `limit`.
    fn nearest(&self, size: Vec3, limit: f64) -> Option<Nearest> {
        let (mut least, mut nearest) = (limit, None);
        for end in [-1.0, 1.0] {
            if let Some((distance2, feature)) = self.end_over_face(size, end)
                && distance2 < least
            {
                (least, nearest) = (distance2, Some(Nearest { at: end, feature }));
            }
        }
        for edge in &EDGES {
            // Nearer by more than rounding, so that a segment parallel to a face does not flip between equal edges.
            if let Some(gap) = self.gap_to_edge(size, edge)
                && gap.distance2 < least - MINVAL
            {
                (least, nearest) = (gap.distance2, Some(gap.nearest(edge)));
            }
        }
        nearest
    }

    /// Squared distance and feature of an end of the segment that is inside the box, or outside of one pair of faces only.
    fn end_over_face(&self, size: Vec3, end: f64) -> Option<(f64, Feature)> {
        let point = self.point(end);
        let beyond = |k: usize| point[k].abs() > size[k];
        let nearest: Vec3 =
            std::array::from_fn(|k| if beyond(k) { size[k].copysign(point[k]) } else { point[k] });
        let mut outside = (0..3).filter(|&k| beyond(k));
        let feature = match (outside.next(), outside.next()) {
            (None, _) => Feature::Inside,
            (Some(axis), None) => Feature::Face(axis),
            _ => return None,
        };
        let gap = sub(nearest, point);
        Some((dot(gap, gap), feature))
    }

    /// The points of the segment and an edge that are nearest to each other; `None` for parallel lines.
    ///
    /// With the edge at `middle + x e` and the segment at `centre + y h`, both x and y in \[-1, 1\], the square of the gap is
    /// least where its derivatives vanish: `e·e x - e·h y = -e·d` and `h·h y - e·h x = h·d`, with `d = middle - centre`. Where x
    /// or y then leaves its range it is put on the limit, and the other one follows from its own equation alone.
    fn gap_to_edge(&self, size: Vec3, edge: &Edge) -> Option<Gap> {
        let Edge { axis, side } = *edge;
        let middle: Vec3 = std::array::from_fn(|k| side[k] * size[k]);
        let span = sub(middle, self.centre);
        let reach = size[axis];
        // The products with one factor `e` carry the minus signs of the equations.
        let (ee, eh, hh) = (reach * reach, -reach * self.half[axis], self.half_length * self.half_length);
        let (ed, hd) = (-reach * span[axis], dot(self.half, span));
        let determinant = ee * hh - eh * eh;
        if determinant.abs() < MINVAL {
            return None;
        }
        let inverse = 1.0 / determinant;
        let mut x = Limited::new((hh * ed - eh * hd) * inverse);
        let y = match x.beyond {
            None => (ee * hd - eh * ed) * inverse,
            Some(_) => (hd - x.value * eh) * (1.0 / hh),
        };
        let y = Limited::new(y);
        if y.beyond.is_some() {
            let again = Limited::new((ed - y.value * eh) * (1.0 / ee));
            // Once the edge has been left its end stays the nearest feature.
            x = Limited { beyond: again.beyond.or(x.beyond), ..again };
        }
        let mut gap = add_scaled(span, self.half, -y.value);
        gap[axis] += reach * x.value;
        Some(Gap { distance2: dot(gap, gap), along_edge: x, along_segment: y.value })
    }

    /// True when the segment, followed forward, ascends along an axis.
    fn ascends(&self, axis: usize) -> bool {
        self.half[axis] > 0.0
    }

    /// Which axes lead from a corner into the box when the segment is followed forward.
    fn leads_inward(&self, corner: Vec3) -> [bool; 3] {
        std::array::from_fn(|k| self.ascends(k) != (corner[k] > 0.0))
    }

    /// How far the segment is followed while it crosses the whole box along an axis.
    fn crossing(&self, size: Vec3, axis: usize) -> f64 {
        2.0 * size[axis] / self.half[axis].abs()
    }

    /// From a corner: along an edge of the box or across a face. A segment that leads inward along all three axes or none has
    /// no second point near the box.
    fn slide_from_corner(&self, size: Vec3, at: f64, corner: Vec3) -> Option<Slide> {
        let inward = self.leads_inward(corner);
        let only = |wanted: bool| (0..3).find(|&k| inward[k] == wanted);
        // The direction in which one axis alone leads inward, and that axis.
        let (forward, axis) = match inward.iter().filter(|&&leads| leads).count() {
            1 => (1.0, only(true)?),
            2 => (-1.0, only(false)?),
            _ => return None,
        };
        if self.axis[axis] * self.axis[axis] > 0.5 {
            return Some(Slide::new(forward, at).until(self.crossing(size, axis)));
        }
        let [first, second] = [1, 2].map(|k| self.crossing(size, (axis + k) % 3));
        Some(Slide::new(-forward, at).until(first).until(second))
    }

    /// From a point of an edge: over the face that the segment is more aligned with, of the two that meet there. One of both
    /// directions must lead over that face and away from the other one.
    fn slide_from_edge(&self, size: Vec3, at: f64, edge: Edge, along: f64) -> Option<Slide> {
        let inward = self.leads_inward(edge.side);
        let [first, second] = [1, 2].map(|k| (edge.axis + k) % 3);
        if inward[first] == inward[second] {
            return None;
        }
        let across = if self.axis[first].abs() > self.axis[second].abs() { first } else { second };
        let slide = Slide::new(if inward[across] { 1.0 } else { -1.0 }, at);
        let to_upper_end = self.ascends(edge.axis) == inward[across];
        let room = if to_upper_end { 1.0 - along } else { 1.0 + along };
        let to_end = size[edge.axis] * room / self.half[edge.axis].abs();
        Some(slide.until(self.crossing(size, across)).until(to_end))
    }

    /// From an end above a face: to where the segment leaves the face.
    fn slide_over_face(&self, size: Vec3, end: f64, normal: usize) -> Slide {
        let point = self.point(end);
        let slide = Slide::new(-end, end);
        let sides = (0..3).filter(|&k| k != normal).flat_map(|k| [(k, size[k]), (k, -size[k])]);
        let crossings = sides.map(|(k, side)| (side - point[k]) / self.half[k] * slide.direction);
        crossings.filter(|&crossing| crossing > 0.0).fold(slide, Slide::until)
    }
}

/// The way of the second ball along the segment.
#[derive(Clone, Copy)]
struct Slide {
    /// 1 forward, -1 backward.
    direction: f64,
    length: f64,
}

impl Slide {
    /// From a place on the segment to its end.
    fn new(direction: f64, at: f64) -> Self {
        Slide { direction, length: 1.0 - direction * at }
    }

    /// Ends the way at a limit; one that is not a number is none.
    fn until(self, limit: f64) -> Self {
        Slide { length: if limit < self.length { limit } else { self.length }, ..self }
    }

    fn step(self) -> f64 {
        self.direction * self.length
    }
}

/// A coordinate limited to \[-1, 1\].
#[derive(Clone, Copy)]
struct Limited {
    value: f64,
    /// The limit that it was beyond, 1 or -1.
    beyond: Option<f64>,
}

impl Limited {
    fn new(x: f64) -> Self {
        if x.abs() > 1.0 {
            let limit = 1.0_f64.copysign(x);
            Limited { value: limit, beyond: Some(limit) }
        } else {
            Limited { value: x, beyond: None }
        }
    }
}
