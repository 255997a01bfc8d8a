//! Constraint solver: the acceleration that minimises the sum of Gauss's cost and the cost of violating rows, and the
//! forces that make it (MuJoCo documentation, Computation, "Constraint solver"; Todorov 2014).
//!
//! Newton and CG work on accelerations, PGS on forces. Each island is solved on its own.

mod cg;
mod dual;
mod friction_force;
mod hessian;
mod line_cost;
mod line_search;
mod newton;
mod noslip;
mod pgs;
mod primal;
mod problem;
mod rows;
mod sparse_cholesky;

use crate::constraint::{mul_jacobian, mul_jacobian_transposed};
use crate::data::{Acceleration, Constraints, Contacts, Inertia, Islands, SolverStatistics, State};
use crate::inertia::mul_inertia_matrix;
use crate::model::{ConstraintState, Disable, Model, Solver};
use dual::Dual;
use primal::Primal;
use problem::Selection;
use rows::Rows;

/// Memory that the solver reuses from step to step.
#[derive(Clone, Debug, Default)]
pub struct SolverScratch {
    primal: Primal,
    dual: Dual,
    rows: Rows,
    /// `J qacc - aref` of all rows at the start.
    jar: Vec<f64>,
    ma: Vec<f64>,
    state: Vec<ConstraintState>,
    /// The numbers from zero, for a model that is solved as a whole.
    all: Vec<i32>,
}

/// Computes `qacc`, `qfrc_constraint`, `efc_b`, `efc_force` and `efc_state`. `qacc_smooth` and `qfrc_smooth` are
/// inputs, and so is `qacc_warmstart` of `state`.
///
/// As in MuJoCo, when islands are solved by a primal method `efc_state` is that of the start, not of the solution.
#[allow(clippy::too_many_arguments)]
pub fn solve(
    m: &Model,
    state: &State,
    inertia: &Inertia,
    con: &Contacts,
    efc: &mut Constraints,
    island: &Islands,
    acc: &mut Acceleration,
    stats: &mut SolverStatistics,
    scratch: &mut SolverScratch,
) {
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
    start(m, state, inertia, con, efc, island, acc, scratch);
    if island.nisland > 0 {
        for k in 0..island.nisland {
            solve_island(m, inertia, con, efc, island, k, acc, stats, scratch);
        }
    } else {
        let SolverScratch { all, primal, dual, jar, .. } = scratch;
        let s = Selection { dofs: &all[..m.nv], rows: &all[..efc.nefc], sorted: &all[..m.nv], first: 0 };
        let scale = |_: &Primal| 1.0 / (m.stat.meaninertia * m.nv.max(1) as f64);
        solve_part(m, inertia, con, efc, s, scale, jar, acc, stats, primal, dual);
        if m.opt.solver != Solver::Pgs && m.opt.noslip_iterations == 0 {
            write_states(&primal.state, efc);
        }
    }
    if dual {
        finish_dual(m, inertia, efc, acc);
    }
}

/// Computes the constraint forces, with their states, that go with acceleration `qacc`.
pub(crate) fn constraint_force(
    m: &Model,
    con: &Contacts,
    efc: &mut Constraints,
    acc: &mut Acceleration,
    scratch: &mut SolverScratch,
) {
    let SolverScratch { rows, jar, all, state, .. } = scratch;
    all.clear();
    all.extend(0..efc.nefc as i32);
    residual_of(m, efc, &acc.qacc, jar);
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
#[allow(clippy::too_many_arguments)]
fn start(
    m: &Model,
    state: &State,
    inertia: &Inertia,
    con: &Contacts,
    efc: &mut Constraints,
    island: &Islands,
    acc: &mut Acceleration,
    scratch: &mut SolverScratch,
) {
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

/// Solves island `k`.
#[allow(clippy::too_many_arguments)]
fn solve_island(
    m: &Model,
    inertia: &Inertia,
    con: &Contacts,
    efc: &mut Constraints,
    island: &Islands,
    k: usize,
    acc: &mut Acceleration,
    stats: &mut SolverStatistics,
    scratch: &mut SolverScratch,
) {
    let (first, row) = (island.island_idofadr[k] as usize, island.island_iefcadr[k] as usize);
    let s = Selection {
        dofs: &island.map_idof2dof[first..first + island.island_nv[k] as usize],
        rows: &island.map_iefc2efc[row..row + island.island_nefc[k] as usize],
        sorted: &island.map_dof2idof,
        first: first as i32,
    };
    let scale = |p: &Primal| 1.0 / p.problem.inertia_trace();
    let SolverScratch { primal, dual, jar, .. } = scratch;
    solve_part(m, inertia, con, efc, s, scale, jar, acc, stats, primal, dual);
}

/// Runs the chosen solver, and the removal of slip after it, on a selection; `jar` is the residual of all rows.
#[allow(clippy::too_many_arguments)]
fn solve_part(
    m: &Model,
    inertia: &Inertia,
    con: &Contacts,
    efc: &mut Constraints,
    s: Selection,
    scale: impl Fn(&Primal) -> f64,
    jar: &[f64],
    acc: &mut Acceleration,
    stats: &mut SolverStatistics,
    primal: &mut Primal,
    dual: &mut Dual,
) {
    let (mut iterations, nonzeros) = if m.opt.solver == Solver::Pgs {
        (pgs::pgs(m, dual, efc, &con.contact, s.rows, &mut stats.solver), s.rows.len() * s.rows.len())
    } else {
        primal.problem.gather(m, inertia, efc, con, s);
        primal.begin(acc, efc, s, scale(primal), jar);
        let result = if m.opt.solver == Solver::Cg {
            cg::conjugate_gradient(m, primal, &mut stats.solver)
        } else {
            newton::newton(m, primal, &mut stats.solver)
        };
        primal.finish(s, acc, efc);
        result
    };
    if m.opt.noslip_iterations > 0 {
        iterations += noslip::noslip(m, dual, efc, &con.contact, s.rows, &mut stats.solver);
    }
    stats.solver_niter.push(iterations);
    stats.solver_nnz.push(nonzeros as i32);
}

/// Joint-space force and acceleration of the forces found.
fn finish_dual(m: &Model, inertia: &Inertia, efc: &Constraints, acc: &mut Acceleration) {
    mul_jacobian_transposed(efc, &efc.efc_force, &mut acc.qfrc_constraint);
    acc.qacc.copy_from_slice(&acc.qfrc_constraint);
    crate::inertia::solve(m, inertia, &mut acc.qacc);
    acc.qacc.iter_mut().zip(&acc.qacc_smooth).for_each(|(a, smooth)| *a += smooth);
}
