//! The solver from recorded inputs of the constraint rows, against recorded outputs.

use physics::inertia::mul_inertia_matrix;
use physics::model::{Cone, Disable, Jacobian, Solver};
use physics::solver::{SolverInputs, SolverScratch, solve};
use physics::{Data, Model};
use robohive_validation::reference::{is_own, recorded};
use robohive_validation::stages::before_solver;
use robohive_validation::tolerance::{
    SOLUTION_ELSEWHERE, STATIONARY, STATIONARY_ELSEWHERE, STATIONARY_LIMITED, STATIONARY_STIFF, STORAGE,
    STORAGE_ELSEWHERE, Tolerance, friction_is_stiff,
};

fn values(d: &Data, m: &Model, name: &str) -> Vec<f64> {
    let mut out = Vec::new();
    d.visit(m, &mut |n, _, s| {
        if n == name {
            out = s.to_f64();
        }
    });
    out
}

/// Largest difference relative to the largest magnitude (at least 1).
fn difference(ours: &[f64], theirs: &[f64]) -> f64 {
    assert_eq!(ours.len(), theirs.len());
    let scale = theirs.iter().fold(1.0_f64, |s, x| s.max(x.abs()));
    ours.iter().zip(theirs).fold(0.0_f64, |e, (a, b)| e.max((a - b).abs())) / scale
}

#[test]
fn solver_agrees() {
    let mut iterations = 0;
    let mut solution = SOLUTION_ELSEWHERE.gauge();
    for (path, r) in recorded().unwrap() {
        let m = r.model().unwrap();
        let warm = !m.opt.disableflags.contains(Disable::WARMSTART);
        let mut worst = [0.0_f64; 3];
        let mut exact = 0;
        let mut scratch = SolverScratch::default();
        let states = r.states().unwrap();
        for row in 0..states {
            let mut d = before_solver(&r, &m, row).unwrap();
            let inputs = SolverInputs {
                m: &m,
                state: &d.state,
                inertia: &d.inertia,
                effective: None,
                con: &d.con,
                island: &d.island,
            };
            solve(inputs, &mut d.efc, &mut d.acc, &mut d.solver, &mut scratch);
            let theirs = r.forward("solver_niter", row).unwrap();
            for (k, &n) in d.solver.solver_niter.iter().enumerate().take(theirs.len()) {
                assert_eq!(f64::from(n), theirs[k], "{path:?} state {row} island {k}");
                iterations += n;
            }
            // Dual states on the surface of a cone are decided by rounding, and a cold start sets none.
            if d.efc.nefc > 0
                && m.opt.solver != Solver::Pgs
                && warm
                && (m.opt.noslip_iterations == 0 || m.opt.cone == Cone::Pyramidal)
            {
                assert_eq!(
                    values(&d, &m, "efc_state"),
                    r.forward("efc_state", row).unwrap(),
                    "{path:?} {row}"
                );
            }
            exact += usize::from(d.acc.qacc == r.forward("qacc", row).unwrap());
            for (name, worst) in ["qacc", "qfrc_constraint", "efc_force"].iter().zip(&mut worst) {
                let e = difference(&values(&d, &m, name), &r.forward(name, row).unwrap());
                if is_own(&path) {
                    assert_eq!(e, 0.0, "{path:?} {row} {name}");
                } else {
                    solution.take(e, format!("{path:?} {row} {name}"));
                }
                *worst = worst.max(e);
            }
        }
        println!("{} {worst:?} {exact}/{states}", path.file_stem().unwrap().display());
    }
    assert!(iterations > 100);
}

/// Dense and sparse storage make the same motion, and Gauss's principle holds: the constraint force accounts for
/// the acceleration it causes.
#[test]
fn storage_does_not_matter() {
    let mut moved = 0.0_f64;
    let mut storages = [STORAGE_ELSEWHERE.gauge(), STORAGE.gauge()];
    let mut elsewhere = STATIONARY_ELSEWHERE.gauge();
    let [mut limited, mut stiff, mut own] =
        [&STATIONARY_LIMITED, &STATIONARY_STIFF, &STATIONARY].map(Tolerance::gauge);
    for (path, r) in recorded().unwrap() {
        let mut m = r.model().unwrap();
        if m.opt.solver == Solver::Cg {
            // Conjugate gradients stop at their tolerance, far from the solution.
            (m.options_mut().solver, m.options_mut().tolerance) = (Solver::Newton, 1e-8);
        }
        let residual = match () {
            () if !is_own(&path) => &mut elsewhere,
            () if m.opt.iterations < 100 => &mut limited,
            () if friction_is_stiff(&m) => {
                m.options_mut().tolerance = 0.0;
                &mut stiff
            }
            () => &mut own,
        };
        for row in 0..r.states().unwrap() {
            let solved = [Jacobian::Dense, Jacobian::Sparse].map(|storage| {
                m.options_mut().jacobian = storage;
                let mut d = before_solver(&r, &m, row).unwrap();
                let mut scratch = SolverScratch::default();
                let Data { state, inertia, con, efc, island, acc, solver, .. } = &mut d;
                let inputs = SolverInputs { m: &m, state, inertia, effective: None, con, island };
                solve(inputs, efc, acc, solver, &mut scratch);
                d.acc
            });
            let e = difference(&solved[0].qacc, &solved[1].qacc);
            storages[usize::from(is_own(&path))].take(e, format!("{path:?} {row}"));
            let change: Vec<f64> =
                solved[0].qacc.iter().zip(&solved[0].qacc_smooth).map(|(a, b)| a - b).collect();
            let mut force = vec![0.0; m.nv];
            mul_inertia_matrix(&m, &r.forward("M", row).unwrap(), &change, &mut force);
            let e = difference(&force, &solved[0].qfrc_constraint);
            residual.take(e, format!("{path:?} {row}"));
            moved = change.iter().fold(moved, |a, x| a.max(x.abs()));
        }
    }
    assert!(moved > 1.0);
}
