//! Exact line search: Newton steps on the derivative of the cost along a direction, then a bracketed search
//! (MuJoCo documentation, Computation, "Algorithms", "Newton").
//!
//! Costs are differences from the start of the line, so that small improvements are not lost to rounding.

use super::problem::Problem;
use super::rows::Cone;
use crate::math::dense::{dot_slice, norm_slice};
use crate::model::bounds::MINVAL;

/// The cost along one line.
#[derive(Clone, Debug, Default)]
pub(super) struct LineSearch {
    /// `J search`.
    pub jv: Vec<f64>,
    /// `M search`.
    pub mv: Vec<f64>,
    /// Coefficients of the quadratic of each row, by power; that of a cone stands at its first row.
    quad: [Vec<f64>; 3],
    /// Cost, slope and curvature of rows with friction loss.
    friction: [Vec<f64>; 3],
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
        let n = rows.len();
        self.quad.iter_mut().for_each(|quad| quad.resize(n, 0.0));
        let [q0, q1, q2] = self.quad.each_mut().map(|quad| &mut quad[..n]);
        let (d, jar, jv) = (&rows.d[..n], &jar[..n], &self.jv[..n]);
        for i in 0..n {
            [q0[i], q1[i], q2[i]] = quadratic(products(d[i], jar[i], jv[i]));
        }
        for i in 0..rows.ne {
            self.smooth[0] += q1[i];
            self.smooth[1] += q2[i];
        }
        self.cones.clear();
        for c in &rows.cones {
            let mut sum = [0.0; 3];
            for j in c.row..c.row + c.dim {
                let terms = products(d[j], jar[j], jv[j]);
                (0..3).for_each(|power| sum[power] += terms[power]);
            }
            [q0[c.row], q1[c.row], q2[c.row]] = quadratic(sum);
            self.cones.push(ConeLine::new(c, rows.d[c.row], jar, jv));
        }
        self.friction.iter_mut().for_each(|terms| terms.resize(rows.nef - rows.ne, 0.0));
    }

    fn evaluate(&mut self, line: Line, alpha: f64) -> Point {
        let (rows, jar) = (&line.problem.rows, line.jar);
        self.evaluations += 1;
        let mut sum =
            Sums { cost: 0.0, slope: 0.0, curvature: 0.0, quad: [0.0, self.smooth[0], self.smooth[1]] };
        let friction = rows.ne..rows.nef;
        friction_loss(
            [&jar[friction.clone()], &self.jv[friction.clone()]],
            [&rows.frictionloss[friction.clone()], &rows.r[friction.clone()], &rows.d[friction]],
            alpha,
            &mut self.friction,
        );
        let [costs, slopes, curvatures] = &self.friction;
        for ((cost, slope), curvature) in costs.iter().zip(slopes).zip(curvatures) {
            sum.cost += cost;
            sum.slope += slope;
            sum.curvature += curvature;
        }
        let Self { quad, jv, cones, .. } = &*self;
        rows.for_unilateral(
            &mut sum,
            |sum, range| {
                let [q0, q1, q2] = quad.each_ref().map(|q| &q[range.clone()]);
                for ((((&jar, &jv), q0), q1), q2) in
                    jar[range.clone()].iter().zip(&jv[range]).zip(q0).zip(q1).zip(q2)
                {
                    // Without branches: what a row does is hard to predict.
                    let start = if jar < 0.0 { *q0 } else { 0.0 };
                    let acts = jar + alpha * jv < 0.0;
                    sum.quad[0] += if acts { q0 - start } else { 0.0 };
                    sum.quad[1] += if acts { *q1 } else { 0.0 };
                    sum.quad[2] += if acts { *q2 } else { 0.0 };
                    sum.cost -= if acts { 0.0 } else { start };
                }
            },
            |sum, k, c| add_cone(&cones[k], &quad.each_ref().map(|q| q[c.row]), c.mu, alpha, sum),
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

/// Products of which the coefficients of `½ Σ d (jar + alpha jv)²` are sums.
#[inline]
fn products(d: f64, jar: f64, jv: f64) -> [f64; 3] {
    let force = d * jar;
    [jar * force, jv * force, jv * d * jv]
}

/// Those coefficients, by power of `alpha`.
#[inline]
fn quadratic(sums: [f64; 3]) -> [f64; 3] {
    [0.5 * sums[0], sums[1], 0.5 * sums[2]]
}

/// Cost of friction loss at `x`, a bound apart from zero linear.
#[inline]
fn friction_cost(x: f64, loss: f64, bound: f64, d: f64) -> f64 {
    let linear = loss * (-0.5 * bound + if x <= -bound { -x } else { x });
    if -bound < x && x < bound { 0.5 * d * x * x } else { linear }
}

/// Cost less that at the start of the line, slope and curvature of rows with friction loss. Rows are `start` and
/// `along` the line, with their `loss`, `r` and `d`.
///
/// Every piece is computed and one chosen: rows share vector registers, and none is mispredicted.
fn friction_loss(
    [start, along]: [&[f64]; 2],
    [loss, r, d]: [&[f64]; 3],
    alpha: f64,
    [cost, slope, curvature]: &mut [Vec<f64>; 3],
) {
    let n = start.len();
    let (along, loss, r, d) = (&along[..n], &loss[..n], &r[..n], &d[..n]);
    let (cost, slope, curvature) = (&mut cost[..n], &mut slope[..n], &mut curvature[..n]);
    for i in 0..n {
        let (start, along, loss, d, bound) = (start[i], along[i], loss[i], d[i], r[i] * loss[i]);
        let x = start + alpha * along;
        let piece = |x: f64| ((-bound < x) & (x < bound), x <= -bound);
        let ((was_inside, was_below), (inside, below)) = (piece(start), piece(x));
        let (was_above, above) = (!was_inside & !was_below, !inside & !below);
        let mut change = friction_cost(x, loss, bound, d) - friction_cost(start, loss, bound, d);
        change = if was_inside & inside { 0.5 * d * (x - start) * (x + start) } else { change };
        change = if was_below & below { loss * (start - x) } else { change };
        change = if was_above & above { loss * (x - start) } else { change };
        cost[i] = change;
        slope[i] = if inside { d * x * along } else { (if below { -loss } else { loss }) * along };
        curvature[i] = if inside { d * along * along } else { 0.0 };
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
