//! Rows as the solver sees them: parameters, friction cones, and the convex cost of `J qacc - aref`
//! (MuJoCo documentation, Computation, "Primal problem").

use crate::math::cholesky::stride;
use crate::model::{ConstraintState, ConstraintType};
use crate::stages::{Constraints, Contact};
use std::ops::Range;

/// The elliptic friction cone of one contact.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cone {
    /// First row.
    pub row: usize,
    /// Number of rows.
    pub dim: usize,
    /// Friction of the regularised cone.
    pub mu: f64,
    /// Friction coefficients of the tangential rows.
    pub friction: [f64; 5],
}

/// Parameters of a set of rows: equality, then friction loss, then limits and contacts.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    /// Equality rows.
    pub ne: usize,
    /// Equality and friction-loss rows: where limits and contacts begin.
    pub nef: usize,
    /// Constraint mass.
    pub d: Vec<f64>,
    /// Inverse constraint mass.
    pub r: Vec<f64>,
    /// Friction loss.
    pub frictionloss: Vec<f64>,
    /// Elliptic cones in order of their rows.
    pub cones: Vec<Cone>,
}

impl Rows {
    /// Collects the rows listed in `rows`, increasing.
    pub fn gather(&mut self, efc: &Constraints, contacts: &[Contact], rows: &[i32]) {
        self.ne = rows.partition_point(|&row| (row as usize) < efc.ne);
        self.nef = rows.partition_point(|&row| (row as usize) < efc.ne + efc.nf);
        for (to, from) in [
            (&mut self.d, &efc.efc_D),
            (&mut self.r, &efc.efc_R),
            (&mut self.frictionloss, &efc.efc_frictionloss),
        ] {
            to.clear();
            to.extend(rows.iter().map(|&row| from[row as usize]));
        }
        self.cones.clear();
        let mut i = self.nef;
        while i < rows.len() {
            let row = rows[i] as usize;
            let kind = efc.efc_type[row];
            i += if kind == ConstraintType::ContactElliptic.code() {
                let contact = &contacts[efc.efc_id[row] as usize];
                let (dim, mu, friction) = (contact.dim as usize, contact.mu, contact.friction);
                self.cones.push(Cone { row: i, dim, mu, friction });
                dim
            } else {
                1
            };
        }
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.d.len()
    }

    /// Calls `scalar` for each stretch of limit and contact rows outside elliptic cones and `cone` for each cone with
    /// its index, in order of rows.
    #[inline]
    pub fn for_unilateral<T>(
        &self,
        context: &mut T,
        mut scalar: impl FnMut(&mut T, Range<usize>),
        mut cone: impl FnMut(&mut T, usize, &Cone),
    ) {
        let mut i = self.nef;
        for (k, c) in self.cones.iter().enumerate() {
            scalar(context, i..c.row);
            cone(context, k, c);
            i = c.row + c.dim;
        }
        scalar(context, i..self.len());
    }

    /// Sets state and force of every row from `jar = J qacc - aref`; returns the cost.
    pub fn update(&self, jar: &[f64], state: &mut [ConstraintState], force: &mut [f64]) -> f64 {
        self.set::<true>(jar, state, force)
    }

    /// [`Rows::update`] without the cost, whose sum takes longer than all else.
    pub fn update_forces(&self, jar: &[f64], state: &mut [ConstraintState], force: &mut [f64]) {
        self.set::<false>(jar, state, force);
    }

