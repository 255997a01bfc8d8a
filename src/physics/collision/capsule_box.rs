//! Contacts of a capsule and a box: the ball at the capsule's point nearest to the box and, when the capsule lies
//! along a face or an edge, a second ball where it leaves the box.

use super::shape::{PreContact, Shape};
use super::sphere::ball_box;
use crate::math::{Vec3, add, add_scaled, dot, mul_mat_t_vec, mul_mat_vec, scale, sub};
use crate::model::bounds::MINVAL;

/// The capsule's segment in the frame of the box; points are `centre + x half` with x in [-1, 1].
struct Segment {
    centre: Vec3,
    axis: Vec3,
    half: Vec3,
    half_length: f64,
}

/// The part of the box nearest to the segment.
enum Feature {
    /// An end of the segment above a face (the axis of its normal), or inside the box.
    Face { end: f64, face: Option<usize> },
    /// A corner: one bit an axis, set on the positive side.
    Corner { corner: usize },
    /// The inside of an edge along `edge`, at `along` in [-1, 1], with the bits of its lower corner.
    Edge { corner: usize, edge: usize, along: f64 },
}

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
    let Some((at, feature)) = nearest_feature(&segment, size, limit) else { return };
    let ball = |x: f64| {
        let local = add_scaled(segment.centre, segment.half, x);
        ball_box(add(mul_mat_vec(&cuboid.mat, local), cuboid.pos), radius, cuboid, margin)
    };
    out.extend(ball(at));
    let second = match feature {
        Feature::Face { end, face } => face.map(|face| beyond_face(&segment, size, end, face)),
        Feature::Corner { corner } => beyond_corner(&segment, size, at, corner),
        Feature::Edge { corner, edge, along } => beyond_edge(&segment, size, at, corner, edge, along),
    };
    out.extend(second.and_then(|step| ball(step + at)));
}

/// Position on the segment nearest to the box and the feature it is nearest to; squared distances below `limit`.
fn nearest_feature(s: &Segment, size: Vec3, limit: f64) -> Option<(f64, Feature)> {
    let mut best = limit;
    let mut found = None;
    for end in [-1.0, 1.0] {
        let point = add_scaled(s.centre, s.half, end);
        let mut nearest = point;
        let mut outside = 0;
        let mut face = None;
        for j in 0..3 {
            if point[j].abs() > size[j] {
                outside += 1;
                face = Some(j);
                nearest[j] = size[j].copysign(point[j]);
            }
        }
        let gap = sub(nearest, point);
        let distance2 = dot(gap, gap);
        if outside <= 1 && distance2 < best {
            best = distance2;
            found = Some((end, Feature::Face { end, face }));
        }
    }
    for edge in 0..3 {
        for corner in (0..8).filter(|c| c & (1 << edge) == 0) {
            let Some(near) = segment_edge(s, size, corner, edge) else { continue };
            // Nearer by more than rounding, so that a segment parallel to a face does not flip between equal edges.
            if near.distance2 < best - MINVAL {
                best = near.distance2;
                let feature = match near.end {
                    0 => Feature::Edge { corner, edge, along: near.along_edge },
                    side => Feature::Corner { corner: if side > 0 { corner | 1 << edge } else { corner } },
                };
                found = Some((near.along_segment, feature));
            }
        }
    }
    found
}

/// Nearest points of the segment and an edge.
struct EdgeDistance {
    distance2: f64,
    along_segment: f64,
    along_edge: f64,
    /// -1 and 1 at the ends of the edge, 0 between.
    end: i32,
}

/// `x` limited to [-1, 1], and the side on which it was beyond.
fn on_span(x: f64) -> (f64, i32) {
    if x > 1.0 {
        (1.0, 1)
    } else if x < -1.0 {
        (-1.0, -1)
    } else {
        (x, 0)
    }
}

