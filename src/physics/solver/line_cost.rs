//! The cost along a line from the current acceleration, with slope and curvature.
//!
//! Costs are differences from the start of the line, so that small improvements are not lost to rounding.

use super::problem::Problem;
use super::rows::Cone;
use crate::flex::Effective;
use crate::math::dense::dot_slice;
use crate::model::bounds::MINVAL;

/// A direction from an acceleration.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub problem: &'a Problem,
    /// The inertia with the stiffness of flexes, where that is part of it.
    pub effective: Option<Effective<'a>>,
    pub search: &'a [f64],
    /// `J qacc - aref` at the start.
    pub jar: &'a [f64],
    /// `M qacc` at the start.
    pub ma: &'a [f64],
    pub qfrc_smooth: &'a [f64],
}

/// The cost along one line.
#[derive(Clone, Debug, Default)]
pub(super) struct LineCost {
    /// `J search`.
    pub jv: Vec<f64>,
    /// `M search`.
    pub mv: Vec<f64>,
    /// Coefficients of the quadratic of each row, by power; a cone's quadratic stands at its first row.
    quad: [Vec<f64>; 3],
    /// Cost, slope and curvature of rows with friction loss.
    friction: [Vec<f64>; 3],
    /// What each cone needs.
    cones: Vec<ConeLine>,
    /// Linear and square coefficient of the unconstrained cost and of the equality rows.
    smooth: [f64; 2],
    /// Evaluations since the line was set.
    pub evaluations: i32,
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

/// A step along the line: length, cost difference, slope and curvature.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Point {
    pub alpha: f64,
    pub cost: f64,
    pub slope: f64,
    pub curvature: f64,
}

impl Point {
    /// Where the parabola through this point has its minimum.
    pub fn newton(&self) -> f64 {
        self.alpha - self.slope / self.curvature
    }
}

impl LineCost {
    /// Sets the line: computes `M search`, `J search` and the coefficients of all rows.
    pub fn begin(&mut self, line: Line) {
        self.evaluations = 0;
        let Line { problem, search, jar, .. } = line;
        let rows = &problem.rows;
        self.mv.resize(problem.nv, 0.0);
        self.jv.resize(rows.len(), 0.0);
        problem.mul_inertia(search, &mut self.mv);
        if let Some(effective) = line.effective {
            effective.add_product(search, &mut self.mv);
        }
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

    /// The point at step length `alpha` on the line that was set.
    pub fn evaluate(&mut self, line: Line, alpha: f64) -> Point {
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

/// The products whose sums are the coefficients of `½ Σ d (jar + alpha jv)²`.
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
    ///
    /// Above the cone there is no cost; below it the cost is the quadratic of all its rows; in between it is the square
    /// of the distance to the upper surface. The quadratic is that square plus the square of the distance to the
    /// lower surface, which is what a step between those two zones gains or loses.
    fn cost_difference(&self, quad: &[f64; 3], alpha: f64, mu: f64) -> f64 {
        let ConeLine { u0, v0, uu, uv, vv, dm } = *self;
        let (n, change) = (u0 + alpha * v0, alpha * (2.0 * uv + alpha * vv));
        let (from, t0) = zone(u0, uu, mu);
        let (to, t) = zone(n, uu + change, mu);
        let half = 0.5 * dm;
        let square = |distance: f64| half * distance * distance;
        let quadratic = || alpha * alpha * quad[2] + alpha * quad[1];
        let factored = || alpha * (alpha * quad[2] + quad[1]);
        match (from, to) {
            (Zone::Top, Zone::Top) => 0.0,
            (Zone::Top, Zone::Middle) => square(n - mu * t),
            (Zone::Top, Zone::Bottom) => quadratic() + quad[0],
            (Zone::Middle, Zone::Top) => -square(u0 - mu * t0),
            (Zone::Middle, Zone::Middle) => {
                // The difference of two squares is their sum times their difference.
                let rise = alpha * v0 - mu * (change / (t + t0));
                half * rise * (2.0 * (u0 - mu * t0) + rise)
            }
            (Zone::Middle, Zone::Bottom) => factored() + square(mu * u0 + t0),
            (Zone::Bottom, Zone::Top) => -quad[0],
            (Zone::Bottom, Zone::Middle) => factored() - square(mu * n + t),
            (Zone::Bottom, Zone::Bottom) => quadratic(),
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
