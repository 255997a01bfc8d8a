//! Models written as MJCF and read again: the same arrays, and a text that stays.

use physics::Model;
use physics::table::Slice;
use robohive_mjcf::Loader;
use robohive_mjcf::files::{Disk, Overlay};

fn assets() -> Vec<String> {
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
fn bits(m: &Model) -> Vec<(&'static str, Vec<u64>)> {
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

fn assert_same(a: &Model, b: &Model, what: &str) {
    for ((name, a), (_, b)) in bits(a).iter().zip(&bits(b)) {
        assert!(a == b, "{what}: {name} differs");
    }
    assert_eq!((&a.opt, &a.stat, &a.vis, &a.name), (&b.opt, &b.stat, &b.vis, &b.name), "{what}");
}

#[test]
fn own_models_come_back_bit_for_bit_and_their_texts_stay() {
    for path in assets() {
        let parsed = Loader::default().parse(&path).unwrap();
        let mut spec = parsed.spec.clone();
        let model = Loader::default().compile(parsed).unwrap().model;
        let (dir, _) = path.rsplit_once('/').unwrap();
        spec.settle_keys(&model);
        spec.place_assets(dir).unwrap();
        let text = spec.to_xml().unwrap();
        let place = format!("{dir}/written.xml");
        let loader = Loader::default().files(Overlay::new(Disk::everywhere(), &place, text.as_bytes()));
        let again = loader.parse(&place).unwrap_or_else(|e| panic!("{path}: {e}\n{text}"));
        assert_eq!(again.spec.to_xml().unwrap(), text, "{path}");
        assert_same(&loader.compile(again).unwrap().model, &model, &path);
    }
}
