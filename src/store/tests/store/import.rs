//! Imports that succeed: every kind of source, merging, licences, and where files are found.

use crate::sources::{MIT, assert_sound, gzip, import, paths, scratch, tar_of, write_folder, xz, zip_of};
use robohive_store::{Digest, Fault, ImportOptions, Licence, Search, Store, StoreError};
use std::fs;

/// A small RoboHive checkout.
const CHECKOUT: [(&str, &str); 8] = [
    ("robohive/envs/arms/reach.xml", "<mujoco/>"),
    ("robohive/envs/arms/reach.config", "{}"),
    ("robohive/envs/arms/reach_v0.py", "import os"),
    ("robohive/envs/myo/data/motion.npz", "PK"),
    ("robohive/simhive/Adroit/LICENSE", MIT),
    ("robohive/simhive/Adroit/mesh/hand.STL", "solid"),
    ("robohive/simhive/scene_sim/floor.png", "PNG"),
    ("setup.py", ""),
];

const VIRTUAL: [&str; 6] = [
    "envs/arms/reach.config",
    "envs/arms/reach.xml",
    "envs/myo/data/motion.npz",
    "simhive/Adroit/LICENSE",
    "simhive/Adroit/mesh/hand.STL",
    "simhive/scene_sim/floor.png",
];

#[test]
fn every_kind_of_source_gives_the_same_store() {
    let folder = scratch("kinds");
    write_folder(&folder.join("checkout"), &CHECKOUT);
    let tar = tar_of(&CHECKOUT);
    let archives = [
        ("plain.tar", tar.clone()),
        ("a.tar.xz", xz(&tar)),
        ("a.tar.gz", gzip(&tar)),
        ("a.whl", zip_of(&CHECKOUT)),
    ];
    for (name, bytes) in &archives {
        fs::write(folder.join(name), bytes).unwrap();
    }
    for name in ["checkout", "plain.tar", "a.tar.xz", "a.tar.gz", "a.whl"] {
        let mut store = Store::open(folder.join(format!("store of {name}"))).unwrap();
        let imported = import(&mut store, &folder.join(name)).unwrap();
        assert_eq!((imported.added, imported.unchanged), (6, 0), "{name}");
        assert_eq!(imported.skipped.kinds, [(".py".to_owned(), 2)].into(), "{name}");
        assert_eq!(paths(&store), VIRTUAL, "{name}");
        assert_sound(&store);
        let content = fs::read_to_string(store.resolve("envs/arms/reach.xml").unwrap()).unwrap();
        assert_eq!(content, "<mujoco/>", "{name}");
        // Relative includes between the roots hold.
        let include =
            store.resolve("envs/arms/reach.xml").unwrap().join("../../../simhive/scene_sim/floor.png");
        assert_eq!(include.components().count(), store.folder().components().count() + 10);
        assert_eq!(fs::read(store.folder().join("tree/simhive/scene_sim/floor.png")).unwrap(), b"PNG");
    }
}

#[test]
fn folders_inside_of_the_roots_are_known() {
    let folder = scratch("inside");
    write_folder(&folder, &CHECKOUT);
    for (inside, expected) in [
        ("robohive/simhive", &VIRTUAL[3..]),
        ("robohive/envs", &VIRTUAL[..3]),
        ("robohive/simhive/Adroit", &VIRTUAL[3..5]),
    ] {
        let mut store = Store::open(folder.join("stores").join(inside.replace('/', "-"))).unwrap();
        import(&mut store, &folder.join(inside)).unwrap();
        assert_eq!(paths(&store), expected, "{inside}");
    }
}

#[test]
fn of_myosuite_only_simhive_counts() {
    let folder = scratch("myosuite");
    let files = [
        ("myosuite/envs/myo/assets/elbow.xml", "<other/>"),
        ("myosuite/simhive/myo_sim/elbow.xml", "<mujoco/>"),
        ("myosuite-2.dist-info/LICENSE", MIT),
    ];
    fs::write(folder.join("a.whl"), zip_of(&files)).unwrap();
    let mut store = Store::open(folder.join("store")).unwrap();
    let imported = import(&mut store, &folder.join("a.whl")).unwrap();
    assert_eq!(paths(&store), ["simhive/myo_sim/elbow.xml"]);
    assert_eq!(imported.skipped.kinds, [("outside of RoboHive's envs and simhive".to_owned(), 1)].into());
    // The licence of a wheel stands in its metadata.
    assert_eq!(store.entries().next().unwrap().1.licence, Licence::Mit);

    write_folder(&folder, &files);
    let mut store = Store::open(folder.join("other")).unwrap();
    let refused = import(&mut store, &folder.join("myosuite/envs")).unwrap_err();
    assert!(matches!(refused, StoreError::Layout { files: 1, .. }), "{refused}");
}

