//! The curve of a rope that hangs between two points: `y = a cosh(x / a)`.

use physics::math::{Vec3, add_scaled, distance, dot, norm, ops, scale, sub};
use physics::model::bounds::MINVAL;

/// Points along a curve at most.
pub(super) const MAX_POINTS: usize = 100;

/// How much longer than wide a curve must be to be drawn as a bead on a string.
const STEEP: f64 = 100.0;

/// A rope between two points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rope {
    /// Its ends, world frame [m].
    pub ends: [Vec3; 2],
    /// Its length [m].
    pub length: f64,
    /// Acceleration of gravity, not zero.
    pub gravity: Vec3,
}

impl Rope {
    /// Fills `points` from its front with points along the rope, `count` of them where it hangs in a curve, fewer where
    /// it is taut or nearly vertical; returns how many. `count` is 2 to [`MAX_POINTS`].
    pub fn points(&self, count: usize, points: &mut [Vec3; MAX_POINTS]) -> usize {
        let [start, end] = self.ends;
        points[0] = start;
        let inner = if distance(start, end) < self.length { self.hang(count, points) } else { 0 };
        points[inner + 1] = end;
        inner + 2
    }

    /// Fills the points between the ends; returns how many.
    fn hang(&self, count: usize, points: &mut [Vec3; MAX_POINTS]) -> usize {
        let [start, end] = self.ends;
        let up = scale(self.gravity, -1.0 / norm(self.gravity));
        let span = sub(end, start);
        let rise = dot(span, up);
        let level = add_scaled(span, up, -rise);
        let level_length = norm(level);
        let across = if level_length < MINVAL { [0.0; 3] } else { scale(level, 1.0 / level_length) };
        let width = dot(span, across);
        let at = |x: f64, y: f64| add_scaled(add_scaled(start, across, x), up, y);
        if self.length > STEEP * width {
            let drop = -0.5 * (ops::sqrt(self.length * self.length - width * width) - rise);
            points[1] = at(width * drop / (2.0 * drop - rise), drop);
            return 1;
        }
        let stretch = ops::sqrt(self.length * self.length - rise * rise) / width;
        if stretch <= 1.0 {
            return 0;
        }
        let a = width * relative_scale(stretch);
        let lowest = 0.5 * (width - a * ops::log((self.length + rise) / (self.length - rise)));
        let floor = a * cosh(lowest / a);
        // MuJoCo's points are a little closer together than the width would allow: the last stretch is longer.
        for i in 1..count - 1 {
            let x = i as f64 * width / count as f64;
            points[i] = at(x, a * cosh((x - lowest) / a) - floor);
        }
        count - 2
    }
}

fn cosh(x: f64) -> f64 {
    let e = ops::exp(x);
    0.5 * (e + 1.0 / e)
}

fn sinh(x: f64) -> f64 {
    let e = ops::exp(x);
    0.5 * (e - 1.0 / e)
}

/// Arguments below which differences of hyperbolic functions are taken from their series: nearly taut ropes.
const FLAT: f64 = 0.1;

/// `sinh(x) / x - 1`.
fn excess(x: f64) -> f64 {
    let square = x * x;
    if x < FLAT { square / 6.0 * (1.0 + square / 20.0 * (1.0 + square / 42.0)) } else { sinh(x) / x - 1.0 }
}

/// `x cosh(x) - sinh(x)`.
fn excess_slope(x: f64) -> f64 {
    let square = x * x;
    if x < FLAT {
        x * square / 3.0 * (1.0 + square / 10.0 * (1.0 + square / 28.0))
    } else {
        x * cosh(x) - sinh(x)
    }
}

