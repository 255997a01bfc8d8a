//! The models of this project, and what is compared of compiled ones.

use physics::Model;
use physics::table::Slice;
pub use robohive_assets::Own;

/// Paths of all own models, for a loader with the files [`Own`].
pub fn assets() -> Vec<&'static str> {
    let found: Vec<_> = robohive_assets::models().map(|(_, path)| path).collect();
    assert!(found.len() > 5, "{found:?}");
    found
}

/// The scalars of every array as bits.
pub fn bits(m: &Model) -> Vec<(&'static str, Vec<u64>)> {
    let mut all = Vec::new();
    m.visit(&mut |name, _, values| {
        let bits = match values {
            Slice::F64(x) => x.iter().map(|x| x.to_bits()).collect(),
            Slice::F32(x) => x.iter().map(|x| u64::from(x.to_bits())).collect(),
            Slice::I64(x) => x.iter().map(|&x| x as u64).collect(),
            other => other.to_f64().iter().map(|x| x.to_bits()).collect(),
        };
        all.push((name, bits));
    });
    all
}
