//! Constraint solver: the acceleration that minimises the sum of Gauss's cost and the cost of violating rows, and the
//! forces that make it (MuJoCo documentation, Computation, "Constraint solver"; Todorov 2014).
//!
//! Newton and CG work on accelerations, PGS on forces. Each island is solved on its own.

mod cg;
mod dual;
mod dual_pattern;
mod friction_force;
mod hessian;
mod line_cost;
mod line_search;
mod newton;
mod noslip;
mod pattern;
mod pgs;
mod primal;
mod problem;
mod products;
mod rows;
mod sparse_cholesky;

use crate::constraint::{mul_jacobian, mul_jacobian_transposed};
use crate::flex::Effective;
use crate::inertia::mul_inertia_matrix;
use crate::model::{ConstraintState, Disable, Model, Solver};
use crate::stages::{Acceleration, Constraints, Contacts, Inertia, Islands, SolverStatistics, State};
use dual::Dual;
use primal::Primal;
use problem::Selection;
use rows::Rows;

/// Memory that the solver reuses from step to step.
#[derive(Clone, Debug, Default)]
pub struct SolverScratch {
    /// One for each island, so that what follows from its pattern is kept from step to step.
    primal: Vec<Primal>,
    dual: Dual,
    rows: Rows,
    /// `J qacc - aref` of all rows at the start.
    jar: Vec<f64>,
    ma: Vec<f64>,
    state: Vec<ConstraintState>,
    /// The numbers from zero, for a model that is solved as a whole.
    all: Vec<i32>,
}

/// What the solver reads of a step.
#[derive(Clone, Copy, Debug)]
pub struct SolverInputs<'a> {
    /// The model.
    pub m: &'a Model,
    /// Where the acceleration of the step before is, from which to start.
    pub state: &'a State,
    /// Inertia and its factor.
    pub inertia: &'a Inertia,
    /// The inertia with the stiffness of flexes, where that is part of it.
    pub effective: Option<Effective<'a>>,
    /// Contacts of the rows.
    pub con: &'a Contacts,
    /// Islands of the rows.
    pub island: &'a Islands,
}

/// Computes `qacc`, `qfrc_constraint`, `efc_b`, `efc_force` and `efc_state`. `qacc_smooth` and `qfrc_smooth` are
/// inputs.
///
/// As in MuJoCo, when islands are solved by a primal method `efc_state` describes the start, not the solution.
pub fn solve(
    inputs: SolverInputs,
    efc: &mut Constraints,
    acc: &mut Acceleration,
    stats: &mut SolverStatistics,
    scratch: &mut SolverScratch,
) {
    let SolverInputs { m, inertia, island, .. } = inputs;
    acc.qfrc_constraint.fill(0.0);
    stats.solver.clear();
    stats.solver.reserve((m.opt.iterations.clamp(0, 1000) + m.opt.noslip_iterations.clamp(0, 1000)) as usize);
    stats.solver_niter.clear();
    stats.solver_nnz.clear();
    if efc.nefc == 0 {
        acc.qacc.copy_from_slice(&acc.qacc_smooth);
        return;
    }
    scratch.all.clear();
    scratch.all.extend(0..m.nv.max(efc.nefc) as i32);
    let dual = is_dual(m);
    if dual {
        scratch.dual.project(m, inertia, efc);
    }
    residual_of(m, efc, &acc.qacc_smooth, &mut scratch.jar);
    std::mem::swap(&mut efc.efc_b, &mut scratch.jar);
    start(inputs, efc, acc, scratch);
    let SolverScratch { all, primal, dual: forces, jar, .. } = scratch;
    let mut solvers = Solvers { primal, dual: forces, jar };
    if island.nisland > 0 && inputs.effective.is_none() {
        for k in 0..island.nisland {
            solvers.solve(inputs, Part::island(island, k), efc, acc, stats);
        }
    } else {
        let selection =
            Selection { dofs: &all[..m.nv], rows: &all[..efc.nefc], sorted: &all[..m.nv], first: 0 };
        let scale = 1.0 / (m.stat.meaninertia * m.nv.max(1) as f64);
        solvers.solve(inputs, Part { slot: 0, selection, scale: Some(scale) }, efc, acc, stats);
        if m.opt.solver != Solver::Pgs && m.opt.noslip_iterations == 0 {
            write_states(&solvers.primal[0].state, efc);
        }
    }
    if dual {
        finish_dual(m, inertia, efc, acc);
    }
}