/// `b = a / width` of a curve of which `stretch` is `sqrt(length² - rise²) / width`, more than 1: the two are equal to
/// `2 b sinh(1 / 2b)`. Newton's method finds the root in `1 / sqrt(2 b sinh(1 / 2b) - 1)`, which is nearly linear in b.
fn relative_scale(stretch: f64) -> f64 {
    const TOLERANCE: f64 = 1e-9;
    let wanted = 1.0 / ops::sqrt(stretch - 1.0);
    let excess = |b: f64| excess(0.5 / b);
    let residual = |b: f64| 1.0 / ops::sqrt(excess(b)) - wanted;
    let mut b = wanted / ops::sqrt(24.0);
    for _ in 0..50 {
        let here = residual(b);
        if here.abs() < TOLERANCE {
            break;
        }
        let half = 0.5 / b;
        let slope = excess_slope(half) * ops::pow(excess(b), -1.5);
        let mut step = -here / slope;
        for _ in 0..10 {
            if residual(b + step).abs() < here.abs() {
                break;
            }
            step *= 0.5;
        }
        b += step;
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRAVITY: Vec3 = [0.0, 0.0, -9.81];

    fn length(points: &[Vec3]) -> f64 {
        points.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
    }

    #[test]
    fn a_rope_is_as_long_as_it_should_be() {
        let mut points = [[0.0; 3]; MAX_POINTS];
        for (end, rope) in [([1.0, 0.0, 0.0], 1.5), ([0.3, -0.8, 0.5], 1.2), ([0.2, 0.1, -0.4], 3.0)] {
            let rope = Rope { ends: [[0.0; 3], end], length: rope, gravity: GRAVITY };
            let count = rope.points(MAX_POINTS, &mut points);
            assert_eq!((count, points[0], points[count - 1]), (MAX_POINTS, [0.0; 3], end));
            let drawn = length(&points[..count]) / rope.length;
            assert!(drawn < 1.0 && drawn > 0.998, "{drawn}");
        }
    }

    #[test]
    fn a_rope_hangs_by_the_closed_form() {
        // Of y = a cosh(x / a) over a symmetric span, the length is 2 a sinh(span / 2a).
        let (a, span) = (0.4, 1.0);
        let rope = Rope {
            ends: [[0.0; 3], [0.0, span, 0.0]],
            length: 2.0 * a * sinh(span / (2.0 * a)),
            gravity: GRAVITY,
        };
        let mut points = [[0.0; 3]; MAX_POINTS];
        let count = rope.points(21, &mut points);
        assert_eq!(count, 21);
        for point in &points[..count] {
            let height = a * (cosh((point[1] - span / 2.0) / a) - cosh(span / (2.0 * a)));
            assert!((point[2] - height).abs() < 1e-8 && point[0] == 0.0, "{point:?}");
        }
    }

    #[test]
    fn steep_ropes_are_beads_and_taut_ones_straight() {
        let mut points = [[0.0; 3]; MAX_POINTS];
        let rope = |end, length| Rope { ends: [[0.0; 3], end], length, gravity: GRAVITY };
        assert_eq!(rope([0.0, 0.0, -1.0], 2.0).points(29, &mut points), 3);
        assert!((points[1][2] + 1.5).abs() < 1e-12, "{:?}", points[1]);
        for taut in [1.0, 0.9] {
            assert_eq!(rope([1.0, 0.0, 0.0], taut).points(29, &mut points), 2);
            assert_eq!(points[1], [1.0, 0.0, 0.0]);
        }
    }

    #[test]
    fn ropes_a_hair_longer_than_their_span_sag_a_little() {
        let mut points = [[0.0; 3]; MAX_POINTS];
        for hair in [1e-15, 1e-12, 1e-9, 1e-6, 1e-3] {
            let rope = Rope { ends: [[0.0; 3], [1.0, 0.0, 0.0]], length: 1.0 + hair, gravity: GRAVITY };
            assert_eq!(rope.points(30, &mut points), 30);
            // A shallow curve is a parabola, of which the sag is sqrt(3 / 8 of the surplus).
            let (sag, parabola) = (-points[15][2], ops::sqrt(0.375 * hair));
            assert!((sag - parabola).abs() < 1e-3 * parabola + 1e-7, "{sag} {parabola}");
        }
    }
}
