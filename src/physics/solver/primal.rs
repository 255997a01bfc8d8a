//! Shared parts of the primal solvers: the iterate, its cost's gradient, and when to stop.
//!
//! The cost is `½ (a - a₀)ᵀ M (a - a₀) + s(J a - a*)` with `a` the acceleration, `a₀` the unconstrained one and `a*`
//! the reference of rows (MuJoCo documentation, Computation, "Primal problem").

use super::hessian::Hessian;
use super::line_cost::{Line, LineCost};
use super::line_search::{Stop, line_search};
use super::problem::{Problem, Selection};
use crate::flex::Effective;
use crate::math::add_scaled_slice;
use crate::math::dense::{dot_slice, norm_slice};
use crate::model::{ConstraintState, Model};
use crate::stages::{Acceleration, Constraints, SolverStat};

/// Iterate of a primal solver and its memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Primal {
    pub problem: Problem,
    pub hessian: Hessian,
    /// The cost along the search direction.
    pub line: LineCost,
    /// Slope where the last search ended, in units of the tolerance.
    slope: f64,
    /// Acceleration.
    pub qacc: Vec<f64>,
    qacc_smooth: Vec<f64>,
    qfrc_smooth: Vec<f64>,
    qfrc_constraint: Vec<f64>,
    /// `M qacc`.
    ma: Vec<f64>,
    /// `J qacc - aref`.
    pub jar: Vec<f64>,
    pub state: Vec<ConstraintState>,
    pub old_state: Vec<ConstraintState>,
    force: Vec<f64>,
    /// Gradient of the cost.
    pub grad: Vec<f64>,
    /// Gradient times the inverse of the inertia (CG) or the Hessian (Newton).
    pub mgrad: Vec<f64>,
    /// Search direction.
    pub search: Vec<f64>,
    /// Previous gradients, for conjugate directions.
    pub grad_old: Vec<f64>,
    pub mgrad_old: Vec<f64>,
    /// Reciprocal of the inertia's trace: makes cost and gradient comparable with the tolerance.
    pub scale: f64,
}

impl Primal {
    /// Takes the selected accelerations and the reference, and evaluates there. `problem` is already gathered;
    /// `jar` is the residual of all rows of the model.
    pub fn begin(&mut self, acc: &Acceleration, efc: &Constraints, s: Selection, scale: f64, jar: &[f64]) {
        let p = &self.problem;
        for (to, from) in [
            (&mut self.qacc, &acc.qacc),
            (&mut self.qacc_smooth, &acc.qacc_smooth),
            (&mut self.qfrc_smooth, &acc.qfrc_smooth),
        ] {
            to.clear();
            to.extend(s.dofs.iter().map(|&d| from[d as usize]));
        }
        for v in [&mut self.qfrc_constraint, &mut self.ma, &mut self.grad, &mut self.mgrad] {
            v.resize(p.nv, 0.0);
        }
        self.force.resize(p.rows.len(), 0.0);
        self.state.resize(p.rows.len(), ConstraintState::Satisfied);
        self.scale = scale;
        p.mul_inertia(&self.qacc, &mut self.ma);
        if p.dense && p.nv == acc.qacc.len() {
            // All rows and columns of the model are here, so its products can be copied.
            self.jar.clear();
            self.jar.extend_from_slice(jar);
        } else {
            self.jar.resize(p.rows.len(), 0.0);
            p.mul_jacobian(&self.qacc, &mut self.jar);
            for (jar, &row) in self.jar.iter_mut().zip(s.rows) {
                *jar -= efc.efc_aref[row as usize];
            }
        }
        self.evaluate();
    }

    /// Takes the stiffness of flexes into the inertia, after `begin`.
    pub fn stiffen(&mut self, effective: Effective) {
        self.qfrc_smooth.iter_mut().zip(effective.shift()).for_each(|(f, shift)| *f += shift);
        effective.add_product(&self.qacc, &mut self.ma);
        self.evaluate();
    }

    /// Updates states, forces and gradient.
    fn evaluate(&mut self) {
        let p = &mut self.problem;
        p.rows.update_forces(&self.jar, &mut self.state, &mut self.force);
        p.mul_jacobian_transposed(&self.force, &mut self.qfrc_constraint);
        for i in 0..p.nv {
            self.grad[i] = self.ma[i] - self.qfrc_smooth[i] - self.qfrc_constraint[i];
        }
    }

    /// Sets `mgrad` to the inertia's inverse times the gradient.
    pub fn precondition_inertia(&mut self) {
        self.mgrad.copy_from_slice(&self.grad);
        self.problem.solve_inertia(&mut self.mgrad);
    }

    /// Sets `mgrad` to the Hessian's inverse times the gradient.
    pub fn precondition_hessian(&mut self) {
        self.mgrad.copy_from_slice(&self.grad);
        self.hessian.solve(&self.problem, &mut self.mgrad);
    }

    /// Half the gradient's squared length in the preconditioned metric: a bound on what is left to gain.
    pub fn decrement(&self) -> f64 {
        (0.5 * self.scale * dot_slice(&self.grad, &self.mgrad)).max(0.0)
    }

    /// Scaled length of the gradient.
    pub fn gradient(&self) -> f64 {
        self.scale * norm_slice(&self.grad)
    }

    /// Sets the search direction to steepest descent in the preconditioned metric.
    pub fn descend(&mut self) {
        self.search.clear();
        self.search.extend(self.mgrad.iter().map(|x| -x));
    }

    /// Minimises along the search direction and moves there, keeping the old states; returns the scaled
    /// improvement, or `None` when there is no step to take.
    pub fn step(&mut self, m: &Model, effective: Option<Effective>) -> Option<f64> {
        let line = Line {
            problem: &self.problem,
            effective,
            search: &self.search,
            jar: &self.jar,
            ma: &self.ma,
            qfrc_smooth: &self.qfrc_smooth,
        };
        let stop = Stop {
            scale: self.scale,
            tolerance: m.opt.tolerance * m.opt.ls_tolerance,
            evaluations: m.opt.ls_iterations,
        };
        let step = line_search(&mut self.line, line, stop);
        self.slope = step.slope;
        let alpha = step.alpha;
        if alpha == 0.0 {
            return None;
        }
        add_scaled_slice(&mut self.qacc, &self.search, alpha);
        add_scaled_slice(&mut self.ma, &self.line.mv, alpha);
        add_scaled_slice(&mut self.jar, &self.line.jv, alpha);
        self.old_state.clone_from(&self.state);
        self.evaluate();
        Some(self.scale * step.improvement)
    }

    /// What the last step did.
    pub fn statistics(&self, improvement: f64, gradient: f64, updates: usize) -> SolverStat {
        let active = self.state.iter().filter(|&&s| s != ConstraintState::Satisfied).count();
        let changed = self.state.iter().zip(&self.old_state).filter(|(new, old)| new != old).count();
        SolverStat {
            improvement,
            gradient,
            lineslope: self.slope,
            nactive: active as i32,
            nchange: changed as i32,
            neval: self.line.evaluations,
            nupdate: updates as i32,
        }
    }

    /// Writes the solution back.
    pub fn finish(&self, s: Selection, acc: &mut Acceleration, efc: &mut Constraints) {
        for (i, &dof) in s.dofs.iter().enumerate() {
            acc.qacc[dof as usize] = self.qacc[i];
            acc.qfrc_constraint[dof as usize] = self.qfrc_constraint[i];
        }
        for (force, &row) in self.force.iter().zip(s.rows) {
            efc.efc_force[row as usize] = *force;
        }
    }
}
