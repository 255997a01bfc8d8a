//! What a step may cost, and what it refuses: contacts and rows are counted before they are stored, and a step whose
//! result is not finite fails.

use robohive::mjcf::load_str;
use robohive::physics::data::{Demand, StepBudget};
use robohive::physics::{Data, Model, StepError, forward, step};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::sync::{Mutex, MutexGuard, PoisonError};

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// One test runs at a time: all share the heap of the process.
fn alone() -> MutexGuard<'static, ()> {
    static RUNNING: Mutex<()> = Mutex::new(());
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

fn model(text: &str) -> Model {
    load_str(text).unwrap_or_else(|found| panic!("{found}")).model
}

/// Spheres that all overlap.
fn heap_of_spheres(count: usize, option: &str) -> Model {
    let body = "<body><freejoint/><geom size='1'/></body>";
    let world = format!("<worldbody><replicate count='{count}'>{body}</replicate></worldbody>");
    model(&format!("<mujoco>{option}{world}</mujoco>"))
}

/// The error of a step within `budget` bytes, and the bytes that the step allocated in sum.
fn refused(m: &Model, budget: usize) -> (StepError, usize) {
    let mut d = Data::new(m);
    d.budget = StepBudget { bytes: budget };
    let region = Region::new(HEAP);
    let error = step(m, &mut d).expect_err("the step was made");
    (error, region.change().bytes_allocated)
}

#[test]
fn rows_beyond_the_budget_are_refused_before_they_are_stored() {
    let _alone = alone();
    let m = heap_of_spheres(1500, "");
    let (error, bytes) = refused(&m, StepBudget::default().bytes);
    let StepError::OverBudget(over) = &error else { panic!("{error}") };
    assert_eq!((over.demand, over.contacts), (Demand::Rows, 1500 * 1499 / 2));
    assert!(over.bytes > over.budget && over.count >= 4 * over.contacts, "{over:?}");
    assert!(error.to_string().contains("raise `budget` of the `Data`"), "{error}");
    assert!(bytes < over.budget, "{bytes} bytes");
}

#[test]
fn contacts_and_pairs_beyond_the_budget_are_refused_before_they_are_stored() {
    let _alone = alone();
    let m = heap_of_spheres(300, "");
    let geoms = "<replicate count='1000'><geom size='1'/></replicate>";
    let bodies = format!("<body><freejoint/>{geoms}</body>").repeat(2);
    let crowd = model(&format!("<mujoco><worldbody>{bodies}</worldbody></mujoco>"));
    let cases = [
        (&m, 4_000_000, Demand::Contacts),
        (&m, 100_000, Demand::BodyPairs),
        (&crowd, 400_000, Demand::GeomPairs),
    ];
    for (m, budget, demand) in cases {
        let (error, bytes) = refused(m, budget);
        let StepError::OverBudget(over) = &error else { panic!("{error}") };
        assert_eq!((over.demand, over.budget), (demand, budget), "{error}");
        // Working memory of other stages does not depend on contacts.
        assert!(bytes < budget + 3_000_000, "{demand:?}: {bytes} bytes");
    }
}

/// The dual solvers keep a square matrix of the rows.
#[test]
fn matrices_of_the_solver_count() {
    let _alone = alone();
    let budget = StepBudget { bytes: 60_000_000 };
    let outcome = |option: &str| {
        let m = heap_of_spheres(45, option);
        let mut d = Data::new(&m);
        d.budget = budget;
        step(&m, &mut d)
    };
    assert_eq!(outcome(""), Ok(()));
    for option in ["<option solver='PGS'/>", "<option noslip_iterations='1'/>"] {
        let error = outcome(option).expect_err("the step was made");
        assert!(matches!(&error, StepError::OverBudget(over) if over.demand == Demand::Rows), "{error}");
    }
}

#[test]
fn a_raised_budget_lets_the_step_pass_and_changes_nothing() {
    let _alone = alone();
    let m = heap_of_spheres(30, "");
    let (mut small, mut large) = (Data::new(&m), Data::new(&m));
    small.budget.bytes = 100_000;
    assert!(matches!(step(&m, &mut small), Err(StepError::OverBudget(_))));
    assert_eq!(small.state.qpos, m.qpos0);
    small.budget.bytes = 100_000_000;
    step(&m, &mut small).unwrap();
    step(&m, &mut large).unwrap();
    assert_ne!(small.state.qpos, m.qpos0);
    assert_eq!(small.state.qpos, large.state.qpos);
}

/// The last step of a simulation has none after it that could find the bad state.
#[test]
fn a_step_that_diverges_fails_itself() {
    let _alone = alone();
    let m = model(
        "<mujoco><option timestep='1e-3'/><worldbody><body><joint name='j' type='slide'/><geom size='1'/></body>
        </worldbody><actuator><general joint='j' dyntype='integrator' gainprm='0'/></actuator></mujoco>",
    );
    let fresh = || Data::new(&m);
    let mut d = fresh();
    d.state.qvel[0] = 9.9995e9;
    d.state.qfrc_applied[0] = 4e13;
    let error = step(&m, &mut d).expect_err("velocity");
    assert!(matches!(&error, StepError::BadQvel(bad) if bad.index == 0), "{error}");
    assert_eq!(step(&m, &mut d), Err(error), "the next step says the same");

    let mut d = fresh();
    d.state.qpos[0] = 1e10;
    d.state.qvel[0] = 1e9;
    let error = step(&m, &mut d).expect_err("position");
    assert!(matches!(&error, StepError::BadQpos(bad) if bad.index == 0), "{error}");

    let mut d = fresh();
    d.state.act[0] = f64::INFINITY;
    let error = step(&m, &mut d).expect_err("activation");
    assert!(matches!(&error, StepError::BadAct(_) | StepError::BadQacc(_)), "{error}");
}

#[test]
fn steps_of_no_time_are_refused() {
    let _alone = alone();
    let mut m = heap_of_spheres(1, "");
    for timestep in [0.0, -0.002, f64::NAN, f64::INFINITY] {
        m.options_mut().timestep = timestep;
        let mut d = Data::new(&m);
        let error = step(&m, &mut d).expect_err("the step was made");
        assert!(matches!(error, StepError::BadTimestep(_)), "{error}");
        assert_eq!(forward(&m, &mut d), Ok(()));
    }
}
