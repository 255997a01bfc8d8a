//! Exact line search on a convex cost.
//!
//! Along a line the cost is convex and smooth. Without cones it is quadratic between the points at which a row begins or ceases
//! to act, so that its slope is piecewise linear, and never falls. The minimum is the root of the slope. A Newton step leads to
//! the root of the piece on which it starts: this is the minimum if that lies on the same piece, else a point on either side of
//! the minimum. So the search has two stages:
//!
//! 1. Newton steps go on from the start while the slope keeps its sign. When the sign changes, the last two points straddle the
//!    minimum.
//! 2. Both ends of that bracket move in. Each round evaluates the Newton steps from both ends and the middle, and each end moves
//!    to the flattest of the points on its side (safeguarded Newton's method; Press et al., Numerical Recipes, 2007,
//!    section 9.4).
//!
//! MuJoCo's documentation describes the method (Computation, "Algorithms", "Newton"). Which points are evaluated, and in which
//! order, decides the last bits; both are MuJoCo's.

use super::line_cost::{Line, LineCost, Point};
use crate::math::dense::norm_slice;
use crate::model::bounds::MINVAL;

/// When a search ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    /// Scale of costs to accelerations, see `primal`.
    pub scale: f64,
    /// Scaled slope over the length of the direction at which the cost counts as flat.
    pub tolerance: f64,
    /// Evaluations allowed.
    pub evaluations: i32,
}

/// Where a search ended.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// Step length; 0 where no step is better than none.
    pub alpha: f64,
    /// By how much the cost falls.
    pub improvement: f64,
    /// Slope in units of the tolerance; 1 without a tolerance.
    pub slope: f64,
}

/// Best step along a line. The line is left set in `cost`.
pub(super) fn line_search(cost: &mut LineCost, line: Line, stop: Stop) -> Step {
    const NONE: Step = Step { alpha: 0.0, improvement: 0.0, slope: 1.0 };
    let length = norm_slice(line.search);
    if length < MINVAL {
        cost.evaluations = 0;
        return NONE;
    }
    cost.begin(line);
    let flat = stop.tolerance * length / stop.scale;
    let mut search = Search { cost, line, flat, evaluations: stop.evaluations };
    let end = match search.cross() {
        Crossing::Ended(point) => Some(point),
        Crossing::Straddled(bracket) => search.narrow(bracket),
    };
    let unit = stop.scale / length;
    end.map_or(NONE, |p| Step { alpha: p.alpha, improvement: -p.cost, slope: p.slope.abs() * unit })
}

/// A search in progress.
struct Search<'a> {
    cost: &'a mut LineCost,
    line: Line<'a>,
    /// Slope below which the cost counts as flat.
    flat: f64,
    /// Evaluations allowed.
    evaluations: i32,
}

/// Where a point lies, as the sign of its slope tells.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    BeforeMinimum,
    AfterMinimum,
    /// The slope is 0 or not a number.
    Unknown,
}

impl Side {
    fn of(point: &Point) -> Self {
        if point.slope < 0.0 {
            Side::BeforeMinimum
        } else if point.slope > 0.0 {
            Side::AfterMinimum
        } else {
            Side::Unknown
        }
    }
}

/// What the first stage comes to.
enum Crossing {
    /// At the minimum, or as far as evaluations last.
    Ended(Point),
    /// With the minimum between the last two points.
    Straddled([End; 2]),
}

/// An end of a bracket, and the point to which a Newton step from it leads.
#[derive(Clone, Copy)]
struct End {
    at: Point,
    newton: Point,
}

impl End {
    /// Moves to the flattest of the points that are on its side of the minimum; false where the end is as flat already.
    fn moves_to_flattest(&mut self, points: &[Point; 3]) -> bool {
        let side = Side::of(&self.at);
        let before = self.at.slope.abs();
        if side != Side::Unknown {
            for point in points.iter().filter(|point| Side::of(point) == side) {
                if point.slope.abs() < self.at.slope.abs() {
                    self.at = *point;
                }
            }
        }
        self.at.slope.abs() < before
    }
}

impl Search<'_> {
    fn evaluate(&mut self, alpha: f64) -> Point {
        self.cost.evaluate(self.line, alpha)
    }

    fn newton_from(&mut self, point: &Point) -> Point {
        self.evaluate(point.newton())
    }

    fn is_exhausted(&self) -> bool {
        self.cost.evaluations >= self.evaluations
    }

    fn is_flat(&self, p: &Point) -> bool {
        p.slope.abs() < self.flat
    }

    /// The first stage: Newton steps, at least one, until one of them passes the minimum.
    fn cross(&mut self) -> Crossing {
        let mut last = self.evaluate(0.0);
        let mut here = self.newton_from(&last);
        let begins_at_minimum = self.is_flat(&here) && here.alpha == 0.0;
        let sign = if here.slope < 0.0 { -1.0 } else { 1.0 };
        loop {
            let arrived = self.is_flat(&here) && here.cost < 0.0;
            if arrived || begins_at_minimum || self.is_exhausted() {
                return Crossing::Ended(here);
            }
            let same_side = here.slope * sign >= self.flat;
            let next = self.newton_from(&here);
            if !same_side {
                return Crossing::Straddled([End { at: here, newton: next }, End { at: last, newton: here }]);
            }
            (last, here) = (here, next);
        }
    }

    /// The second stage. `None` when evaluations run out and neither end is better than no step.
    fn narrow(&mut self, mut ends: [End; 2]) -> Option<Point> {
        while !self.is_exhausted() {
            let middle = self.evaluate(0.5 * (ends[0].at.alpha + ends[1].at.alpha));
            let points = [ends[0].newton, ends[1].newton, middle];
            let arrived = points.iter().filter(|p| self.is_flat(p));
            if let Some(lowest) = arrived.reduce(|best, p| if p.cost < best.cost { p } else { best }) {
                return Some(*lowest);
            }
            let mut narrower = false;
            for end in &mut ends {
                if end.moves_to_flattest(&points) {
                    end.newton = self.newton_from(&end.at);
                    narrower = true;
                }
            }
            if !narrower {
                // Rounding allows no narrower bracket.
                return Some(middle);
            }
        }
        let [a, b] = ends.map(|end| end.at);
        let lower = if a.cost <= b.cost { a } else { b };
        (lower.cost < 0.0).then_some(lower)
    }
}
