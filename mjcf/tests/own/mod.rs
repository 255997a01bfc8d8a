//! The models of this project, and what is compared of compiled ones.

use physics::Model;
use physics::table::Slice;

/// Paths of all own models.
pub fn assets() -> Vec<String> {
    let top = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets");
    let folders = std::fs::read_dir(top).unwrap().map(|entry| entry.unwrap().path()).filter(|p| p.is_dir());
    let mut found: Vec<String> = folders
        .flat_map(|folder| std::fs::read_dir(folder).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "xml"))
        .map(|path| path.to_str().unwrap().to_owned())
        .collect();
    found.sort();
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
