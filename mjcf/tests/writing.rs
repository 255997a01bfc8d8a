//! Models written as MJCF and read again: the same arrays, and a text that stays.

mod own;

use own::{Own, assets, bits};
use physics::Model;
use robohive_mjcf::Loader;
use robohive_mjcf::files::Overlay;

/// Equal but for the paths of asset files, which a text in another place may call otherwise.
fn assert_same(a: &Model, b: &Model, what: &str) {
    for ((name, a), (_, b)) in bits(a).iter().zip(&bits(b)) {
        let names_files = *name == "paths" || name.ends_with("_pathadr");
        assert!(names_files || a == b, "{what}: {name} differs");
    }
    assert_eq!((&a.opt, &a.stat, &a.vis, &a.name), (&b.opt, &b.stat, &b.vis, &b.name), "{what}");
}

#[test]
fn own_models_come_back_bit_for_bit_and_their_texts_stay() {
    for path in assets() {
        let parsed = Loader::default().files(Own).parse(path).unwrap();
        let mut spec = parsed.spec.clone();
        let model = Loader::default().files(Own).compile(parsed).unwrap().model;
        let (dir, _) = path.rsplit_once('/').unwrap();
        spec.settle_keys(&model);
        spec.place_assets(dir).unwrap();
        let files = spec.asset_files();
        let text = spec.to_xml().unwrap();
        let place = format!("{dir}/written.xml");
        let loader = Loader::default().files(Overlay::new(Own, &place, text.as_bytes()));
        let again = loader.parse(&place).unwrap_or_else(|e| panic!("{path}: {e}\n{text}"));
        assert_eq!(again.spec.to_xml().unwrap(), text, "{path}");
        assert_eq!(again.spec.asset_files(), files, "{path}");
        assert_same(&loader.compile(again).unwrap().model, &model, path);
    }
}
