//! A restored snapshot continues as the original did, to the last bit.

mod models;
mod state;

use models::assets;
use robohive::physics::data::{ForeignSnapshot, NoKeyframe};
use robohive::physics::model::Integrator;
use robohive::physics::{Data, Model, Snapshot, step};
use state::bits;

const STEPS: usize = 200;

/// Controls that change from step to step, so that delay buffers matter.
fn drive(m: &Model, d: &mut Data) {
    let time = d.time();
    for (k, (ctrl, [low, high])) in d.state.ctrl.iter_mut().zip(&m.actuator_ctrlrange).enumerate() {
        let swing = (31.0 * time + k as f64).sin();
        *ctrl = if low < high { low + (high - low) * (0.5 + 0.4 * swing) } else { 0.3 * swing };
    }
}

fn run(m: &Model, d: &mut Data) {
    for _ in 0..STEPS {
        drive(m, d);
        step(m, d).unwrap();
    }
}

/// Everything that 200 steps leave behind, to the bit. Tendons that wrap less than before leave old points behind, and without
/// constraints there are no islands, whose arrays then keep what they had.
fn outcome(m: &Model, d: &Data) -> Vec<(&'static str, Vec<u64>)> {
    let mut arrays = Vec::new();
    d.visit(m, &mut |name, _, values| {
        arrays.push((name, values.to_f64().into_iter().map(f64::to_bits).collect()))
    });
    let islands = |name: &str| name.contains("island") || name.starts_with("map_");
    arrays.retain(|(name, _)| !["wrap_obj", "wrap_xpos"].contains(name));
    arrays.retain(|(name, _)| d.island.nisland > 0 || !islands(name));
    arrays
}

#[test]
fn restored_simulations_repeat_themselves() {
    let mut histories = 0;
    for (name, m) in assets() {
        for integrator in [m.opt.integrator, Integrator::Rk4, Integrator::Implicit] {
            let mut m = m.clone();
            m.options_mut().integrator = integrator;
            histories += m.nhistory;
            let mut d = Data::new(&m);
            if m.nkey > 0 {
                d.reset_to_key(&m, 0).unwrap();
            }
            run(&m, &mut d);
            let mut snapshot = Snapshot::default();
            d.save(&mut snapshot);
            let saved = (snapshot.time(), d.state.qpos.clone());
            run(&m, &mut d);
            let there = outcome(&m, &d);
            assert_ne!(saved.1, d.state.qpos, "{name}: nothing moves");
            // Into the same data, and into data that have another past.
            let mut other = Data::new(&m);
            other.state.qvel.fill(0.1);
            step(&m, &mut other).unwrap();
            for mut d in [d, other] {
                d.restore(&snapshot).unwrap();
                assert_eq!((d.time(), &d.state.qpos), (saved.0, &saved.1));
                run(&m, &mut d);
                let here = outcome(&m, &d);
                let differ: Vec<_> =
                    here.iter().zip(&there).filter(|(a, b)| a != b).map(|(a, _)| a.0).collect();
                assert!(differ.is_empty(), "{name}, {integrator:?}: {differ:?}");
            }
        }
    }
    assert!(histories > 0, "no model has delays");
}

#[test]
fn a_snapshot_of_another_model_is_refused() {
    let models: Vec<_> = assets().into_iter().take(2).collect();
    let [(_, first), (_, second)] = &models[..] else { panic!("two models") };
    let (from, mut to) = (Data::new(first), Data::new(second));
    let mut snapshot = Snapshot::default();
    let before = bits(second, &to);
    assert_eq!(to.restore(&snapshot), Err(ForeignSnapshot));
    from.save(&mut snapshot);
    assert_eq!(to.restore(&snapshot), Err(ForeignSnapshot));
    assert!(bits(second, &to) == before);
}

#[test]
fn a_keyframe_that_does_not_exist_is_refused() {
    let (_, m) = assets().into_iter().find(|(_, m)| m.nkey > 0).unwrap();
    let mut d = Data::new(&m);
    (0..10).for_each(|_| step(&m, &mut d).unwrap());
    let (before, key) = (bits(&m, &d), m.nkey);
    assert_eq!(d.reset_to_key(&m, key), Err(NoKeyframe { key, keyframes: m.nkey }));
    assert!(bits(&m, &d) == before);
    d.reset_to_key(&m, key - 1).unwrap();
    assert_eq!((d.time(), &d.state.qpos[..]), (m.key_time[key - 1], &m.key_qpos[(key - 1) * m.nq..]));
}
