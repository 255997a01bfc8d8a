//! A batch steps every environment as if it were alone, for every number of threads.

mod state;

use robohive::physics::model::Draft;
use robohive::physics::{Batch, Data, Model, Snapshot, StepError, step};
use state::bits;
use std::sync::Arc;

const STEPS: usize = 120;

fn load(name: &str) -> Arc<Model> {
    let path = format!("{}/assets/{name}.xml", env!("CARGO_MANIFEST_DIR"));
    robohive::mjcf::load(&path).unwrap().model.into()
}

/// Environments that differ in velocity; every third has a model of its own.
fn diverse(m: &Arc<Model>, threads: usize) -> Batch {
    let mut batch = Batch::new(m.clone(), 7, threads).unwrap();
    for environment in 0..batch.len() {
        for (dof, v) in batch.data_mut()[environment].state.qvel.iter_mut().enumerate() {
            *v = 0.1 * ((environment + 3 * dof) as f64).sin();
        }
        if environment % 3 == 1 {
            let lighter = |m: &mut Draft<'_>| {
                m.opt.gravity[0] = 0.5 * environment as f64;
                m.geom_friction.iter_mut().for_each(|friction| friction[0] *= 0.5);
            };
            batch.edit_model(environment, lighter).unwrap();
        }
    }
    batch
}

#[test]
fn threads_do_not_change_a_bit() {
    for name in ["pile/pile", "quadruped/quadruped"] {
        let m = load(name);
        let mut alone = diverse(&m, 1);
        let alone: Vec<_> = (0..alone.len())
            .map(|environment| {
                let (own, mut d) = (alone.model(environment).clone(), alone.data_mut()[environment].clone());
                (0..STEPS).for_each(|_| step(&own, &mut d).unwrap());
                assert!(d.efc.nefc > 0, "{name}: nothing touches");
                bits(&own, &d)
            })
            .collect();
        assert_ne!(alone[0], alone[1]);
        for threads in [1, 2, 4] {
            let mut batch = diverse(&m, threads);
            batch.step(STEPS / 2).unwrap();
            (0..STEPS / 2).for_each(|_| batch.step(1).unwrap());
            for (environment, d) in batch.data().iter().enumerate() {
                assert!(
                    bits(&m, d) == alone[environment],
                    "{name}: environment {environment}, {threads} threads"
                );
            }
        }
    }
}

#[test]
fn a_model_is_shared_until_it_is_edited() {
    let m = load("pile/pile");
    let batch = diverse(&m, 1);
    for environment in 0..batch.len() {
        assert_eq!(Arc::ptr_eq(batch.model(environment), &m), environment % 3 != 1);
    }
    assert_eq!(m.opt.gravity[0], 0.0);
}

#[test]
fn every_environment_that_failed_is_named_and_the_others_go_on() {
    let m = load("pile/pile");
    for threads in [1, 4] {
        let mut batch = Batch::new(m.clone(), 9, threads).unwrap();
        for bad in [7, 2, 5] {
            batch.data_mut()[bad].state.qpos[1] = f64::NAN;
        }
        let error = batch.step(3).unwrap_err();
        assert!(error.failures.iter().map(|failure| failure.environment).eq([2, 5, 7]));
        let named = |failure: &StepError| matches!(failure, StepError::BadQpos(bad) if bad.index == 1);
        assert!(error.failures.iter().all(|failure| named(&failure.error)), "{error:?}");
        let message = error.to_string();
        assert!(message.starts_with("environment 2: qpos[1]"), "{message}");
        assert!(message.ends_with("(2 more failed: 5, 7)"), "{message}");
        for (environment, d) in batch.data().iter().enumerate() {
            let steps = if [2, 5, 7].contains(&environment) { 0.0 } else { 3.0 };
            assert!((d.time() - steps * m.opt.timestep).abs() < 1e-15, "environment {environment}");
        }
    }
}

/// Models are shared by threads; data and batches go from one to another.
#[test]
fn models_and_data_go_to_other_threads() {
    fn shared<T: Send + Sync>(value: T) -> T {
        value
    }
    let model = shared(load("pile/pile"));
    let (data, snapshot) = (shared(Data::new(&model)), shared(Snapshot::default()));
    let batch = shared(Batch::new(model, 2, 1).unwrap());
    let time = std::thread::scope(|scope| {
        let thread = scope.spawn(|| {
            let (mut data, mut snapshot) = (data, snapshot);
            step(batch.model(0), &mut data).unwrap();
            data.save(&mut snapshot);
            snapshot.time()
        });
        thread.join().unwrap()
    });
    assert_eq!(time, batch.model(1).opt.timestep);
}

#[test]
fn payloads_and_errors_are_the_callers_own() {
    #[derive(Debug, PartialEq)]
    struct Tired(u32);
    let names = ["left", "middle", "right"].map(String::from).to_vec();
    let mut batch = Batch::with_payloads(load("pile/pile"), names, 2).unwrap();
    let result = batch.run(|env| {
        step(env.model, env.data).unwrap();
        env.payload.push_str(&format!(" {}", env.index));
        if env.index == 1 { Err(Tired(env.payload.len() as u32)) } else { Ok(()) }
    });
    let failures = result.unwrap_err().failures;
    assert_eq!((failures.len(), failures[0].environment, &failures[0].error), (1, 1, &Tired(8)));
    assert_eq!(batch.payloads(), ["left 0", "middle 1", "right 2"]);
}

#[test]
fn some_environments_are_stepped_without_the_others() {
    let m = load("pile/pile");
    let mut whole = diverse(&m, 3);
    let mut parts = diverse(&m, 3);
    whole.step(20).unwrap();
    let mask: Vec<bool> = (0..parts.len()).map(|environment| environment % 2 == 1).collect();
    parts.masked(&mask).step(20).unwrap();
    for (environment, d) in parts.data().iter().enumerate() {
        let steps = if mask[environment] { 20.0 } else { 0.0 };
        assert!((d.time() - steps * m.opt.timestep).abs() < 1e-12);
    }
    parts.only(&[6, 0, 2, 4, 0]).step(20).unwrap();
    for (environment, (part, all)) in parts.data().iter().zip(whole.data()).enumerate() {
        assert!(bits(&m, part) == bits(&m, all), "environment {environment}");
    }
    parts.only(&[]).step(1).unwrap();
    assert!(bits(&m, &parts.data()[0]) == bits(&m, &whole.data()[0]));
}
