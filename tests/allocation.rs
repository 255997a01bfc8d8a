//! Steps, resets, snapshots, views and overwriting a model allocate no memory once their buffers have grown: heap traffic would make their
//! duration unpredictable. Deformable bodies and signed distances are no exception.

use robohive::physics::{Data, Model, Snapshot, step};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static HEAP: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Steps of one passage; the first lets the buffers grow, the same passage is then repeated.
const PASSAGE: usize = 1000;
const REPEATS: usize = 10;
/// The same for models whose steps take long.
const SHORT_PASSAGE: usize = 150;
const FEW_REPEATS: usize = 2;

/// A ring with a field falls on a plane, and a wedge, a ball and a cloth fall on the ring.
const RING: &str = r#"<mujoco>
  <option sdf_initpoints="10" sdf_iterations="5"/>
  <extension><plugin plugin="mujoco.sdf.torus"><instance name="ring">
    <config key="radius1" value="0.3"/><config key="radius2" value="0.1"/>
  </instance></plugin></extension>
  <asset>
    <mesh name="ring"><plugin instance="ring"/></mesh>
    <mesh name="wedge" vertex="0 0 0  .2 0 0  0 .2 0  0 0 .2  .1 .1 .1"/>
  </asset>
  <worldbody>
    <geom type="plane" size="2 2 1"/>
    <body pos="0 0 .11"><freejoint/><geom type="sdf" mesh="ring"><plugin instance="ring"/></geom></body>
    <body pos=".25 0 .25"><freejoint/><geom type="mesh" mesh="wedge"/></body>
    <body pos="-.3 .05 .31"><freejoint/><geom size=".09"/></body>
    <body name="holder" pos="0 -.2 .24"><flexcomp name="cloth" type="grid" count="5 5 1" spacing=".1 .1 .1" dim="2" radius=".01" mass=".2">
      <edge equality="true"/><contact selfcollide="none" internal="false"/></flexcomp></body>
  </worldbody>
</mujoco>"#;

/// Nothing but gravity.
fn fall(_: usize, _: &mut Model, _: &mut Data) {}

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
fn pass(m: &mut Model, d: &mut Data, start: &mut Snapshot, steps: usize, drive: Drive) -> usize {
    match m.nkey {
        0 => d.reset(m),
        _ => d.reset_to_key(m, 0).unwrap(),
    }
    d.restore(start).unwrap();
    d.save(start);
    let mut changes = 0;
    for i in 0..steps {
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

fn asset(name: &str) -> Model {
    let path = format!("{}/assets/{name}.xml", env!("CARGO_MANIFEST_DIR"));
    robohive::mjcf::load(&path).unwrap().model
}

/// One test, since others in this process would be counted too.
#[test]
fn steps_do_not_allocate() {
    let models: [(_, Drive); 2] = [("pile/pile", tumble), ("quadruped/quadruped", trot)];
    for (name, drive) in models {
        let mut model = asset(name);
        repeat(name, &mut model, [PASSAGE, REPEATS, 100], drive);
        let mut own = model.clone();
        place(&mut own, 0.05);
        let region = Region::new(HEAP);
        (0..REPEATS).for_each(|i| place(&mut own, 0.01 * i as f64));
        let stats = region.change();
        assert_eq!((stats.allocations, stats.reallocations), (0, 0), "{name}: overwriting");
    }
    let ring = robohive::mjcf::load_str(RING).unwrap_or_else(|e| panic!("{e}")).model;
    for (name, mut model) in
        [("ring", ring), ("drape", asset("drape/drape")), ("grasp", asset("grasp/grasp"))]
    {
        repeat(name, &mut model, [SHORT_PASSAGE, FEW_REPEATS, 5], fall);
    }
}

/// Repeats a passage, in which contacts come and go at no fewer than `changes` steps, and counts allocations.
fn repeat(name: &str, model: &mut Model, [steps, repeats, changes]: [usize; 3], drive: Drive) {
    let mut data = Data::new(model);
    let mut start = Snapshot::default();
    data.save(&mut start);
    // The first passage begins without the contacts that the others find from the one before.
    pass(model, &mut data, &mut start, steps, drive);
    let changed = pass(model, &mut data, &mut start, steps, drive);
    assert!(changed > changes, "{name}: contacts came and went only {changed} times");
    let region = Region::new(HEAP);
    for _ in 0..repeats {
        assert_eq!(pass(model, &mut data, &mut start, steps, drive), changed);
    }
    let stats = region.change();
    assert_eq!((stats.allocations, stats.reallocations), (0, 0), "{name}");
}