#[test]
fn licences_are_those_of_the_nearest_text() {
    let folder = scratch("licences");
    let checkout = folder.join("checkout");
    write_folder(&checkout, &CHECKOUT);
    fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/../../LICENSE"), checkout.join("LICENSE")).unwrap();
    let mut store = Store::open(folder.join("store")).unwrap();
    import(&mut store, &checkout).unwrap();
    let licences: Vec<_> = store.entries().map(|(_, entry)| entry.licence.id()).collect();
    assert_eq!(licences, ["Apache-2.0", "Apache-2.0", "Apache-2.0", "MIT", "MIT", "Apache-2.0"]);
}

/// A part of a checkout or of an installed package is under the licence of the whole.
#[test]
fn licences_around_a_folder_count() {
    let folder = scratch("around");
    let licence = |top: &str, source: &str| {
        let mut store = Store::open(folder.join("store").join(top)).unwrap();
        import(&mut store, &folder.join(top).join(source)).unwrap();
        let (_, entry) = store.entries().next().unwrap();
        entry.licence
    };
    let model = ("robohive/envs/arms/a.xml", "<mujoco/>");
    write_folder(&folder.join("checkout"), &[model, ("LICENSE", MIT), ("setup.py", "")]);
    write_folder(&folder.join("site"), &[model, ("robohive-0.7.dist-info/licenses/LICENSE", MIT)]);
    write_folder(&folder.join("other"), &[model, ("robo-0.7.dist-info/LICENSE", MIT), ("LICENSE", MIT)]);
    assert_eq!(licence("checkout", "robohive/envs"), Licence::Mit);
    assert_eq!(licence("site", "robohive"), Licence::Mit);
    // Neither another package nor a text beside a folder that is no checkout says anything of it.
    assert_eq!(licence("other", "robohive"), Licence::Unknown);
}

#[test]
fn imports_merge_and_contradictions_are_refused_by_name() {
    let folder = scratch("merge");
    let first = [("envs/arms/a.xml", "a"), ("simhive/Adroit/b.xml", "b")];
    let second = [("envs/arms/a.xml", "other"), ("simhive/Adroit/b.xml", "b"), ("simhive/Adroit/c.xml", "c")];
    fs::write(folder.join("1.tar"), tar_of(&first)).unwrap();
    fs::write(folder.join("2.tar"), tar_of(&second)).unwrap();
    let mut store = Store::open(folder.join("store")).unwrap();
    import(&mut store, &folder.join("1.tar")).unwrap();

    let refused = import(&mut store, &folder.join("2.tar")).unwrap_err().to_string();
    assert!(
        refused.contains("envs/arms/a.xml: 1 bytes stored from") && refused.contains("--replace"),
        "{refused}"
    );
    assert_eq!(paths(&store).len(), 2);
    assert_sound(&store);

    let options = ImportOptions::default().with_replace(true);
    let imported = store.import(&folder.join("2.tar"), &options, &mut |_| ()).unwrap();
    assert_eq!((imported.added, imported.unchanged), (1, 1));
    assert_eq!(imported.replaced, ["envs/arms/a.xml"]);
    assert_eq!(fs::read(store.resolve("envs/arms/a.xml").unwrap()).unwrap(), b"other");
    assert_sound(&store);
    // The content that was replaced is gone.
    assert_eq!(fs::read_dir(folder.join("store/objects")).unwrap().count(), 3);
    // Another process sees the same.
    let again = Store::open(folder.join("store")).unwrap();
    assert!(again.entries().eq(store.entries()));
}

#[test]
fn what_is_missing_names_the_command_that_brings_it() {
    let folder = scratch("missing");
    let store = Store::open(folder.join("store")).unwrap();
    assert!(!folder.join("store").exists(), "opening creates nothing");
    let missing = store.resolve("envs/arms/../hands/a.xml").unwrap_err().to_string();
    for part in ["envs/hands/a.xml is in none of", "store", "robohive assets import PATH"] {
        assert!(missing.contains(part), "{missing}");
    }
    for path in ["../envs/a.xml", "/envs/a.xml", "assets/a.xml", "envs/../../a"] {
        assert!(matches!(store.resolve(path), Err(StoreError::NotVirtual { .. })), "{path}");
    }
}