/// Computes the constraint forces, with their states, that go with acceleration `qacc`.
#[doc(hidden)]
pub fn constraint_force(
    m: &Model,
    con: &Contacts,
    efc: &mut Constraints,
    acc: &mut Acceleration,
    scratch: &mut SolverScratch,
) {
    residual_of(m, efc, &acc.qacc, &mut scratch.jar);
    force_of_residual(con, efc, acc, scratch);
}

/// Computes the constraint forces, with their states, that go with the residuals `J qacc - aref`, one a row.
#[doc(hidden)]
pub fn force_at(
    residual: &[f64],
    con: &Contacts,
    efc: &mut Constraints,
    acc: &mut Acceleration,
    scratch: &mut SolverScratch,
) {
    scratch.jar.clear();
    scratch.jar.extend_from_slice(residual);
    force_of_residual(con, efc, acc, scratch);
}

/// The forces that go with the residuals in `scratch`.
fn force_of_residual(
    con: &Contacts,
    efc: &mut Constraints,
    acc: &mut Acceleration,
    scratch: &mut SolverScratch,
) {
    let SolverScratch { rows, jar, all, state, .. } = scratch;
    all.clear();
    all.extend(0..efc.nefc as i32);
    rows.gather(efc, &con.contact, all);
    state.resize(efc.nefc, ConstraintState::Satisfied);
    efc.efc_force.resize(efc.nefc, 0.0);
    rows.update(jar, state, &mut efc.efc_force);
    write_states(state, efc);
    mul_jacobian_transposed(efc, &efc.efc_force, &mut acc.qfrc_constraint);
}

/// True when forces are solved for, wholly or after a primal solver.
fn is_dual(m: &Model) -> bool {
    m.opt.solver == Solver::Pgs || m.opt.noslip_iterations > 0
}

/// `out = J qacc - aref`.
fn residual_of(m: &Model, efc: &Constraints, qacc: &[f64], out: &mut Vec<f64>) {
    mul_jacobian(m, efc, qacc, out);
    out.iter_mut().zip(&efc.efc_aref).for_each(|(x, aref)| *x -= aref);
}

fn write_states(state: &[ConstraintState], efc: &mut Constraints) {
    efc.efc_state.clear();
    efc.efc_state.extend(state.iter().map(|s| s.code()));
}

/// Chooses the start: the warm-start acceleration or the unconstrained one, whichever costs less, and for PGS the
/// forces of the former or none. Leaves the residual of all rows there in `jar`.
fn start(inputs: SolverInputs, efc: &mut Constraints, acc: &mut Acceleration, scratch: &mut SolverScratch) {
    let SolverInputs { m, state, inertia, con, island, .. } = inputs;
    efc.efc_force.resize(efc.nefc, 0.0);
    efc.efc_state.resize(efc.nefc, ConstraintState::Satisfied.code());
    if m.opt.disableflags.contains(Disable::WARMSTART) {
        acc.qacc.copy_from_slice(&acc.qacc_smooth);
        scratch.jar.clone_from(&efc.efc_b);
        efc.efc_force.fill(0.0);
        return;
    }
    let SolverScratch { rows, jar, ma, all, dual, state: states, .. } = scratch;
    rows.gather(efc, &con.contact, &all[..efc.nefc]);
    states.resize(efc.nefc, ConstraintState::Satisfied);
    acc.qacc.copy_from_slice(&state.qacc_warmstart);
    residual_of(m, efc, &state.qacc_warmstart, jar);
    let mut cost = rows.update(jar, states, &mut efc.efc_force);
    if m.opt.solver == Solver::Pgs {
        if dual.cost(efc) > 0.0 {
            efc.efc_force.fill(0.0);
        }
    } else {
        ma.resize(m.nv, 0.0);
        mul_inertia_matrix(m, &inertia.M, &state.qacc_warmstart, ma);
        for i in 0..m.nv {
            cost += 0.5 * (ma[i] - acc.qfrc_smooth[i]) * (acc.qacc[i] - acc.qacc_smooth[i]);
        }
        if cost > rows.update(&efc.efc_b, states, &mut efc.efc_force) {
            acc.qacc.copy_from_slice(&acc.qacc_smooth);
            jar.clone_from(&efc.efc_b);
        }
    }
    write_states(states, efc);
    if island.nisland > 0 {
        for &dof in &island.map_idof2dof[island.nidof..] {
            acc.qacc[dof as usize] = acc.qacc_smooth[dof as usize];
        }
    }
}

