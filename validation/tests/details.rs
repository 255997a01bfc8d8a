//! What MuJoCo computes to the last bit where rounding shows: sums in the order of sparse matrices, boxes that meet
//! exactly, forces of fluids, and resets of runs that diverge. The positions of these models need no trigonometric
//! function, so that the numbers are the same from every C library.

use robohive_validation::bits::count_bits;
use robohive_validation::motion::compare_rollout;
use robohive_validation::reference::Reference;
use std::path::Path;

fn load(name: &str) -> (physics::Model, Reference) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("reference/details");
    let model = mjcf::load(folder.join(name).with_extension("xml")).unwrap().model;
    (model, Reference::open(&folder.join(name).with_extension("npz")).unwrap())
}

/// Compiled arrays, stages and forward passes of `name` are MuJoCo's to the last bit.
#[track_caller]
fn is_equal(name: &str) {
    let (m, reference) = load(name);
    let row = count_bits(name, &m, &reference).unwrap();
    assert_eq!(row.differences(), "");
}

#[test]
fn many_bodies_are_solved_with_the_sums_of_sparse_matrices() {
    let (m, reference) = load("heap");
    assert!(m.is_sparse() && reference.state_row("forward", "nefc", 0).unwrap()[0] > 30.0);
    is_equal("heap");
    is_equal("heap_elliptic");
}

#[test]
fn dual_problems_are_solved_with_the_sums_of_compressed_rows() {
    let (m, reference) = load("heap_dual");
    assert!(m.is_sparse() && reference.state_row("forward", "nefc", 0).unwrap()[0] > 30.0);
    is_equal("heap_dual");
}

#[test]
fn trees_that_sleep_add_nothing_to_the_momentum_of_the_world() {
    let (m, _) = load("asleep");
    let mut d = physics::Data::new(&m);
    assert_eq!(d.state.tree_asleep.iter().map(|&tree| tree >= 0).collect::<Vec<bool>>(), [true, false]);
    d.reset_to_key(&m, 0).unwrap();
    physics::forward(&m, &mut d).unwrap();
    physics::derive_on_demand(&m, &mut d);
    // The momentum of both about their common centre, which the sleeper is a part of though it is still.
    let apart = physics::math::sub(d.com.subtree_com[2], d.com.subtree_com[0]);
    let own = d.sensor.subtree_linvel[2].map(|v| v * m.body_mass[2]);
    let whole = physics::math::add(d.sensor.subtree_angmom[2], physics::math::cross(apart, own));
    assert!(physics::math::distance(whole, d.sensor.subtree_angmom[0]) > 0.1, "{whole:?}");
    is_equal("asleep");
}

#[test]
fn free_bodies_turn_as_mujoco_turns_them() {
    let (m, reference) = load("spinning");
    is_equal("spinning");
    let report = compare_rollout(&m, &reference).unwrap();
    assert_eq!((report.failure.as_ref(), report.divergence), (None, 0.0));
}

#[test]
fn chains_close_with_the_same_sums() {
    let (m, reference) = load("closed_sparse");
    assert!(m.is_sparse() && reference.state_row("forward", "ne", 0).unwrap() == [15.0]);
    is_equal("closed_sparse");
    is_equal("closed");
}

#[test]
fn fluids_push_and_cylinders_rest_with_the_same_sums() {
    let (_, reference) = load("drag");
    assert!(reference.state_row("forward", "ncon", 0).unwrap()[0] > 4.0);
    is_equal("drag");
}

#[test]
fn boxes_that_meet_exactly_touch_where_they_do_in_mujoco() {
    let (_, reference) = load("touching");
    assert_eq!(reference.state_row("forward", "ncon", 0).unwrap(), [4.0]);
    is_equal("touching");
}

#[test]
fn tactile_sensors_read_the_same_depths_and_speeds() {
    let (m, reference) = load("tactile");
    let readings = reference.state_row("forward", "sensordata", 0).unwrap();
    let felt = |row: usize| readings[54 * row..54 * (row + 1)].iter().filter(|x| **x > 0.0).count();
    assert_eq!((m.nsensordata, [felt(0), felt(1), felt(2)]), (450, [16, 16, 16]));
    is_equal("tactile");
}

#[test]
fn runs_that_diverge_are_reset_at_the_same_steps() {
    let (m, reference) = load("diverging");
    let report = compare_rollout(&m, &reference).unwrap();
    assert_eq!((report.failure.as_ref(), report.divergence), (None, 0.0));
    let mut d = physics::Data::new(&m);
    d.autoreset = true;
    let end = (0..report.steps).map(|_| physics::step(&m, &mut d)).collect::<Result<Vec<()>, _>>();
    assert_eq!((end.is_ok(), d.warnings.bad_qacc.count, d.warnings.resets()), (true, 6, 6));
    d.autoreset = false;
    let failed = (0..report.steps).find_map(|_| physics::step(&m, &mut d).err());
    assert!(matches!(failed, Some(physics::StepError::BadQacc(_))), "{failed:?}");
}
