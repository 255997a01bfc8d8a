//! A step allocates no memory once its buffers have grown: heap traffic would make its duration unpredictable.

use robohive::physics::{Data, Model, step};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Steps of one passage; the first lets the buffers grow, the same passage is then repeated.
const PASSAGE: usize = 1000;
const REPEATS: usize = 10;

/// Weight swings round: what fell rises, drifts and falls again.
fn tumble(i: usize, m: &mut Model, _: &mut Data) {
    let angle = 0.01 * i as f64;
    m.options_mut().gravity = [2.0 * angle.sin(), 0.0, -9.81 * angle.cos()];
}

/// Every motor swings, each at its own rate.
fn trot(i: usize, _: &mut Model, d: &mut Data) {
    for (k, ctrl) in d.state.ctrl.iter_mut().enumerate() {
        *ctrl = 0.8 * (0.02 * i as f64 * (1.0 + 0.1 * k as f64)).sin();
    }
}

/// One passage from `start`; the number of steps at which the number of contacts changed.
fn pass(m: &mut Model, d: &mut Data, start: &Data, drive: Drive) -> usize {
    d.time = 0.0;
    d.state.qpos.copy_from_slice(&start.state.qpos);
    d.state.qvel.copy_from_slice(&start.state.qvel);
    d.state.qacc_warmstart.copy_from_slice(&start.state.qacc_warmstart);
    let mut changes = 0;
    for i in 0..PASSAGE {
        let before = d.con.contact.len();
        drive(i, m, d);
        step(m, d).unwrap();
        changes += usize::from(d.con.contact.len() != before);
    }
    changes
}

/// What moves a model: the number of the step, the model, its data.
type Drive = fn(usize, &mut Model, &mut Data);

/// One test, since others in this process would be counted too.
#[test]
fn steps_do_not_allocate() {
    let models: [(_, Drive); 2] = [("pile/pile", tumble), ("quadruped/quadruped", trot)];
    for (name, drive) in models {
        let path = format!("{}/assets/{name}.xml", env!("CARGO_MANIFEST_DIR"));
        let mut model = robohive::mjcf::load(&path).unwrap().model;
        let start = Data::new(&model);
        let mut data = Data::new(&model);
        let changes = pass(&mut model, &mut data, &start, drive);
        assert!(changes > 100, "{name}: contacts came and went only {changes} times");
        let region = Region::new(HEAP);
        for _ in 0..REPEATS {
            assert_eq!(pass(&mut model, &mut data, &start, drive), changes);
        }
        let stats = region.change();
        assert_eq!((stats.allocations, stats.reallocations), (0, 0), "{name}");
    }
}
