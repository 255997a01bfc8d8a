//! Factor of the Hessian `M + Jᵀ D J` of the primal cost, kept up to date as rows change state: dense for small
//! models, sparse for large ones (MuJoCo documentation, Computation, "Algorithms", "Newton").

use super::problem::Problem;
use super::rows::cone_hessian;
use super::sparse_cholesky::SparseCholesky;
use crate::math::add_scaled_slice;
use crate::math::cholesky::{add_outer_product, cholesky_factor, cholesky_solve, cholesky_update, stride};
use crate::model::ConstraintState;
use crate::model::bounds::MINVAL;

/// The factored Hessian.
#[derive(Clone, Debug, Default)]
pub(super) struct Hessian {
    /// Factor of the quadratic rows: an array of `math::cholesky`, or values of `sparse`.
    factor: Vec<f64>,
    /// The same with cones added.
    with_cones: Vec<f64>,
    has_cones: bool,
    /// Rows of rank-one updates, and which of them are added.
    update: Vec<f64>,
    plus: Vec<bool>,
    /// Mass of rows in the quadratic state, zero elsewhere.
    active: Vec<f64>,
    sparse: SparseCholesky,
    /// Rank-one updates since the last iteration; all rows when the factor is made afresh.
    pub updates: usize,
}

impl Hessian {
    /// Prepares the structure for a new problem.
    pub fn begin(&mut self, p: &Problem) {
        if !p.dense {
            self.sparse.analyse(p);
        }
    }

    /// Assembles and factors from the states of all rows.
    pub fn factorize(&mut self, p: &Problem, state: &[ConstraintState], jar: &[f64]) {
        let mass = |(s, d): (&ConstraintState, &f64)| if *s == ConstraintState::Quadratic { *d } else { 0.0 };
        self.active.clear();
        self.active.extend(state.iter().zip(&p.rows.d).map(mass));
        if p.dense {
            assemble_dense(p, &self.active, &mut self.update, &mut self.factor);
            cholesky_factor(&mut self.factor, p.nv, MINVAL);
        } else {
            self.sparse.factorize(p, &self.active, &mut self.factor, MINVAL);
        }
        self.add_cones(p, state, jar);
        self.updates = p.rows.len();
    }

    /// Updates the factor for rows that became quadratic or ceased to be; starts afresh when accuracy is lost.
    pub fn follow(&mut self, p: &Problem, old: &[ConstraintState], state: &[ConstraintState], jar: &[f64]) {
        let quadratic = |s: ConstraintState| s == ConstraintState::Quadratic;
        self.update.clear();
        self.plus.clear();
        let mut fallen = 0;
        for i in (0..p.rows.len()).filter(|&i| quadratic(old[i]) != quadratic(state[i])) {
            let (root, plus) = (p.rows.d[i].sqrt(), quadratic(state[i]));
            self.plus.push(plus);
            if p.dense {
                self.update.extend(p.dense_row(i).iter().map(|x| x * root));
                self.update.resize(self.plus.len() * stride(p.nv), 0.0);
            } else {
                let (columns, values) = p.sparse_row(i);
                self.update.clear();
                self.update.extend(values.iter().map(|x| x * root));
                fallen += self.sparse.update(&mut self.factor, columns, &self.update, plus, MINVAL);
            }
        }
        if p.dense {
            fallen += cholesky_update(&mut self.factor, p.nv, &mut self.update, &self.plus, MINVAL);
        }
        if fallen > 0 {
            self.factorize(p, state, jar);
        } else {
            self.updates = self.plus.len();
            self.add_cones(p, state, jar);
        }
    }

    /// Rank-one updates for every contact on its cone: with `H = L Lᵀ` of the cone, one for each row of `Lᵀ J`.
    fn add_cones(&mut self, p: &Problem, state: &[ConstraintState], jar: &[f64]) {
        self.has_cones = p.rows.cones.iter().any(|c| state[c.row] == ConstraintState::Cone);
        if !self.has_cones {
            return;
        }
        self.with_cones.clone_from(&self.factor);
        self.update.clear();
        self.plus.clear();
        for c in p.rows.cones.iter().filter(|c| state[c.row] == ConstraintState::Cone) {
            let mut local = [0.0; 6 * stride(6)];
            cone_hessian(c, p.rows.d[c.row], jar, &mut local);
            cholesky_factor(&mut local, c.dim, MINVAL);
            let n = if p.dense { stride(p.nv) } else { p.sparse_row(c.row).0.len() };
            let first = self.update.len();
            self.update.resize(first + c.dim * n, 0.0);
            let rows = &mut self.update[first..];
            for r in 0..c.dim {
                let row = if p.dense { p.dense_row(c.row + r) } else { p.sparse_row(c.row + r).1 };
                for k in 0..=r {
                    add_scaled_slice(&mut rows[k * n..(k + 1) * n], row, local[k * stride(c.dim) + r]);
                }
            }
            if !p.dense {
                for row in rows.chunks_exact_mut(n) {
                    let columns = p.sparse_row(c.row).0;
                    self.sparse.update(&mut self.with_cones, columns, row, true, MINVAL);
                }
            }
            self.plus.resize(self.plus.len() + c.dim, true);
        }
        self.updates += self.plus.len();
        if p.dense {
            cholesky_update(&mut self.with_cones, p.nv, &mut self.update, &self.plus, MINVAL);
        }
    }

    /// Solves `H x = x` in place.
    pub fn solve(&self, p: &Problem, x: &mut [f64]) {
        let factor = if self.has_cones { &self.with_cones } else { &self.factor };
        if p.dense { cholesky_solve(factor, p.nv, x) } else { self.sparse.solve(factor, x) }
    }

    /// Entries of the factors, as full matrices where they are dense.
    pub fn nonzeros(&self, p: &Problem) -> usize {
        let one = if p.dense { p.nv * p.nv } else { self.factor.len() };
        one * (1 + usize::from(self.has_cones))
    }
}

/// Upper triangle of `M + Jᵀ D J`; `scaled` is working memory.
fn assemble_dense(p: &Problem, active: &[f64], scaled: &mut Vec<f64>, h: &mut Vec<f64>) {
    let stride = stride(p.nv);
    h.clear();
    h.resize(p.nv * stride, 0.0);
    for ((i, span), &d) in p.spans.iter().enumerate().zip(active).filter(|(_, d)| **d != 0.0) {
        add_outer_product(h, p.nv, span.start, &p.dense_row(i)[span.clone()], d, scaled);
    }
    for i in 0..p.nv {
        let (columns, values) = p.inertia_row(i);
        for (&j, x) in columns.iter().zip(values) {
            h[j as usize * stride + i] += x;
        }
    }
}
