//! Models and environments in a page, for JavaScript: [`Files`] that a person dropped or a script fetched become a
//! [`Simulation`], which is stepped, drawn and touched. Motion and pictures are those of every other build, bit for bit.
//!
//! | part | what it does |
//! |---|---|
//! | `files` | files and archives in memory, within limits, and which of them are models |
//! | `simulation` | a session, its picture, and what gestures do |
//! | `environment` | a session with an environment: actions, rewards, observations |
//! | `lists` | numbers and ranges of controls, sensors, cameras and switches |
//! | `names` | elements by name, arrays by MuJoCo's names |
//! | `state` | inputs written, keyframes, states saved and restored |
//! | `recording`, `recorded` | every step as a row of a numpy archive |
//! | `replay` | such rows shown again, two trajectories beside each other |
//!
//! Functions that JavaScript calls throw an `Error` whose message says what is wrong and where.

mod environment;
mod files;
mod lists;
mod names;
mod recorded;
mod recording;
mod replay;
mod simulation;
mod state;

pub use files::Files;
pub use replay::replay;
pub use simulation::Simulation;

use wasm_bindgen::prelude::wasm_bindgen;

/// Names of the models of our own, in `Simulation.own`.
#[wasm_bindgen(js_name = ownModels)]
pub fn own_models() -> Vec<String> {
    viewer::own_models().map(|(name, _)| name.to_owned()).collect()
}

/// Ids of the environments of our own, in `Simulation.environment`.
#[wasm_bindgen(js_name = ownEnvironments)]
pub fn own_environments() -> Vec<String> {
    let specs = env::Registry::builtin().specs().iter();
    specs.filter(|spec| spec.id.starts_with("hive/")).map(|spec| spec.id.clone()).collect()
}
