//! Contacts between two capsules: of the nearest points of their segments (Ericson, "Real-Time Collision
//! Detection", 5.1.9).

use super::shape::{PreContact, Shape};
use super::sphere::{Ball, balls, clip};
use crate::math::{Vec3, add_scaled, dot, scale, sub};
use crate::model::bounds::MINVAL;

/// Two capsules: one contact, or up to two when the segments are parallel.
pub fn capsule_capsule(a: &Shape, b: &Shape, margin: f64, out: &mut Vec<PreContact>) {
    let halves = [scale(a.axis(), a.size[1]), scale(b.axis(), b.size[1])];
    let segments = Segments::new(halves, sub(a.pos, b.pos));
    let balls_at = |[x, y]: [f64; 2]| {
        let first = Ball { centre: add_scaled(a.pos, halves[0], x), radius: a.size[0], mat: &a.mat };
        let second = Ball { centre: add_scaled(b.pos, halves[1], y), radius: b.size[0], mat: &b.mat };
        balls(first, second, margin)
    };
    if let Some(nearest) = segments.nearest() {
        out.extend(balls_at(nearest));
        return;
    }
    // Parallel: the ends of the first against the second, then the reverse, until there are two.
    let before = out.len();
    for end in [1.0, -1.0] {
        out.extend(balls_at([end, clip(segments.beside(1, end), 1.0)]));
    }
    for end in [1.0, -1.0] {
        if out.len() < before + 2 {
            out.extend(balls_at([clip(segments.beside(0, end), 1.0), end]));
        }
    }
}

/// The squared distance between points of two segments, as a quadratic function of where they are: from -1 at one end
/// of a segment to 1 at the other.
struct Segments {
    /// Coefficients of the square of each parameter.
    square: [f64; 2],
    /// Coefficient of the product.
    mixed: f64,
    /// Where the gradient vanishes, `square[k] x[k] + mixed x[other] = linear[k]`.
    linear: [f64; 2],
}

impl Segments {
    /// Segments of these half-axes; `between` leads from the second centre to the first.
    fn new([first, second]: [Vec3; 2], between: Vec3) -> Self {
        Segments {
            square: [dot(first, first), dot(second, second)],
            mixed: -dot(first, second),
            linear: [-dot(first, between), dot(second, between)],
        }
    }

    /// Where the line of segment `k` is nearest to a point of the other segment.
    fn beside(&self, k: usize, other: f64) -> f64 {
        (self.linear[k] - other * self.mixed) / self.square[k]
    }

    /// The nearest points; `None` for parallel segments. A parameter beyond its range is put on the limit and the other
    /// one follows, first for the first segment, then for the second.
    fn nearest(&self) -> Option<[f64; 2]> {
        let Segments { square, mixed, linear } = self;
        let determinant = square[0] * square[1] - mixed * mixed;
        if determinant.abs() < MINVAL {
            return None;
        }
        let free = |k: usize| (square[1 - k] * linear[k] - mixed * linear[1 - k]) / determinant;
        let (mut x, mut y) = (free(0), free(1));
        if x.abs() > 1.0 {
            x = 1.0f64.copysign(x);
            y = self.beside(1, x);
        }
        if y.abs() > 1.0 {
            y = 1.0f64.copysign(y);
            x = clip(self.beside(0, y), 1.0);
        }
        Some([x, y])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{GeomType, Model};

    #[test]
    fn parallel_capsules_touch_at_both_ends_of_the_overlap() {
        let m = Model::default();
        let mat = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let upright = |pos: Vec3, half: f64| Shape {
            kind: GeomType::Capsule,
            pos,
            mat,
            size: [0.1, half, 0.0],
            geom: 0,
            m: &m,
        };
        let [first, second] = [upright([0.0; 3], 0.3), upright([0.19, 0.0, 0.4], 0.25)];
        for pair in [[&first, &second], [&second, &first]] {
            let mut found = Vec::new();
            capsule_capsule(pair[0], pair[1], 0.0, &mut found);
            let mut heights: Vec<f64> = found.iter().map(|c| c.pos[2]).collect();
            heights.sort_by(f64::total_cmp);
            assert_eq!(heights.len(), 2);
            assert!((heights[0] - 0.15).abs() < 1e-12 && (heights[1] - 0.3).abs() < 1e-12, "{heights:?}");
            assert!(found.iter().all(|c| (c.dist + 0.01).abs() < 1e-12 && (c.pos[0] - 0.095).abs() < 1e-12));
        }
    }
}
