//! The own models.

use robohive::mjcf::Loader;
use robohive::physics::Model;

/// Every model of our own, with its name.
pub fn assets() -> Vec<(String, Model)> {
    let load = |path| Loader::default().files(assets::Own).load(path).unwrap().model;
    let found: Vec<_> = assets::models().map(|(name, path)| (name.to_owned(), load(path))).collect();
    assert!(found.len() >= 9, "{}", found.len());
    found
}
