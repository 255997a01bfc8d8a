//! Exact line search: Newton steps on the derivative of the cost along a direction, then a bracketed search
//! (MuJoCo documentation, Computation, "Algorithms", "Newton").
//!
//! Costs are differences from the start of the line, so that small improvements are not lost to rounding.

use super::problem::Problem;
use super::rows::{Cone, Rows};
use crate::math::dense::{dot_slice, norm_slice};
use crate::model::bounds::MINVAL;

/// The cost along one line.
#[derive(Clone, Debug, Default)]
pub(super) struct LineSearch {
    /// `J search`.
    pub jv: Vec<f64>,
    /// `M search`.
    pub mv: Vec<f64>,
    /// Quadratic of each limit or contact row, and of each equality row; that of a cone stands at its first row.
    quad: Vec<[f64; 3]>,
    /// What each cone needs.
    cones: Vec<ConeLine>,
    /// Linear and square coefficient of the unconstrained cost and of the equality rows.
    smooth: [f64; 2],
    /// Evaluations so far.
    pub evaluations: i32,
    /// Slope where the search ended, in units of the tolerance; 1 where there is none.
    pub slope: f64,
    /// Scale of slopes: that of costs over the length of the search direction.
    unit: f64,
}

/// Where a search starts: constants of the line.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub problem: &'a Problem,
    pub search: &'a [f64],
    pub jar: &'a [f64],
    pub ma: &'a [f64],
    pub qfrc_smooth: &'a [f64],
    /// Scale of costs to accelerations, see `primal`.
    pub scale: f64,
    pub tolerance: f64,
    pub iterations: i32,
}

/// Circular coordinates of a cone at the start (`u`) and along the line (`v`): normal parts, and inner products of
/// tangential parts.
#[derive(Clone, Copy, Debug, Default)]
struct ConeLine {
    u0: f64,
    v0: f64,
    uu: f64,
    uv: f64,
    vv: f64,
    dm: f64,
}

/// Step length, cost difference, slope and curvature.
#[derive(Clone, Copy, Debug, Default)]
struct Point {
    alpha: f64,
    cost: f64,
    slope: f64,
    curvature: f64,
}

impl Point {
    fn newton(&self) -> f64 {
        self.alpha - self.slope / self.curvature
    }
}

impl LineSearch {
    /// Best step length and the improvement of cost it makes; a length of zero when there is none.
    pub fn search(&mut self, line: Line) -> (f64, f64) {
        (self.evaluations, self.slope) = (0, 1.0);
        let length = norm_slice(line.search);
        if length < MINVAL {
            return (0.0, 0.0);
        }
        let flat = line.tolerance * length / line.scale;
        self.unit = line.scale / length;
        self.prepare(line);
        let p0 = self.evaluate(line, 0.0);
        let mut p1 = self.evaluate(line, p0.newton());
        if p1.slope.abs() < flat && (p1.alpha == 0.0 || p1.cost < 0.0) {
            return self.end(p1);
        }
        // March on with Newton steps until the slope changes sign.
        let direction = if p1.slope < 0.0 { 1.0 } else { -1.0 };
        let mut p2 = p0;
        while p1.slope * direction <= -flat && self.evaluations < line.iterations {
            p2 = p1;
            p1 = self.evaluate(line, p1.newton());
            if p1.slope.abs() < flat && p1.cost < 0.0 {
                return self.end(p1);
            }
        }
        if self.evaluations >= line.iterations {
            return self.end(p1);
        }
        self.bracket(line, flat, p1, p2)
    }

    /// Step length and improvement at `p`, whose slope is kept.
    fn end(&mut self, p: Point) -> (f64, f64) {
        self.slope = p.slope.abs() * self.unit;
        (p.alpha, -p.cost)
    }

    /// Shrinks the bracket `p1`, `p2` with Newton steps from both ends and bisection.
    fn bracket(&mut self, line: Line, flat: f64, mut p1: Point, mut p2: Point) -> (f64, f64) {
        let mut p2_next = p1;
        let mut p1_next = self.evaluate(line, p1.newton());
        while self.evaluations < line.iterations {
            let middle = self.evaluate(line, 0.5 * (p1.alpha + p2.alpha));
            let candidates = [p1_next, p2_next, middle];
            let mut best: Option<Point> = None;
            for p in candidates {
                if p.slope.abs() < flat && best.is_none_or(|b| p.cost < b.cost) {
                    best = Some(p);
                }
            }
            if let Some(best) = best {
                return self.end(best);
            }
            let moved1 = self.tighten(line, &mut p1, &candidates, &mut p1_next);
            let moved2 = self.tighten(line, &mut p2, &candidates, &mut p2_next);
            if !moved1 && !moved2 {
                return self.end(middle);
            }
        }
        if p1.cost <= p2.cost && p1.cost < 0.0 {
            self.end(p1)
        } else if p2.cost <= p1.cost && p2.cost < 0.0 {
            self.end(p2)
        } else {
            (0.0, 0.0)
        }
    }

