//! Integrators that are implicit in velocity, beside MuJoCo on the own models.

use physics::model::{Enable, Integrator};
use physics::{Data, Model};
use robohive_validation::compare::{absolute, compare, of_largest};
use robohive_validation::reference::Reference;
use robohive_validation::tolerance::{
    DERIVATIVE, FORWARD_INVERSE, IMPLICIT_ROLLOUT, INVERSE, INVERSE_SLOPE, LINEARISED, OWN_QACC,
    ROLLOUT_ABSOLUTE,
};
use std::path::{Path, PathBuf};

const INTEGRATORS: [(&str, Integrator); 2] =
    [("implicit", Integrator::Implicit), ("implicitfast", Integrator::Implicitfast)];
/// Recorded states at which derivatives were taken.
const STATES: [usize; 3] = [0, 2, 4];

/// Steps from one recorded position to the next.
const EVERY: usize = 5;

/// Names of the own models, each with its recorded model and states, and what was recorded beyond.
fn references() -> Vec<(String, Reference, Reference)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference");
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(folder.join("implicit")).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    let open = |path: &Path| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let own = folder.join("own").join(path.file_name().unwrap());
        (name, Reference::open(&own).unwrap(), Reference::open(path).unwrap())
    };
    files.iter().map(|path| open(path)).collect()
}

fn values(reference: &Reference, name: &str) -> Vec<f64> {
    reference.archive().require(name).unwrap().values.to_f64()
}

/// At the first keyframe, or `qpos0`.
fn start(m: &Model) -> Data {
    let mut d = Data::new(m);
    if m.nkey > 0 {
        d.reset_to_key(m, 0).unwrap();
    }
    d
}

#[test]
fn derivatives_agree() {
    let mut nonzero = 0;
    let (mut derivative, mut acceleration) = (DERIVATIVE.gauge(), OWN_QACC.gauge());
    for (name, own, recorded) in references() {
        let mut m = own.model().unwrap();
        for (label, integrator) in INTEGRATORS {
            m.options_mut().integrator = integrator;
            let theirs = values(&recorded, &format!("{label}.qDeriv"));
            let qvel = values(&recorded, &format!("{label}.qvel"));
            let scale = theirs.iter().fold(f64::MIN_POSITIVE, |s: f64, x| s.max(x.abs()));
            for (k, (row, theirs)) in STATES.into_iter().zip(theirs.chunks_exact(m.nD)).enumerate() {
                let mut d = Data::new(&m);
                own.set_state(&mut d, &m, row).unwrap();
                physics::step(&m, &mut d).unwrap();
                let worst = compare("qDeriv", &d.implicit.qDeriv, theirs, absolute);
                derivative.take(worst.error / scale, format!("{name} {label} state {row}: {worst}"));
                let qvel = &qvel[k * m.nv..(k + 1) * m.nv];
                let worst = compare("qvel", &d.state.qvel, qvel, of_largest);
                acceleration.take(worst.error, format!("{name} {label} state {row}: {worst}"));
                nonzero += theirs.iter().filter(|&&x| x != 0.0).count();
            }
        }
    }
    assert!(nonzero > 1000, "only {nonzero} entries are not zero");
}

/// Follows each rollout for as long as MuJoCo, started 1e-12 away, stays with itself.
#[test]
fn rollouts_agree() {
    let mut rollout = IMPLICIT_ROLLOUT.gauge();
    for (name, own, recorded) in references() {
        let mut m = own.model().unwrap();
        let ctrl = values(&recorded, "ctrl");
        for (label, integrator) in INTEGRATORS {
            m.options_mut().integrator = integrator;
            let (theirs, twin) =
                (values(&recorded, &format!("{label}.qpos")), values(&recorded, &format!("{label}.twin")));
            let rows = twin.iter().take_while(|&&x| x < ROLLOUT_ABSOLUTE).count();
            let mut d = start(&m);
            let (mut worst, mut travel) = (0.0_f64, 0.0_f64);
            for row in 0..rows {
                for step in row * EVERY..(row + 1) * EVERY {
                    d.state.ctrl.copy_from_slice(&ctrl[step * m.nu..(step + 1) * m.nu]);
                    physics::step(&m, &mut d).unwrap();
                }
                for (k, (a, b)) in d.state.qpos.iter().zip(&theirs[row * m.nq..]).enumerate() {
                    worst = worst.max((a - b).abs());
                    travel = travel.max((b - m.qpos0[k]).abs());
                }
            }
            assert!(rows * EVERY >= 30 && travel > 0.01, "{name}: {rows} rows, travel {travel}");
            rollout.take(worst, format!("{name} {label}"));
        }
    }
}

