//! Exact line search on a convex cost: Newton steps until the slope changes sign, then a bracket that closes from both
//! ends (MuJoCo documentation, Computation, "Algorithms", "Newton").

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
    /// Slope in units of the tolerance; 1 where there is none.
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
    let end = match search.march() {
        March::Arrived(end) => Some(end),
        March::Bracketed(bracket) => search.close(bracket),
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

/// What Newton steps in one direction lead to.
enum March {
    /// The minimum, or as far as evaluations last.
    Arrived(Point),
    Bracketed(Bracket),
}

/// Two points whose slopes point at each other, so that the minimum is between them.
struct Bracket {
    ends: [End; 2],
}

/// An end of a bracket, and a point that may be a better one.
#[derive(Clone, Copy)]
struct End {
    at: Point,
    proposal: Point,
}

impl Search<'_> {
    fn evaluate(&mut self, alpha: f64) -> Point {
        self.cost.evaluate(self.line, alpha)
    }

    fn is_exhausted(&self) -> bool {
        self.cost.evaluations >= self.evaluations
    }

    fn is_flat(&self, p: &Point) -> bool {
        p.slope.abs() < self.flat
    }

    /// Takes Newton steps from the start until the slope changes sign. At least one is taken.
    fn march(&mut self) -> March {
        let start = self.evaluate(0.0);
        let mut here = self.evaluate(start.newton());
        if self.is_flat(&here) && (here.alpha == 0.0 || here.cost < 0.0) {
            return March::Arrived(here);
        }
        let mut before = start;
        let downhill = if here.slope < 0.0 { 1.0 } else { -1.0 };
        while here.slope * downhill <= -self.flat && !self.is_exhausted() {
            before = here;
            here = self.evaluate(here.newton());
            if self.is_flat(&here) && here.cost < 0.0 {
                return March::Arrived(here);
            }
        }
        if self.is_exhausted() {
            return March::Arrived(here);
        }
        let near = End { at: here, proposal: self.evaluate(here.newton()) };
        March::Bracketed(Bracket { ends: [near, End { at: before, proposal: here }] })
    }

    /// Closes a bracket on the minimum. Each round offers both ends the same three points: the Newton step from
    /// either end and the middle. `None` when evaluations run out and neither end is better than no step.
    fn close(&mut self, mut bracket: Bracket) -> Option<Point> {
        while !self.is_exhausted() {
            let [a, b] = bracket.ends;
            let middle = self.evaluate(0.5 * (a.at.alpha + b.at.alpha));
            let candidates = [a.proposal, b.proposal, middle];
            let flat = candidates.iter().filter(|p| self.is_flat(p));
            if let Some(lowest) = flat.reduce(|best, p| if p.cost < best.cost { p } else { best }) {
                return Some(*lowest);
            }
            let mut moved = false;
            for end in &mut bracket.ends {
                if let Some(at) = end.improved(&candidates) {
                    *end = End { at, proposal: self.evaluate(at.newton()) };
                    moved = true;
                }
            }
            if !moved {
                // The bracket is as narrow as rounding allows.
                return Some(middle);
            }
        }
        let [a, b] = bracket.ends.map(|end| end.at);
        let lower = if a.cost <= b.cost { a } else { b };
        (lower.cost < 0.0).then_some(lower)
    }
}

impl End {
    /// The flattest of the candidates that lie on this side of the minimum, if it is flatter than the end itself.
    fn improved(&self, candidates: &[Point; 3]) -> Option<Point> {
        let beside =
            |p: &Point| (p.slope < 0.0 && self.at.slope < 0.0) || (p.slope > 0.0 && self.at.slope > 0.0);
        let flatter = |best: Point, p: &Point| if p.slope.abs() < best.slope.abs() { *p } else { best };
        let flattest = candidates.iter().filter(|p| beside(p)).fold(self.at, flatter);
        (flattest.slope.abs() < self.at.slope.abs()).then_some(flattest)
    }
}