    /// Moves an end of the bracket to candidates on its side that are closer to the minimum.
    fn tighten(&mut self, line: Line, p: &mut Point, candidates: &[Point; 3], next: &mut Point) -> bool {
        let mut moved = false;
        for c in candidates {
            let closer = p.slope < 0.0 && c.slope < 0.0 && p.slope < c.slope
                || p.slope > 0.0 && c.slope > 0.0 && p.slope > c.slope;
            if closer {
                *p = *c;
                moved = true;
            }
        }
        if moved {
            *next = self.evaluate(line, p.newton());
        }
        moved
    }

    /// Computes `M search`, `J search` and the coefficients of all rows.
    fn prepare(&mut self, line: Line) {
        let Line { problem, search, jar, .. } = line;
        let rows = &problem.rows;
        self.mv.resize(problem.nv, 0.0);
        self.jv.resize(rows.len(), 0.0);
        problem.mul_inertia(search, &mut self.mv);
        problem.mul_jacobian(search, &mut self.jv);
        self.smooth = [
            dot_slice(search, line.ma) - dot_slice(line.qfrc_smooth, search),
            0.5 * dot_slice(search, &self.mv),
        ];
        self.quad.clear();
        self.quad.extend((0..rows.len()).map(|i| quadratic(rows, jar, &self.jv, i, 1)));
        for quad in &self.quad[..rows.ne] {
            self.smooth[0] += quad[1];
            self.smooth[1] += quad[2];
        }
        self.cones.clear();
        for c in &rows.cones {
            self.quad[c.row] = quadratic(rows, jar, &self.jv, c.row, c.dim);
            self.cones.push(ConeLine::new(c, rows.d[c.row], jar, &self.jv));
        }
    }

    fn evaluate(&mut self, line: Line, alpha: f64) -> Point {
        let (rows, jar) = (&line.problem.rows, line.jar);
        self.evaluations += 1;
        let mut sum =
            Sums { cost: 0.0, slope: 0.0, curvature: 0.0, quad: [0.0, self.smooth[0], self.smooth[1]] };
        for i in rows.ne..rows.nef {
            add_friction_loss(rows, i, jar[i], self.jv[i], alpha, &mut sum);
        }
        let Self { quad, jv, cones, .. } = &*self;
        rows.for_unilateral(
            &mut sum,
            |sum, i| {
                let start = if jar[i] < 0.0 { quad[i][0] } else { 0.0 };
                if jar[i] + alpha * jv[i] < 0.0 {
                    sum.quad[0] += quad[i][0] - start;
                    sum.quad[1] += quad[i][1];
                    sum.quad[2] += quad[i][2];
                } else {
                    sum.cost -= start;
                }
            },
            |sum, k, c| add_cone(&cones[k], &quad[c.row], c.mu, alpha, sum),
        );
        let [q0, q1, q2] = sum.quad;
        let curvature = sum.curvature + 2.0 * q2;
        Point {
            alpha,
            cost: sum.cost + (alpha * alpha * q2 + alpha * q1 + q0),
            slope: sum.slope + (2.0 * alpha * q2 + q1),
            curvature: if curvature <= 0.0 { MINVAL } else { curvature },
        }
    }
}

/// Sums over rows while evaluating: cost and derivatives of curved rows, coefficients of quadratic ones.
struct Sums {
    cost: f64,
    slope: f64,
    curvature: f64,
    quad: [f64; 3],
}

/// Coefficients of `½ Σ d (jar + alpha jv)²` over `dim` rows from row `i`.
fn quadratic(rows: &Rows, jar: &[f64], jv: &[f64], i: usize, dim: usize) -> [f64; 3] {
    let mut quad = [0.0; 3];
    for j in i..i + dim {
        let force = rows.d[j] * jar[j];
        quad[0] += jar[j] * force;
        quad[1] += jv[j] * force;
        quad[2] += jv[j] * rows.d[j] * jv[j];
    }
    [0.5 * quad[0], quad[1], 0.5 * quad[2]]
}

/// Pieces of the cost of friction loss: -1, 0, 1 for the linear negative, quadratic, linear positive one.
fn friction_piece(x: f64, bound: f64) -> i32 {
    if -bound < x && x < bound {
        0
    } else if x <= -bound {
        -1
    } else {
        1
    }
}

fn friction_cost(x: f64, loss: f64, bound: f64, d: f64) -> f64 {
    match friction_piece(x, bound) {
        0 => 0.5 * d * x * x,
        -1 => loss * (-0.5 * bound - x),
        _ => loss * (-0.5 * bound + x),
    }
}

