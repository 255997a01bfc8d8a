//! Factor of the Hessian `M + Jᵀ D J` of the primal cost, kept up to date as rows change state: dense for small
//! models, sparse for large ones (MuJoCo documentation, Computation, "Algorithms", "Newton").

use super::problem::Problem;
use super::rows::cone_hessian;
use super::sparse_cholesky::SparseCholesky;
use crate::math::add_scaled_slice;
use crate::math::dense::{cholesky_factor, cholesky_solve, cholesky_update};
use crate::model::ConstraintState;
use crate::model::bounds::MINVAL;

/// The factored Hessian.
#[derive(Clone, Debug, Default)]
pub(super) struct Hessian {
    /// Factor of the quadratic rows: lower triangle, or values of `sparse`.
    factor: Vec<f64>,
    /// The same with cones added.
    with_cones: Vec<f64>,
    has_cones: bool,
    /// Row of a rank-one update.
    update: Vec<f64>,
    /// `Lᵀ J` of one cone, a row for each dimension.
    cone_rows: Vec<f64>,
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
            assemble_dense(p, &self.active, &mut self.factor);
            cholesky_factor(&mut self.factor, p.nv, MINVAL);
        } else {
            self.sparse.factorize(p, &self.active, &mut self.factor, MINVAL);
        }
        self.add_cones(p, state, jar);
        self.updates = p.rows.len();
    }

    /// Updates the factor for rows that became quadratic or ceased to be; starts afresh when accuracy is lost.
    pub fn follow(&mut self, p: &Problem, old: &[ConstraintState], state: &[ConstraintState], jar: &[f64]) {
        self.updates = 0;
        for i in 0..p.rows.len() {
            let (was, is) = (old[i] == ConstraintState::Quadratic, state[i] == ConstraintState::Quadratic);
            if was == is {
                continue;
            }
            self.updates += 1;
            if self.update_row(p, i, is) < p.nv {
                self.factorize(p, state, jar);
                return;
            }
        }
        self.add_cones(p, state, jar);
    }

    /// Adds or removes row `i`; returns the rank.
    fn update_row(&mut self, p: &Problem, i: usize, plus: bool) -> usize {
        let root = p.rows.d[i].sqrt();
        self.update.clear();
        if p.dense {
            self.update.extend(p.dense_row(i).iter().map(|x| x * root));
            cholesky_update(&mut self.factor, p.nv, &mut self.update, plus, MINVAL)
        } else {
            let (columns, values) = p.sparse_row(i);
            self.update.extend(values.iter().map(|x| x * root));
            self.sparse.update(&mut self.factor, columns, &self.update, plus, MINVAL)
        }
    }

    /// Rank-one updates for every contact on its cone: with `H = L Lᵀ` of the cone, one for each row of `Lᵀ J`.
    fn add_cones(&mut self, p: &Problem, state: &[ConstraintState], jar: &[f64]) {
        self.has_cones = p.rows.cones.iter().any(|c| state[c.row] == ConstraintState::Cone);
        if !self.has_cones {
            return;
        }
        self.with_cones.clone_from(&self.factor);
        let mut local = [0.0; 36];
        for c in p.rows.cones.iter().filter(|c| state[c.row] == ConstraintState::Cone) {
            self.updates += c.dim;
            cone_hessian(c, p.rows.d[c.row], jar, &mut local);
            cholesky_factor(&mut local[..c.dim * c.dim], c.dim, MINVAL);
            let n = if p.dense { p.nv } else { p.sparse_row(c.row).0.len() };
            self.cone_rows.clear();
            self.cone_rows.resize(c.dim * n, 0.0);
            for r in 0..c.dim {
                let row = if p.dense { p.dense_row(c.row + r) } else { p.sparse_row(c.row + r).1 };
                for k in 0..=r {
                    add_scaled_slice(&mut self.cone_rows[k * n..(k + 1) * n], row, local[r * c.dim + k]);
                }
            }
            for row in self.cone_rows.chunks_exact_mut(n) {
                if p.dense {
                    cholesky_update(&mut self.with_cones, p.nv, row, true, MINVAL);
                } else {
                    let columns = p.sparse_row(c.row).0;
                    self.sparse.update(&mut self.with_cones, columns, row, true, MINVAL);
                }
            }
        }
    }

    /// Solves `H x = x` in place.
    pub fn solve(&self, p: &Problem, x: &mut [f64]) {
        let factor = if self.has_cones { &self.with_cones } else { &self.factor };
        if p.dense { cholesky_solve(factor, p.nv, x) } else { self.sparse.solve(factor, x) }
    }

    /// Stored entries of the factors.
    pub fn nonzeros(&self) -> usize {
        self.factor.len() + if self.has_cones { self.with_cones.len() } else { 0 }
    }
}

/// Lower triangle of `M + Jᵀ D J`.
fn assemble_dense(p: &Problem, active: &[f64], h: &mut Vec<f64>) {
    let n = p.nv;
    h.clear();
    h.resize(n * n, 0.0);
    for (row, &d) in p.jacobian.chunks_exact(n).zip(active) {
        if d == 0.0 {
            continue;
        }
        let first = row.iter().position(|&x| x != 0.0).unwrap_or(n);
        for (i, &x) in row.iter().enumerate().skip(first) {
            if x != 0.0 {
                add_scaled_slice(&mut h[i * n + first..i * n + i + 1], &row[first..], x * d);
            }
        }
    }
    for i in 0..n {
        let (columns, values) = p.inertia_row(i);
        for (&j, x) in columns.iter().zip(values) {
            h[i * n + j as usize] += x;
        }
    }
}
