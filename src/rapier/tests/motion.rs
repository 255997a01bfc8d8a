//! Motion without contacts under rapier beside our own pipeline.

use physics::model::Integrator;
use physics::{Data, Model, Stepper, step};
use robohive_rapier::{Options, Rapier};

/// What a hundred steps may differ by, all being rounding: positions pass through rapier's frames, and chaotic motion adds up.
const ROUNDING: f64 = 1e-9;

fn model(bodies: &str) -> Model {
    mjcf::load_str(format!("<mujoco><worldbody>{bodies}</worldbody></mujoco>")).unwrap().model
}

/// Largest difference of positions and velocities over some steps, from a state in motion.
fn difference(m: &Model, steps: usize, options: Options) -> f64 {
    let mut own = Data::new(m);
    for (i, rate) in own.state.qvel.iter_mut().enumerate() {
        *rate = 0.7 + 0.4 * i as f64;
    }
    for (i, control) in own.state.ctrl.iter_mut().enumerate() {
        *control = 0.2 + 0.1 * (i % 5) as f64;
    }
    let mut other = own.clone();
    let mut rapier = Rapier::new(m, options).unwrap();
    let start = own.state.qpos.clone();
    let mut worst = 0.0_f64;
    for _ in 0..steps {
        step(m, &mut own).unwrap();
        rapier.step(m, &mut other).unwrap();
        let pairs =
            own.state.qpos.iter().zip(&other.state.qpos).chain(own.state.qvel.iter().zip(&other.state.qvel));
        worst = pairs.fold(worst, |worst, (a, b)| worst.max((a - b).abs()));
    }
    let moved = start.iter().zip(&other.state.qpos).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(moved > 0.01, "nothing moved");
    assert!((own.time() - other.time()).abs() < 1e-12);
    worst
}

const SKEW: &str = "<body pos='.1 .2 .3' euler='10 20 30'><joint axis='0 1 .3' pos='.1 0 0'/>
    <joint type='slide' axis='1 2 0' damping='1'/><joint axis='1 1 0' stiffness='3' armature='.1' damping='.2'/>
    <geom type='box' pos='.3 .1 0' size='.1 .2 .3'/>
    <body pos='1 0 0' euler='10 20 30'><joint type='ball' pos='.1 .2 .3'/><geom type='box' pos='.3 .1 0' size='.1 .2 .3'/>
    <body><joint axis='-1 0 0' frictionloss='.1'/><geom size='.1' pos='.3 .1 .1'/></body></body></body>";

const FLOATING: &str = "<body><freejoint/><geom type='box' pos='.3 .1 0' size='.1 .2 .3'/>
    <body pos='1 0 0'><joint axis='0 1 0'/><geom type='box' pos='.3 .1 0' size='.1 .2 .3'/></body></body>";

const ALONE: &str = "<body><freejoint/><geom type='box' pos='.3 .1 0' size='.1 .2 .3'/>
    <body pos='.5 0 0' euler='0 30 0'><geom size='.1'/></body></body>";

#[test]
fn joints_of_every_kind_move_as_under_our_pipeline() {
    for (name, bodies) in [
        ("hinge", "<body><joint axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body>"),
        ("skew", SKEW),
        ("floating", FLOATING),
        ("alone", ALONE),
        ("limit", "<body><joint axis='0 1 0' range='-10 20'/><geom size='.1' pos='1 0 0'/></body>"),
        ("ball", "<body><joint type='ball' range='0 30'/><geom size='.1' pos='1 0 0'/></body>"),
    ] {
        let off = difference(&model(bodies), 500, Options::default());
        assert!(off < ROUNDING, "{name}: {off:e}");
    }
}

#[test]
fn every_integrator_but_runge_kutta_is_the_models_own() {
    let mut m = model(SKEW);
    for integrator in [Integrator::Implicit, Integrator::Implicitfast] {
        m.options_mut().integrator = integrator;
        let off = difference(&m, 200, Options::default());
        assert!(off < ROUNDING, "{integrator:?}: {off:e}");
    }
    m.options_mut().integrator = Integrator::Rk4;
    let off = difference(&m, 200, Options::default());
    assert!(off > ROUNDING, "Euler's method stands in: {off:e}");
}