    #[inline]
    fn set<const COST: bool>(&self, jar: &[f64], state: &mut [ConstraintState], force: &mut [f64]) -> f64 {
        let n = self.len();
        let (jar, state, force) = (&jar[..n], &mut state[..n], &mut force[..n]);
        let mut cost = 0.0;
        for i in 0..n {
            force[i] = -self.d[i] * jar[i];
        }
        state[..self.ne].fill(ConstraintState::Quadratic);
        if COST {
            (0..self.ne).for_each(|i| cost += 0.5 * self.d[i] * jar[i] * jar[i]);
        }
        for i in self.ne..self.nef {
            cost += self.update_friction_loss(i, jar[i], &mut state[i], &mut force[i]);
        }
        self.for_unilateral(
            &mut (&mut cost, state, force),
            |(cost, state, force), range| {
                let (state, force) = (&mut state[range.clone()], &mut force[range.clone()]);
                for (((&d, &jar), state), force) in
                    self.d[range.clone()].iter().zip(&jar[range]).zip(state).zip(force)
                {
                    // Without branches: what a row does is hard to predict.
                    let satisfied = jar >= 0.0;
                    if COST {
                        **cost += if satisfied { 0.0 } else { 0.5 * d * jar * jar };
                    }
                    *force = if satisfied { 0.0 } else { *force };
                    *state = if satisfied { ConstraintState::Satisfied } else { ConstraintState::Quadratic };
                }
            },
            |(cost, state, force), _, c| self.update_cone(c, jar, cost, state, force),
        );
        cost
    }

    /// Huber cost: quadratic while the force is below the friction loss.
    #[inline]
    fn update_friction_loss(&self, i: usize, jar: f64, state: &mut ConstraintState, force: &mut f64) -> f64 {
        let (loss, bound) = (self.frictionloss[i], self.r[i] * self.frictionloss[i]);
        if jar <= -bound {
            *force = loss;
            *state = ConstraintState::Linearneg;
            -0.5 * self.r[i] * loss * loss - loss * jar
        } else if jar >= bound {
            *force = -loss;
            *state = ConstraintState::Linearpos;
            -0.5 * self.r[i] * loss * loss + loss * jar
        } else {
            *state = ConstraintState::Quadratic;
            0.5 * self.d[i] * jar * jar
        }
    }

    fn update_cone(
        &self,
        c: &Cone,
        jar: &[f64],
        cost: &mut f64,
        state: &mut [ConstraintState],
        force: &mut [f64],
    ) {
        let (first, rows) = (c.row, c.row..c.row + c.dim);
        let point = ConePoint::new(c, jar);
        let zone = point.zone(c.mu);
        match zone {
            ConstraintState::Satisfied => force[rows.clone()].fill(0.0),
            ConstraintState::Cone => {
                let (dm, gap) = (c.stiffness(self.d[first]), point.n - c.mu * point.t);
                *cost += 0.5 * dm * gap * gap;
                force[first] = -dm * gap * c.mu;
                for j in 1..c.dim {
                    force[first + j] = -force[first] / point.t * point.u[j] * c.friction[j - 1];
                }
            }
            _ => {
                for j in rows.clone() {
                    *cost += 0.5 * self.d[j] * jar[j] * jar[j];
                }
            }
        }
        state[rows].fill(zone);
    }
}

impl Cone {
    /// Stiffness of the middle zone, from the mass of the normal row.
    pub fn stiffness(&self, d: f64) -> f64 {
        d / (self.mu * self.mu * (1.0 + self.mu * self.mu))
    }

    /// Factor that makes row `j` of the cone circular.
    pub fn scale(&self, j: usize) -> f64 {
        if j == 0 { self.mu } else { self.friction[j - 1] }
    }
}

/// A point in the space where the dual cone is circular.
pub(super) struct ConePoint {
    /// Coordinates, normal first.
    pub u: [f64; 6],
    /// Normal coordinate.
    pub n: f64,
    /// Length of the tangential coordinates.
    pub t: f64,
}

impl ConePoint {
    /// Maps the rows of cone `c`.
    pub fn new(c: &Cone, jar: &[f64]) -> Self {
        let mut u = [0.0; 6];
        for j in 0..c.dim {
            u[j] = jar[c.row + j] * c.scale(j);
        }
        ConePoint { u, n: u[0], t: crate::math::dense::norm_slice(&u[1..c.dim]) }
    }

