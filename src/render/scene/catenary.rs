//! The curve of a rope that hangs between two points: the catenary `y = a cosh(x / a)`.
//!
//! Let the ends be `w` apart in width and `v` in height, at `m - w/2` and `m + w/2` from the lowest point of the curve. By the
//! addition theorems of the hyperbolic functions, the difference of the heights and the length of the arc are
//!
//! - `v = a cosh((m + w/2)/a) - a cosh((m - w/2)/a) = 2 a sinh(w/2a) sinh(m/a)`,
//! - `L = a sinh((m + w/2)/a) - a sinh((m - w/2)/a) = 2 a sinh(w/2a) cosh(m/a)`.
//!
//! The difference of their squares, `L² - v² = (2 a sinh(w/2a))²`, is one equation for `a` (`FlatnessEquation`). Their quotient
//! `v / L = tanh(m/a)` then gives `m = a/2 ln((L + v) / (L - v))` (Irvine, Cable Structures, 1981, chapter 1).

use physics::math::{Vec3, add_scaled, distance, dot, norm, ops, scale, sub};
use physics::model::bounds::MINVAL;

/// Points along a curve at most.
pub(super) const MAX_POINTS: usize = 100;

/// A rope between two points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rope {
    /// Its ends, world frame \[m\].
    pub ends: [Vec3; 2],
    /// Its length \[m\].
    pub length: f64,
    /// Acceleration of gravity, not zero.
    pub gravity: Vec3,
}

impl Rope {
    /// Fills `points` from its front with points along the rope, `count` of them where it hangs in a curve, fewer where
    /// it is taut or nearly vertical; returns how many. `count` is 2 to [`MAX_POINTS`].
    pub fn points(&self, count: usize, points: &mut [Vec3; MAX_POINTS]) -> usize {
        let [start, end] = self.ends;
        let plane = Plane::new(start, end, self.gravity);
        let inner = match Shape::of(self, &plane) {
            Shape::Straight => 0,
            Shape::Kinked { x, y } => {
                points[1] = plane.point(x, y);
                1
            }
            Shape::Curved(curve) => {
                // MuJoCo's points are a little closer together than the width would allow: the last stretch is longer.
                for (i, point) in points.iter_mut().enumerate().take(count - 1).skip(1) {
                    let x = i as f64 * plane.width / count as f64;
                    *point = plane.point(x, curve.height(x));
                }
                count - 2
            }
        };
        points[0] = start;
        points[inner + 1] = end;
        inner + 2
    }
}

/// The vertical plane through both ends.
struct Plane {
    start: Vec3,
    across: Vec3,
    up: Vec3,
    /// From the first end to the second \[m\].
    width: f64,
    rise: f64,
}

impl Plane {
    fn new(start: Vec3, end: Vec3, gravity: Vec3) -> Self {
        let up = scale(gravity, -1.0 / norm(gravity));
        let span = sub(end, start);
        let rise = dot(span, up);
        let level = add_scaled(span, up, -rise);
        let length = norm(level);
        let across = if length < MINVAL { [0.0; 3] } else { scale(level, 1.0 / length) };
        Plane { start, across, up, width: dot(span, across), rise }
    }

    /// The point so far across and above the first end, world frame.
    fn point(&self, x: f64, y: f64) -> Vec3 {
        add_scaled(add_scaled(self.start, self.across, x), self.up, y)
    }
}

/// How a rope hangs.
enum Shape {
    /// Taut, or too little longer than its span for a curve.
    Straight,
    /// Down to a point and up again: far longer than wide.
    Kinked {
        x: f64,
        y: f64,
    },
    Curved(Curve),
}

impl Shape {
    fn of(rope: &Rope, plane: &Plane) -> Self {
        /// How much longer than wide a rope is drawn as two straight lines.
        const STEEP: f64 = 100.0;
        let Rope { ends: [start, end], length, .. } = *rope;
        let Plane { width, rise, .. } = *plane;
        if distance(start, end) < length {
            if length > STEEP * width {
                // Both lines are equally steep, as on a string with a bead: together they go down and up by sqrt(L² - w²).
                let y = -0.5 * (ops::sqrt(length * length - width * width) - rise);
                return Shape::Kinked { x: width * y / (2.0 * y - rise), y };
            }
            if let Some(curve) = Curve::new(width, rise, length) {
                return Shape::Curved(curve);
            }
        }
        Shape::Straight
    }
}

/// A catenary from the first end on.
struct Curve {
    /// Its scale `a` \[m\].
    a: f64,
    /// How far from the first end it is lowest \[m\].
    lowest: f64,
    /// How far the first end is above the curve's axis y = 0 \[m\].
    start: f64,
}

impl Curve {
    fn new(width: f64, rise: f64, length: f64) -> Option<Self> {
        let stretch = ops::sqrt(length * length - rise * rise) / width;
        if stretch <= 1.0 {
            return None;
        }
        let a = width * FlatnessEquation::new(stretch).solve();
        let lowest = 0.5 * (width - a * ops::log((length + rise) / (length - rise)));
        Some(Curve { a, lowest, start: a * cosh(lowest / a) })
    }

    /// Height above the first end at a distance from it.
    fn height(&self, x: f64) -> f64 {
        self.a * cosh((x - self.lowest) / self.a) - self.start
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

/// The equation for the flatness `b = a / w`: `2 b sinh(1/2b) = s`, where the stretch `s = sqrt(L² - v²) / w` is more than 1.
///
/// For flat curves `2 b sinh(1/2b) - 1` is nearly `1 / 24b²`. So `1 / sqrt(2 b sinh(1/2b) - 1)` is nearly `sqrt(24) b`. In this
/// form the equation is nearly linear, which gives the first trial, and Newton's method takes a few steps.
struct FlatnessEquation {
    /// `1 / sqrt(s - 1)`.
    wanted: f64,
}

/// A flatness, and by how much it misses the equation.
#[derive(Clone, Copy)]
struct Trial {
    b: f64,
    misfit: f64,
}

impl FlatnessEquation {
    fn new(stretch: f64) -> Self {
        FlatnessEquation { wanted: 1.0 / ops::sqrt(stretch - 1.0) }
    }

    fn trial(&self, b: f64) -> Trial {
        Trial { b, misfit: 1.0 / ops::sqrt(excess(0.5 / b)) - self.wanted }
    }

    /// The root, up to a misfit of 1e-9.
    fn solve(&self) -> f64 {
        const TOLERANCE: f64 = 1e-9;
        const STEPS: usize = 50;
        let mut trial = self.trial(self.wanted / ops::sqrt(24.0));
        for _ in 0..STEPS {
            if trial.misfit.abs() < TOLERANCE {
                break;
            }
            trial = self.newton(trial);
        }
        trial.b
    }

    /// Newton's step, halved until it leads to a smaller misfit, at most ten times.
    fn newton(&self, from: Trial) -> Trial {
        let half = 0.5 / from.b;
        let slope = excess_slope(half) * ops::pow(excess(half), -1.5);
        let step = -from.misfit / slope;
        (0..10)
            .scan(step, |step, _| Some(std::mem::replace(step, 0.5 * *step)))
            .map(|step| self.trial(from.b + step))
            .find(|trial| trial.misfit.abs() < from.misfit.abs())
            .unwrap_or_else(|| self.trial(from.b + step / 1024.0))
    }
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
            // A shallow curve is a parabola; its sag is sqrt(3 / 8 of the surplus).
            let (sag, parabola) = (-points[15][2], ops::sqrt(0.375 * hair));
            assert!((sag - parabola).abs() < 1e-3 * parabola + 1e-7, "{sag} {parabola}");
        }
    }
}