#[test]
fn substeps_are_steps_of_a_shorter_time_step() {
    let m = model(SKEW);
    let mut fine = m.clone();
    fine.options_mut().timestep /= 4.0;
    let (mut own, mut other) = (Data::new(&m), Data::new(&m));
    let mut rapier = Rapier::new(&m, Options::default().with_substeps(4)).unwrap();
    for _ in 0..100 {
        (0..4).for_each(|_| step(&fine, &mut own).unwrap());
        rapier.step(&m, &mut other).unwrap();
    }
    let off = own.state.qpos.iter().zip(&other.state.qpos).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < ROUNDING && other.state.qpos[0].abs() > 0.01, "{off:e}");
}

#[test]
fn muscles_tendons_and_servos_pull_as_under_our_pipeline() {
    for name in ["elbow/elbow.xml", "servos/servos.xml", "delays/delays.xml"] {
        let text = assets::text(name).unwrap();
        let m = mjcf::load_str(text).unwrap().model;
        assert!(m.nu > 0);
        let off = difference(&m, 200, Options::default());
        assert!(off < ROUNDING, "{name}: {off:e}");
    }
}

#[test]
fn what_a_program_writes_is_followed() {
    let m = model("<body><joint axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body>");
    let mut rapier = Rapier::new(&m, Options::default()).unwrap();
    let mut d = Data::new(&m);
    (0..20).for_each(|_| rapier.step(&m, &mut d).unwrap());
    d.state.qpos[0] = 1.0;
    d.state.qvel[0] = 0.0;
    rapier.step(&m, &mut d).unwrap();
    assert!((d.state.qpos[0] - 1.0).abs() < 1e-3);
    let mut heavy = m.clone();
    heavy.edit(|e| e.geom_size[0] = [0.2; 3]).unwrap();
    heavy.options_mut().gravity = [0.0; 3];
    let before = d.state.qvel[0];
    rapier.step(&heavy, &mut d).unwrap();
    assert!((d.state.qvel[0] - before).abs() < 1e-12, "the options were followed");
    heavy.edit(|e| e.geom_adhesion[0] = 3.0).unwrap();
    let refusal = rapier.step(&heavy, &mut d).unwrap_err().to_string();
    assert!(refusal.contains("adhesion under rapier"), "{refusal}");
}

#[test]
fn a_height_field_that_is_edited_is_followed() {
    let text = "<mujoco><asset><hfield name='flat' nrow='2' ncol='2' size='2 2 .5 .1' elevation='0 0 1 1'/></asset><worldbody>
        <geom type='hfield' hfield='flat'/><body pos='0 0 .3'><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
    let mut m = mjcf::load_str(text).unwrap().model;
    let mut rapier = Rapier::new(&m, Options::default()).unwrap();
    let mut d = Data::new(&m);
    rapier.step(&m, &mut d).unwrap();
    let touches = |d: &Data| !d.con.contact.is_empty();
    assert!(touches(&d), "the slope is 0.25 m high under the ball's centre at 0.3 m");
    m.edit(|e| e.hfield_size[0][2] = 0.1).unwrap();
    rapier.step(&m, &mut d).unwrap();
    assert!(!touches(&d), "0.05 m high, it is out of reach");
}

#[test]
fn a_restored_world_moves_to_the_same_bits() {
    let text = assets::text("pile/pile.xml").unwrap();
    let m = mjcf::load_str(text).unwrap().model;
    let mut rapier = Rapier::new(&m, Options::default()).unwrap();
    let mut d = Data::new(&m);
    (0..300).for_each(|_| rapier.step(&m, &mut d).unwrap());
    assert!(!d.con.contact.is_empty());
    let (memory, mut snapshot) = (rapier.save(), physics::Snapshot::default());
    d.save(&mut snapshot);
    (0..50).for_each(|_| rapier.step(&m, &mut d).unwrap());
    let there = d.state.qpos.clone();
    d.restore(&snapshot).unwrap();
    rapier.restore(&memory).unwrap();
    let mut twin = rapier.duplicate();
    let mut also = d.clone();
    (0..50).for_each(|_| rapier.step(&m, &mut d).unwrap());
    (0..50).for_each(|_| twin.step(&m, &mut also).unwrap());
    assert_eq!((&d.state.qpos, &also.state.qpos), (&there, &there));
}
