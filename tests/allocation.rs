//! Steps, resets, snapshots, views and overwriting a model allocate no memory once their buffers have grown: heap traffic would make their
//! duration unpredictable.

use robohive::physics::{Data, Model, Snapshot, step};
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
fn trot(i: usize, m: &mut Model, d: &mut Data) {
    for (k, motor) in m.actuators().enumerate() {
        d.actuator_mut(motor).set_ctrl(0.8 * (0.02 * i as f64 * (1.0 + 0.1 * k as f64)).sin());
    }
    assert!(m.sensors().flat_map(|sensor| d.sensor(sensor).data()).all(|x| x.is_finite()));
}

/// One passage from the saved start; the number of steps at which the number of contacts changed.
fn pass(m: &mut Model, d: &mut Data, start: &mut Snapshot, drive: Drive) -> usize {
    match m.nkey {
        0 => d.reset(m),
        _ => d.reset_to_key(m, 0).unwrap(),
    }
    d.restore(start).unwrap();
    d.save(start);
    let mut changes = 0;
    for i in 0..PASSAGE {
        let before = d.con.contact.len();
        drive(i, m, d);
        step(m, d).unwrap();
        changes += usize::from(d.con.contact.len() != before);
    }
    changes
}

/// A reset that writes into the model, as tasks do that place objects.
fn place(m: &mut Model, x: f64) {
    m.overwrite(|m| {
        let body = m.nbody - 1;
        m.body_pos[body] = [x, 0.0, 1.0];
        m.geom_size[1][0] = 0.1 + x;
        m.geom_rgba[1][0] = 0.5;
    })
    .unwrap();
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
        let mut data = Data::new(&model);
        let mut start = Snapshot::default();
        data.save(&mut start);
        let changes = pass(&mut model, &mut data, &mut start, drive);
        assert!(changes > 100, "{name}: contacts came and went only {changes} times");
        let region = Region::new(HEAP);
        for _ in 0..REPEATS {
            assert_eq!(pass(&mut model, &mut data, &mut start, drive), changes);
        }
        let stats = region.change();
        assert_eq!((stats.allocations, stats.reallocations), (0, 0), "{name}");
        let mut own = model.clone();
        place(&mut own, 0.05);
        let region = Region::new(HEAP);
        (0..REPEATS).for_each(|i| place(&mut own, 0.01 * i as f64));
        let stats = region.change();
        assert_eq!((stats.allocations, stats.reallocations), (0, 0), "{name}: overwriting");
    }
}