/// Islands that have their own memory of patterns; more share it.
const REMEMBERED: usize = 64;

/// An island, or the whole model.
struct Part<'a> {
    /// Number of its memory.
    slot: usize,
    selection: Selection<'a>,
    /// Scale of costs to accelerations; `None` for the reciprocal of the part's inertia.
    scale: Option<f64>,
}

impl<'a> Part<'a> {
    /// Island `k`.
    fn island(island: &'a Islands, k: usize) -> Self {
        let (first, row) = (island.island_idofadr[k] as usize, island.island_iefcadr[k] as usize);
        let selection = Selection {
            dofs: &island.map_idof2dof[first..first + island.island_nv[k] as usize],
            rows: &island.map_iefc2efc[row..row + island.island_nefc[k] as usize],
            sorted: &island.map_dof2idof,
            first: first as i32,
        };
        Part { slot: k % REMEMBERED, selection, scale: None }
    }
}

/// Both kinds of solvers, and the residual of all rows at the start.
struct Solvers<'a> {
    primal: &'a mut Vec<Primal>,
    dual: &'a mut Dual,
    jar: &'a [f64],
}

impl Solvers<'_> {
    /// Runs the chosen solver, and the removal of slip after it, on a part.
    fn solve(
        &mut self,
        inputs: SolverInputs,
        part: Part,
        efc: &mut Constraints,
        acc: &mut Acceleration,
        stats: &mut SolverStatistics,
    ) {
        let SolverInputs { m, inertia, effective, con, .. } = inputs;
        let (s, contacts) = (part.selection, &con.contact[..]);
        let (mut iterations, nonzeros) = if m.opt.solver == Solver::Pgs {
            (pgs::pgs(m, self.dual, efc, contacts, s.rows, &mut stats.solver), s.rows.len() * s.rows.len())
        } else {
            if self.primal.len() <= part.slot {
                self.primal.resize_with(part.slot + 1, Primal::default);
            }
            let primal = &mut self.primal[part.slot];
            primal.problem.gather(m, inertia, efc, con, s);
            let scale = part.scale.unwrap_or_else(|| 1.0 / primal.problem.inertia_trace());
            primal.begin(acc, efc, s, scale, self.jar);
            if let Some(effective) = effective {
                primal.stiffen(effective);
            }
            let result = if m.opt.solver == Solver::Cg {
                cg::conjugate_gradient(m, effective, primal, &mut stats.solver)
            } else {
                newton::newton(m, primal, &mut stats.solver)
            };
            primal.finish(s, acc, efc);
            result
        };
        if m.opt.noslip_iterations > 0 {
            iterations += noslip::noslip(m, self.dual, efc, contacts, s.rows, &mut stats.solver);
        }
        stats.solver_niter.push(iterations);
        stats.solver_nnz.push(nonzeros as i32);
    }
}

/// Joint-space force and acceleration of the forces found.
fn finish_dual(m: &Model, inertia: &Inertia, efc: &Constraints, acc: &mut Acceleration) {
    mul_jacobian_transposed(efc, &efc.efc_force, &mut acc.qfrc_constraint);
    acc.qacc.copy_from_slice(&acc.qfrc_constraint);
    crate::inertia::solve(m, inertia, &mut acc.qacc);
    acc.qacc.iter_mut().zip(&acc.qacc_smooth).for_each(|(a, smooth)| *a += smooth);
}