/// Minimises the squared span between `middle + x half_edge` and `centre + y half`, with x and y in [-1, 1]; `None`
/// for parallel lines. The free minimum solves the normal equations; where one coordinate leaves its range it is put
/// on the limit and the other solved for alone, first with the edge at fault and then with the segment.
fn segment_edge(s: &Segment, size: Vec3, corner: usize, edge: usize) -> Option<EdgeDistance> {
    let mut middle: Vec3 = std::array::from_fn(|k| if corner & (1 << k) != 0 { size[k] } else { -size[k] });
    middle[edge] = 0.0;
    let span = sub(middle, s.centre);
    let half_edge = size[edge];

    let edge_edge = half_edge * half_edge;
    let edge_segment = -half_edge * s.half[edge];
    let segment_segment = s.half_length * s.half_length;
    let edge_span = -half_edge * span[edge];
    let segment_span = dot(s.half, span);
    let determinant = edge_edge * segment_segment - edge_segment * edge_segment;
    if determinant.abs() < MINVAL {
        return None;
    }
    let inverse = 1.0 / determinant;
    let (mut x, mut end) = on_span((segment_segment * edge_span - edge_segment * segment_span) * inverse);
    let mut y = if end == 0 {
        (edge_edge * segment_span - edge_segment * edge_span) * inverse
    } else {
        (segment_span - x * edge_segment) * (1.0 / segment_segment)
    };
    if y.abs() > 1.0 {
        y = 1.0f64.copysign(y);
        let (best, side) = on_span((edge_span - y * edge_segment) * (1.0 / edge_edge));
        // The side of an earlier limit stays when this one is within.
        (x, end) = (best, if side != 0 { side } else { end });
    }
    let mut gap = add_scaled(span, s.half, -y);
    gap[edge] += half_edge * x;
    Some(EdgeDistance { distance2: dot(gap, gap), along_segment: y, along_edge: x, end })
}

/// Bits of the axes along which the segment ascends.
fn ascent(s: &Segment) -> usize {
    (0..3).filter(|&k| s.half[k] > 0.0).map(|k| 1 << k).sum()
}

/// Step from a corner along the segment, when it runs along an edge or across a face.
fn beyond_corner(s: &Segment, size: Vec3, at: f64, corner: usize) -> Option<f64> {
    let (relation, sign) = match ascent(s) ^ corner {
        0 | 7 => return None,
        r @ (1 | 2 | 4) => (r, 1.0),
        r => (7 - r, -1.0),
    };
    let axis = relation.trailing_zeros() as usize;
    let extent = |k: usize| 2.0 * size[k] / s.half[k].abs();
    if s.axis[axis] * s.axis[axis] > 0.5 {
        let step = 1.0 - sign * at;
        Some(sign * at_most(step, extent(axis)))
    } else {
        let step = 1.0 + sign * at;
        let (k1, k2) = ((axis + 1) % 3, (axis + 2) % 3);
        Some(-sign * at_most(at_most(step, extent(k1)), extent(k2)))
    }
}

/// Step from a point of an edge to where the segment leaves the face it is more aligned with.
fn beyond_edge(s: &Segment, size: Vec3, at: f64, corner: usize, edge: usize, along: f64) -> Option<f64> {
    let ascent = ascent(s);
    let relation = (ascent ^ corner) & (7 - (1 << edge));
    if !matches!(relation, 1 | 2 | 4) {
        return None;
    }
    let (k1, k2) = ((edge + 1) % 3, (edge + 2) % 3);
    let across = if s.axis[k1].abs() > s.axis[k2].abs() { k1 } else { k2 };
    let forward = relation & (1 << across) != 0;
    let sign = if forward { 1.0 } else { -1.0 };

    let step = at_most(1.0 - sign * at, 2.0 * size[across] / s.half[across].abs());
    let upward = (ascent & (1 << edge) != 0) == forward;
    let room = if upward { 1.0 - along } else { 1.0 + along };
    Some(sign * at_most(step, size[edge] * room / s.half[edge].abs()))
}

/// Step from the end above a face to where the segment leaves it.
fn beyond_face(s: &Segment, size: Vec3, end: f64, face: usize) -> f64 {
    let sign = -end;
    let point = add_scaled(s.centre, s.half, end);
    let mut step = 2.0;
    for k in (0..3).filter(|&k| k != face) {
        for side in [size[k], -size[k]] {
            let crossing = (side - point[k]) / s.half[k] * sign;
            if crossing > 0.0 {
                step = at_most(step, crossing);
            }
        }
    }
    step * sign
}

/// The smaller; `x` when the limit is not a number.
fn at_most(x: f64, limit: f64) -> f64 {
    if limit < x { limit } else { x }
}