fn add_friction_loss(rows: &Rows, i: usize, start: f64, along: f64, alpha: f64, sum: &mut Sums) {
    let (x, loss, d) = (start + alpha * along, rows.frictionloss[i], rows.d[i]);
    let bound = rows.r[i] * loss;
    let piece = friction_piece(x, bound);
    sum.cost += match (friction_piece(start, bound), piece) {
        (0, 0) => 0.5 * d * (x - start) * (x + start),
        (-1, -1) => loss * (start - x),
        (1, 1) => loss * (x - start),
        _ => friction_cost(x, loss, bound, d) - friction_cost(start, loss, bound, d),
    };
    match piece {
        0 => {
            sum.slope += d * x * along;
            sum.curvature += d * along * along;
        }
        -1 => sum.slope += -loss * along,
        _ => sum.slope += loss * along,
    }
}

/// Where a point lies relative to a cone.
#[derive(Clone, Copy, PartialEq)]
enum Zone {
    Top,
    Bottom,
    Middle,
}

/// Zone of normal part `n` and squared tangential part `tt`; the tangential length when it is positive.
fn zone(n: f64, tt: f64, mu: f64) -> (Zone, f64) {
    if tt <= 0.0 {
        return (if n < 0.0 { Zone::Bottom } else { Zone::Top }, 0.0);
    }
    let t = tt.sqrt();
    let zone = if n >= mu * t {
        Zone::Top
    } else if mu * n + t <= 0.0 {
        Zone::Bottom
    } else {
        Zone::Middle
    };
    (zone, t)
}

impl ConeLine {
    fn new(c: &Cone, d: f64, jar: &[f64], jv: &[f64]) -> Self {
        let mut line = ConeLine { u0: jar[c.row] * c.mu, v0: jv[c.row] * c.mu, ..Self::default() };
        for j in 1..c.dim {
            let (u, v) = (jar[c.row + j] * c.friction[j - 1], jv[c.row + j] * c.friction[j - 1]);
            line.uu += u * u;
            line.uv += u * v;
            line.vv += v * v;
        }
        line.dm = c.stiffness(d);
        line
    }

    /// Cost at `alpha` minus cost at zero, in a form that does not cancel.
    fn cost_difference(&self, quad: &[f64; 3], alpha: f64, mu: f64) -> f64 {
        let ConeLine { u0, v0, uu, uv, vv, dm } = *self;
        let (n, change) = (u0 + alpha * v0, alpha * (2.0 * uv + alpha * vv));
        let (from, t0) = zone(u0, uu, mu);
        let (to, t) = zone(n, uu + change, mu);
        let half = 0.5 * dm;
        match (from, to) {
            (Zone::Top, Zone::Top) => 0.0,
            (Zone::Bottom, Zone::Bottom) => alpha * alpha * quad[2] + alpha * quad[1],
            (Zone::Middle, Zone::Middle) => {
                let r_change = alpha * v0 - mu * (change / (t + t0));
                half * r_change * (2.0 * (u0 - mu * t0) + r_change)
            }
            (Zone::Middle, Zone::Bottom) => {
                let boundary = mu * u0 + t0;
                alpha * (alpha * quad[2] + quad[1]) + half * boundary * boundary
            }
            (Zone::Bottom, Zone::Middle) => {
                let boundary = mu * n + t;
                alpha * (alpha * quad[2] + quad[1]) - half * boundary * boundary
            }
            (Zone::Top, Zone::Bottom) => alpha * alpha * quad[2] + alpha * quad[1] + quad[0],
            (Zone::Top, Zone::Middle) => {
                let r = n - mu * t;
                half * r * r
            }
            (Zone::Middle, Zone::Top) => {
                let r = u0 - mu * t0;
                -half * r * r
            }
            (Zone::Bottom, Zone::Top) => -quad[0],
        }
    }
}

fn add_cone(line: &ConeLine, quad: &[f64; 3], mu: f64, alpha: f64, sum: &mut Sums) {
    sum.cost += line.cost_difference(quad, alpha, mu);
    let ConeLine { u0, v0, uu, uv, vv, dm } = *line;
    let n = u0 + alpha * v0;
    match zone(n, uu + alpha * (2.0 * uv + alpha * vv), mu) {
        (Zone::Top, _) => {}
        (Zone::Bottom, _) => {
            sum.slope += 2.0 * alpha * quad[2] + quad[1];
            sum.curvature += 2.0 * quad[2];
        }
        (Zone::Middle, t) => {
            let rise = (uv + alpha * vv) / t;
            let bend = vv / t - (uv + alpha * vv) * rise / (t * t);
            let along = v0 - mu * rise;
            sum.slope += dm * (n - mu * t) * along;
            sum.curvature += dm * (along * along + (n - mu * t) * (-mu * bend));
        }
    }
}
