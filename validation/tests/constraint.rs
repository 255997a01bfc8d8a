//! Constraint rows, islands and solver from recorded inputs of the stage alone, against recorded outputs.

use physics::constraint::{ConstraintScratch, IslandScratch, find_islands, make_constraint, reference};
use physics::inertia::mul_inertia_matrix;
use physics::model::{Jacobian, Solver, disable};
use physics::solver::{SolverScratch, solve};
use physics::{Data, Model};
use robohive_validation::reference::{Reference, recorded};

/// Relative difference of rows: sums of a few products, in the same order.
const ROW: f64 = 1e-10;

/// Relative difference of solutions: both stop at a tolerance of 1e-8 in scaled cost or gradient.
const SOLUTION: f64 = 1e-8;

/// Relative difference of dense and sparse solutions, which stop in the same iteration.
const STORAGE: f64 = 1e-9;

/// Relative residual of the equation of motion: the gradient at which the solver stops.
const STATIONARY: f64 = 1e-6;

const INPUTS: [&str; 20] = [
    "xpos",
    "xquat",
    "xmat",
    "geom_xpos",
    "geom_xmat",
    "site_xpos",
    "subtree_com",
    "cdof",
    "ten_J",
    "ten_length",
    "M",
    "qLD",
    "qLDiagInv",
    "cvel",
    "cdof_dot",
    "qfrc_smooth",
    "qacc_smooth",
    "contact.dist",
    "contact.pos",
    "contact.frame",
];
const CONTACT: [&str; 8] = [
    "contact.includemargin",
    "contact.friction",
    "contact.solref",
    "contact.solreffriction",
    "contact.solimp",
    "contact.adhesion",
    "contact.dim",
    "contact.geom",
];
const ROWS: [&str; 9] = [
    "efc_pos",
    "efc_margin",
    "efc_frictionloss",
    "efc_diagA",
    "efc_KBIP",
    "efc_D",
    "efc_R",
    "efc_vel",
    "efc_aref",
];

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

fn dense_jacobian(d: &Data, m: &Model) -> Vec<f64> {
    let mut dense = vec![0.0; d.efc.nefc * m.nv];
    for i in 0..d.efc.nefc {
        let start = d.efc.efc_J_rowadr[i] as usize;
        for k in start..start + d.efc.efc_J_rownnz[i] as usize {
            dense[i * m.nv + d.efc.efc_J_colind[k] as usize] = d.efc.efc_J[k];
        }
    }
    dense
}

/// Data of recorded state `row`, all inputs of the constraint stages set, rows and islands computed.
fn constrained(r: &Reference, m: &Model, row: usize) -> Data {
    let mut d = Data::new(m);
    r.set_state(&mut d, m, row).unwrap();
    r.inject(&mut d, &INPUTS, row).unwrap();
    for name in CONTACT {
        assert_eq!(d.assign(name, &r.forward(name, row).unwrap()), Some(true));
    }
    d.con.contact.iter_mut().for_each(|c| c.efc_address = -1);
    let (mut scratch, mut islands) = (ConstraintScratch::default(), IslandScratch::default());
    make_constraint(m, &d.state, &d.kin, &d.com, &d.ten, &d.inertia, &mut d.con, &mut d.efc, &mut scratch);
    find_islands(m, &d.con, &d.efc, &mut d.island, &mut islands);
    reference(m, &d.state, &d.kin, &d.com, &d.vel, &d.con, &mut d.efc);
    d
}

#[test]
fn rows_agree() {
    let mut rows = 0;
    for (path, r) in recorded().unwrap() {
        let m = r.model().unwrap();
        let mut worst = (0.0, "");
        for row in 0..r.states().unwrap() {
            let d = constrained(&r, &m, row);
            for (name, ours) in [("ne", d.efc.ne), ("nf", d.efc.nf), ("nl", d.efc.nl), ("nefc", d.efc.nefc)] {
                assert_eq!(ours as f64, r.forward(name, row).unwrap()[0], "{path:?} {row} {name}");
            }
            assert_eq!(
                d.island.nisland as f64,
                r.forward("nisland", row).unwrap()[0],
                "{path:?} {row} islands"
            );
            for name in ["efc_type", "efc_id", "contact.efc_address"] {
                assert_eq!(values(&d, &m, name), r.forward(name, row).unwrap(), "{path:?} {row} {name}");
            }
            for name in ROWS {
                let e = difference(&values(&d, &m, name), &r.forward(name, row).unwrap());
                assert!(e < ROW, "{path:?} {row} {name} {e}");
                worst = if e > worst.0 { (e, name) } else { worst };
            }
            let e = difference(&dense_jacobian(&d, &m), &r.forward("efc_J", row).unwrap());
            assert!(e < ROW, "{path:?} {row} efc_J {e}");
            assert!(difference(&values(&d, &m, "contact.mu"), &r.forward("contact.mu", row).unwrap()) < ROW);
            rows += d.efc.nefc;
        }
        println!("{} {worst:?}", path.file_stem().unwrap().display());
    }
    assert!(rows > 100);
}

#[test]
fn solver_agrees() {
    let mut iterations = 0;
    for (path, r) in recorded().unwrap() {
        let m = r.model().unwrap();
        let warm = m.opt.disableflags & disable::WARMSTART == 0;
        let mut worst = [0.0_f64; 3];
        let mut exact = 0;
        let mut scratch = SolverScratch::default();
        let states = r.states().unwrap();
        for row in 0..states {
            let mut d = constrained(&r, &m, row);
            solve(
                &m,
                &d.state,
                &d.inertia,
                &d.con,
                &mut d.efc,
                &d.island,
                &mut d.acc,
                &mut d.solver,
                &mut scratch,
            );
            let theirs = r.forward("solver_niter", row).unwrap();
            for (k, &n) in d.solver.solver_niter.iter().enumerate().take(theirs.len()) {
                assert_eq!(f64::from(n), theirs[k], "{path:?} state {row} island {k}");
                iterations += n;
            }
            // Dual states on the surface of a cone are decided by rounding, and a cold start sets none.
            if d.efc.nefc > 0
                && m.opt.solver != Solver::Pgs.code()
                && warm
                && m.opt.noslip_iterations * m.opt.cone == 0
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
                assert!(e < SOLUTION, "{path:?} {row} {name} {e}");
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
    for (path, r) in recorded().unwrap() {
        let mut m = r.model().unwrap();
        for row in 0..r.states().unwrap() {
            let solved = [Jacobian::Dense, Jacobian::Sparse].map(|storage| {
                m.opt.jacobian = storage.code();
                let mut d = constrained(&r, &m, row);
                let mut scratch = SolverScratch::default();
                let Data { state, inertia, con, efc, island, acc, solver, .. } = &mut d;
                solve(&m, state, inertia, con, efc, island, acc, solver, &mut scratch);
                d.acc
            });
            let e = difference(&solved[0].qacc, &solved[1].qacc);
            assert!(e < STORAGE, "{path:?} {row} {e}");
            let change: Vec<f64> =
                solved[0].qacc.iter().zip(&solved[0].qacc_smooth).map(|(a, b)| a - b).collect();
            let mut force = vec![0.0; m.nv];
            mul_inertia_matrix(&m, &r.forward("M", row).unwrap(), &change, &mut force);
            let e = difference(&force, &solved[0].qfrc_constraint);
            assert!(e < STATIONARY, "{path:?} {row} {e}");
            moved = change.iter().fold(moved, |a, x| a.max(x.abs()));
        }
    }
    assert!(moved > 1.0);
}