#[test]
fn inverse_dynamics_agree() {
    let mut gauge = INVERSE.gauge();
    for (name, own, recorded) in references() {
        let mut m = own.model().unwrap();
        let qacc = values(&recorded, "inverse.qacc");
        let constraint = values(&recorded, "inverse.qfrc_constraint");
        let discrete = [Integrator::Euler, INTEGRATORS[0].1, INTEGRATORS[1].1]
            .map(|i| (format!("discrete.{i:?}").replace(".I", ".i"), i, Enable::INVDISCRETE));
        let continuous = ("inverse.qfrc_inverse".to_owned(), Integrator::Euler, Enable::NONE);
        let flags = m.opt.enableflags;
        for (label, integrator, flag) in discrete.into_iter().chain([continuous]) {
            (m.options_mut().integrator, m.options_mut().enableflags) = (integrator, flags | flag);
            let theirs = values(&recorded, &label);
            for (k, row) in STATES.into_iter().enumerate() {
                let at = k * m.nv..(k + 1) * m.nv;
                let mut d = Data::new(&m);
                own.set_state(&mut d, &m, row).unwrap();
                d.acc.qacc.copy_from_slice(&qacc[at.clone()]);
                physics::inverse(&m, &mut d).unwrap();
                let worst =
                    compare("qfrc_inverse", &d.implicit.qfrc_inverse, &theirs[at.clone()], of_largest);
                assert!(worst.theirs != 0.0, "{name} {label} state {row}: {worst}");
                gauge.take(worst.error, format!("{name} {label} state {row}: {worst}"));
                assert_eq!(d.acc.qacc, qacc[at.clone()], "the given acceleration has changed");
                if flag == Enable::NONE {
                    let worst =
                        compare("qfrc_constraint", &d.acc.qfrc_constraint, &constraint[at], of_largest);
                    gauge.take(worst.error, format!("{name} state {row}: {worst}"));
                }
            }
        }
    }
}

#[test]
fn transition_matrices_agree() {
    let mut compared = 0;
    let mut gauge = LINEARISED.gauge();
    for (name, own, recorded) in references() {
        let mut m = own.model().unwrap();
        for integrator in [Integrator::Euler, INTEGRATORS[0].1, INTEGRATORS[1].1] {
            m.options_mut().integrator = integrator;
            let label = format!("transition.{integrator:?}").replace(".I", ".i");
            if recorded.archive().require(&format!("{label}.A")).is_err() {
                continue;
            }
            let mut d = Data::new(&m);
            own.set_state(&mut d, &m, STATES[0]).unwrap();
            let before = d.state.clone();
            let ours = physics::pipeline::transition::transition(&m, &mut d, 1e-6, true).unwrap();
            assert_eq!(before.qpos, d.state.qpos);
            for (field, ours) in [("A", ours.a), ("B", ours.b), ("C", ours.c), ("D", ours.d)] {
                let mut theirs = values(&recorded, &format!("{label}.{field}"));
                if field == "D" {
                    // Upstream subtracts in the wrong order when it centres this one matrix.
                    theirs.iter_mut().for_each(|x| *x = -*x);
                }
                let worst = compare(field, &ours, &theirs, of_largest);
                gauge.take(worst.error, format!("{name} {label}: {worst}"));
                compared += theirs.iter().filter(|&&x| x != 0.0).count();
            }
        }
    }
    assert!(compared > 1000);
}

#[test]
fn slopes_of_inverse_dynamics_agree() {
    let mut compared = 0;
    let mut gauge = INVERSE_SLOPE.gauge();
    for (name, own, recorded) in references() {
        let m = own.model().unwrap();
        if recorded.archive().require("slope.position").is_err() {
            continue;
        }
        let mut d = Data::new(&m);
        own.set_state(&mut d, &m, STATES[0]).unwrap();
        d.acc.qacc.copy_from_slice(&values(&recorded, "inverse.qacc")[..m.nv]);
        let ours = physics::pipeline::transition::inverse_slope(&m, &mut d, 1e-6).unwrap();
        for (field, ours) in
            [("position", ours.position), ("velocity", ours.velocity), ("acceleration", ours.acceleration)]
        {
            let theirs = values(&recorded, &format!("slope.{field}"));
            let worst = compare(field, &ours, &theirs, of_largest);
            gauge.take(worst.error, format!("{name}: {worst}"));
            compared += theirs.iter().filter(|&&x| x != 0.0).count();
        }
    }
    assert!(compared > 500);
}

/// Forward and inverse dynamics differ by no more than the solver's tolerance leaves.
#[test]
fn inverse_undoes_forward() {
    let mut rows = 0;
    let mut gauge = FORWARD_INVERSE.gauge();
    for (name, own, _) in references() {
        let mut m = own.model().unwrap();
        m.options_mut().enableflags |= Enable::FWDINV;
        for row in STATES {
            let mut d = Data::new(&m);
            own.set_state(&mut d, &m, row).unwrap();
            d.solver.solver_fwdinv = [f64::NAN; 2];
            physics::step(&m, &mut d).unwrap();
            let largest = d.acc.qfrc_smooth.iter().fold(0.0, |s: f64, x| s.max(x.abs()));
            for difference in d.solver.solver_fwdinv {
                gauge.take(difference / largest, format!("{name} state {row}"));
            }
            rows += d.efc.nefc;
        }
    }
    assert!(rows > 300, "only {rows} constraint rows");
}
