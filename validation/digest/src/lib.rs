//! Hashes of final states, of pictures and of trainings: one number each, equal on every machine, build and number of threads.
//!
//! The hash of a state takes in every bit of the compiled model and of all that a simulation holds at its end. The models lie in
//! the program, so that it also runs where there is no file system.

mod fnv;
mod models;
mod pictures;
#[cfg(feature = "trainings")]
mod trainings;
#[cfg(target_arch = "wasm32")]
mod web;

use models::{Case, MODELS};
use pictures::SHOTS;

use fnv::Fnv;
use physics::math::ops::sin;
use physics::model::Enable;
use physics::table::Slice;
use physics::{Batch, Model};

/// Steps of every simulation.
pub const STEPS: usize = 1000;
/// Simulations of one model, each under controls of its own.
pub const ENVIRONMENTS: usize = 4;

/// The recorded hashes, lines of a name and 16 hexadecimal digits.
pub const TABLE: &str = include_str!("../digests.txt");

/// A hash by its name, and what computes it on a number of threads.
type Row = (&'static str, Box<dyn Fn(usize) -> Result<u64, String>>);

/// All hashes, in the order of the table: models, pictures, and then trainings, if there are any.
fn rows() -> Vec<Row> {
    let mut rows: Vec<Row> = Vec::new();
    rows.extend(MODELS.iter().map(|case| (case.name, Box::new(|threads| digest(case, threads)) as _)));
    rows.extend(
        SHOTS.iter().map(|shot| (shot.name, Box::new(|threads| pictures::hash_of(shot, threads)) as _)),
    );
    #[cfg(feature = "trainings")]
    rows.extend(
        trainings::TRAININGS
            .iter()
            .map(|training| (training.name, Box::new(|threads| trainings::hash_of(training, threads)) as _)),
    );
    rows
}

/// Names of the hashes, in the order of the table.
pub fn names() -> impl Iterator<Item = &'static str> {
    rows().into_iter().map(|(name, _)| name)
}

/// The hash with this number among the [`names`], computed on `threads` threads.
///
/// # Errors
/// There is no such hash, the model does not load, a state is refused, a picture cannot be drawn, or a training fails.
pub fn hash(number: usize, threads: usize) -> Result<u64, String> {
    let rows = rows();
    let (_, compute) = rows.get(number).ok_or_else(|| format!("there is no hash {number}"))?;
    compute(threads)
}

/// Hash of `case` after [`STEPS`] steps of [`ENVIRONMENTS`] simulations on `threads` threads.
///
/// # Errors
/// The model does not load, a state is refused, or the threads cannot be started; in words.
fn digest(case: &Case, threads: usize) -> Result<u64, String> {
    let model = case.load()?;
    let mut hash = Fnv::default();
    // Hashes of models without a feature are the same in versions that do not know it.
    let unused = unused(&model);
    let mut add = |name: &'static str, shape: Vec<usize>, values: Slice<'_>| {
        if !unused.iter().any(|start| name.starts_with(start)) {
            hash.array(name, &shape, values);
        }
    };
    model.visit(&mut add);
    let mut batch = Batch::new(model, ENVIRONMENTS, threads).map_err(|e| e.to_string())?;
    let model = batch.model(0).clone();
    if model.nkey > 0 {
        for data in batch.data_mut() {
            data.reset_to_key(&model, 0).map_err(|error| format!("{}: {error}", case.name))?;
        }
    }
    batch
        .run(|env| {
            (0..STEPS).try_for_each(|step| {
                set_controls(env.model, &mut env.data.state.ctrl, step, env.index);
                physics::step(env.model, env.data)
            })
        })
        .map_err(|e| format!("{}: {e}", case.name))?;
    for (environment, data) in batch.data().iter().enumerate() {
        data.visit(batch.model(environment), &mut add);
    }
    Ok(hash.finish())
}

/// Beginnings of the names of arrays that came with a feature which the model does not use.
fn unused(m: &Model) -> Vec<&'static str> {
    const FLEXES: &[&str] =
        &["flex", "name_flex", "efm0", "bvh_aabb_dyn", "contact.flex", "contact.elem", "contact.vert"];
    const SKINS: &[&str] = &["skin_", "name_skin"];
    const PLUGINS: &[&str] =
        &["plugin", "name_plugin", "body_plugin", "geom_plugin", "actuator_plugin", "sensor_plugin"];
    const SLEEP: &[&str] = &[
        "tree_a",
        "ntree_awake",
        "body_awake",
        "nbody_awake",
        "parent_awake",
        "nparent_awake",
        "dof_awake",
        "nv_awake",
    ];
    let sleeps = m.opt.enableflags.contains(Enable::SLEEP);
    let features = [(FLEXES, m.nflex > 0), (SKINS, m.nskin > 0), (PLUGINS, m.nplugin > 0), (SLEEP, sleeps)];
    features.into_iter().filter(|(_, used)| !used).flat_map(|(names, _)| names).copied().collect()
}

/// Slow waves within the limits of each control, or within ±1 where it has none.
fn set_controls(m: &Model, ctrl: &mut [f64], step: usize, environment: usize) {
    let time = step as f64 * m.opt.timestep;
    for (i, u) in ctrl.iter_mut().enumerate() {
        let [low, high] = if m.actuator_ctrllimited[i] { m.actuator_ctrlrange[i] } else { [-1.0, 1.0] };
        let phase = 2.0 * i as f64 + environment as f64;
        *u = 0.5 * (low + high) + 0.5 * (high - low) * sin(3.0 * time + phase);
    }
}

/// The recorded hash called `name`.
pub fn recorded(name: &str) -> Option<u64> {
    let row = TABLE.lines().filter_map(|line| line.split_once(' ')).find(|row| row.0 == name)?;
    u64::from_str_radix(row.1.trim(), 16).ok()
}