    /// Zone: satisfied (top), quadratic (bottom) or on the cone (middle).
    pub fn zone(&self, mu: f64) -> ConstraintState {
        let (n, t) = (self.n, self.t);
        if n >= mu * t || t <= 0.0 && n >= 0.0 {
            ConstraintState::Satisfied
        } else if mu * n + t <= 0.0 || t <= 0.0 && n < 0.0 {
            ConstraintState::Quadratic
        } else {
            ConstraintState::Cone
        }
    }
}

/// Second derivative of the middle-zone cost of a cone by its rows: upper triangle, in rows of `stride(dim)`.
pub(super) fn cone_hessian(c: &Cone, d: f64, jar: &[f64], h: &mut [f64]) {
    let ConePoint { u, n, t } = ConePoint::new(c, jar);
    let (dim, mu, stride) = (c.dim, c.mu, stride(c.dim));
    h[0] = 1.0;
    for j in 1..dim {
        h[j] = -mu / t * u[j];
    }
    let curvature = mu * n / (t * t * t);
    for k in 1..dim {
        for j in k..dim {
            h[k * stride + j] = curvature * u[j] * u[k];
        }
        h[k * (stride + 1)] += mu * mu - mu * n / t;
    }
    let dm = c.stiffness(d);
    for k in 0..dim {
        let scale = dm * c.scale(k);
        for j in k..dim {
            h[k * stride + j] *= scale * c.scale(j);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows() -> Rows {
        let cone = Cone { row: 2, dim: 4, mu: 0.6, friction: [0.8, 0.7, 0.05, 0.0, 0.0] };
        let d = vec![30.0, 20.0, 50.0, 40.0, 40.0, 0.5];
        let r = d.iter().map(|d| 1.0 / d).collect();
        Rows { ne: 1, nef: 2, d, r, frictionloss: vec![0.0, 2.0, 0.0, 0.0, 0.0, 0.0], cones: vec![cone] }
    }

    fn evaluate(rows: &Rows, jar: &[f64]) -> (f64, Vec<f64>, ConstraintState) {
        let mut state = vec![ConstraintState::Satisfied; jar.len()];
        let mut force = vec![0.0; jar.len()];
        let cost = rows.update(jar, &mut state, &mut force);
        (cost, force, state[2])
    }

    #[test]
    fn force_is_minus_the_gradient_of_cost() {
        let rows = rows();
        let zones = [
            (vec![0.1, 0.02, -0.1, 0.3, -0.2, 0.4], ConstraintState::Cone),
            (vec![-0.2, 0.4, -1.0, 0.01, 0.02, 0.1], ConstraintState::Quadratic),
            (vec![0.3, -0.4, 1.0, 0.1, 0.1, 0.1], ConstraintState::Satisfied),
        ];
        for (jar, zone) in zones {
            let (_, force, found) = evaluate(&rows, &jar);
            assert_eq!(found, zone);
            for i in 0..jar.len() {
                let at = |h: f64| {
                    let mut moved = jar.clone();
                    moved[i] += h;
                    evaluate(&rows, &moved).0
                };
                let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
                assert!((slope + force[i]).abs() < 1e-6 * (1.0 + force[i].abs()), "{zone:?} {i}");
            }
        }
    }

    #[test]
    fn cone_hessian_is_the_derivative_of_force() {
        let rows = rows();
        let jar = vec![0.0, 0.0, -0.1, 0.3, -0.2, 0.4];
        let mut h = [0.0; 16];
        cone_hessian(&rows.cones[0], rows.d[2], &jar, &mut h);
        for j in 0..4 {
            let at = |step: f64| {
                let mut moved = jar.clone();
                moved[2 + j] += step;
                evaluate(&rows, &moved).1
            };
            let (plus, minus) = (at(1e-6), at(-1e-6));
            for k in 0..4 {
                let slope = -(plus[2 + k] - minus[2 + k]) / 2e-6;
                assert!((slope - h[4 * k.min(j) + k.max(j)]).abs() < 1e-5 * (1.0 + slope.abs()), "{k} {j}");
            }
        }
    }
}