#[test]
fn the_store_is_searched_before_other_folders() {
    let folder = scratch("search");
    write_folder(&folder.join("flat"), &[("envs/arms/a.xml", "flat"), ("envs/arms/b.xml", "flat")]);
    write_folder(
        &folder.join("deep/robohive"),
        &[("envs/arms/b.xml", "deep"), ("simhive/Adroit/c.xml", "deep")],
    );
    write_folder(&folder.join("import"), &[("envs/arms/a.xml", "stored")]);
    let mut store = Store::open(folder.join("store")).unwrap();
    import(&mut store, &folder.join("import")).unwrap();
    let search = Search::new(Some(store), vec![folder.join("flat"), folder.join("deep")]);
    let content = |path| fs::read_to_string(search.resolve(path).unwrap()).unwrap();
    assert_eq!(content("envs/arms/a.xml"), "stored");
    assert_eq!(content("envs/arms/b.xml"), "flat");
    assert_eq!(content("simhive/Adroit/c.xml"), "deep");
    let missing = search.resolve("envs/arms/d.xml").unwrap_err().to_string();
    assert!(["store", "flat", "deep"].iter().all(|name| missing.contains(name)), "{missing}");
    // A file that the store has lost is an error, not a reason to take another.
    fs::remove_file(folder.join("store/tree/envs/arms/a.xml")).unwrap();
    assert!(matches!(search.resolve("envs/arms/a.xml"), Err(StoreError::Gone { .. })));
}

/// What is changed, lost or added shows, and the same import repairs it.
#[test]
fn damage_is_named_and_repaired() {
    let folder = scratch("damage");
    write_folder(&folder.join("source"), &CHECKOUT);
    let mut store = Store::open(folder.join("store")).unwrap();
    import(&mut store, &folder.join("source")).unwrap();
    let object =
        |content: &str| folder.join("store/objects").join(Digest::of(content.as_bytes()).to_string());
    fs::remove_file(object("solid")).unwrap();
    fs::remove_file(object("<mujoco/>")).unwrap();
    fs::write(object("<mujoco/>"), "<mujoco?>").unwrap();
    fs::remove_file(folder.join("store/tree/envs/arms/reach.config")).unwrap();
    fs::write(folder.join("store/tree/envs/added.xml"), "").unwrap();

    let damages = Store::open(folder.join("store")).unwrap().verify(&mut |_| ()).unwrap();
    let found: Vec<_> = damages.iter().map(|damage| (damage.path.as_str(), damage.fault)).collect();
    let expected = [
        ("envs/arms/reach.config", Fault::Unshown),
        ("envs/arms/reach.xml", Fault::Changed),
        ("simhive/Adroit/mesh/hand.STL", Fault::Missing),
        ("envs/added.xml", Fault::Foreign),
    ];
    assert_eq!(found, expected);
    assert!(damages[0].source.ends_with("source"), "{damages:?}");

    fs::remove_file(folder.join("store/tree/envs/added.xml")).unwrap();
    assert_eq!(import(&mut store, &folder.join("source")).unwrap().unchanged, 6);
    assert_sound(&store);
}

/// Progress ends at the size of the source and never goes back.
#[test]
fn progress_is_told() {
    let folder = scratch("progress");
    write_folder(&folder.join("source"), &CHECKOUT);
    fs::write(folder.join("a.tar.gz"), gzip(&tar_of(&CHECKOUT))).unwrap();
    for name in ["source", "a.tar.gz"] {
        let mut store = Store::open(folder.join(format!("store of {name}"))).unwrap();
        let mut seen = Vec::new();
        store.import(&folder.join(name), &ImportOptions::default(), &mut |p| seen.push(p)).unwrap();
        assert!(seen.is_sorted_by_key(|p| p.done) && seen.len() >= 6, "{seen:?}");
        assert!(seen.iter().all(|p| p.done <= p.total && p.total > 0), "{seen:?}");
        let mut checked = Vec::new();
        store.verify(&mut |p| checked.push(p)).unwrap();
        assert!(checked.last().is_some_and(|p| p.done == p.total && checked.len() == 6), "{checked:?}");
    }
}
