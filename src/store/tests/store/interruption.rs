//! Imports that end before their time, at every step of becoming visible.

use crate::sources::{assert_sound, import, paths, scratch, tar_of, write_folder};
use robohive_store::{Digest, Store, StoreError};
use std::fs::{self, File};
use std::path::Path;

const FIRST: [(&str, &str); 2] = [("envs/arms/a.xml", "a"), ("simhive/Adroit/b.xml", "b")];
const SECOND: [(&str, &str); 2] = [("envs/arms/c.xml", "c"), ("simhive/Adroit/d.xml", "d")];

fn stored(folder: &Path, files: &[(&str, &str)]) -> Store {
    let source = folder.join("source.tar");
    fs::write(&source, tar_of(files)).unwrap();
    let mut store = Store::open(folder.join("store")).unwrap();
    import(&mut store, &source).unwrap();
    store
}

/// Before the manifest is in place, nothing has changed, and the next import removes what is left.
#[test]
fn what_a_killed_import_staged_is_removed() {
    let folder = scratch("staged");
    stored(&folder, &FIRST);
    let left = Digest::of(b"left").to_string();
    write_folder(
        &folder.join("store"),
        &[
            ("staging/unfinished", "le"),
            ("staging/manifest", "robohive-st"),
            (&format!("staging/{left}"), "left"),
        ],
    );
    let orphan = format!("objects/{left}");
    write_folder(&folder.join("store"), &[(&orphan, "left"), ("tree.part", "le")]);
    let store = Store::open(folder.join("store")).unwrap();
    assert_eq!(paths(&store), ["envs/arms/a.xml", "simhive/Adroit/b.xml"]);
    assert_eq!(store.verify(&mut |_| ()).unwrap(), []);

    let store = stored(&folder, &SECOND);
    assert_eq!(paths(&store).len(), 4);
    assert_sound(&store);
    assert!(!folder.join("store").join(orphan).exists() && !folder.join("store/tree.part").exists());
}

/// After the manifest is in place, opening completes the tree.
#[test]
fn a_tree_behind_its_manifest_is_completed() {
    let folder = scratch("tree");
    stored(&folder, &FIRST);
    let stamp = folder.join("store/tree.stamp");
    let before = fs::read(&stamp).unwrap();
    stored(&folder, &SECOND);
    // As after a kill between the manifest and the tree.
    fs::write(&stamp, before).unwrap();
    fs::remove_file(folder.join("store/tree/envs/arms/c.xml")).unwrap();
    fs::remove_dir_all(folder.join("store/tree/simhive")).unwrap();
    let store = Store::open(folder.join("store")).unwrap();
    assert_sound(&store);
    assert_eq!(fs::read(store.resolve("simhive/Adroit/d.xml").unwrap()).unwrap(), b"d");
    // A store whose first import was killed there has no stamp at all.
    fs::remove_file(&stamp).unwrap();
    fs::remove_dir_all(folder.join("store/tree")).unwrap();
    assert_sound(&Store::open(folder.join("store")).unwrap());
}

/// A lost object does not keep the rest of the store from being opened.
#[test]
fn a_tree_is_completed_around_lost_objects() {
    let folder = scratch("lost");
    stored(&folder, &FIRST);
    let name = Digest::of(b"a").to_string();
    fs::remove_file(folder.join("store/objects").join(name)).unwrap();
    fs::remove_dir_all(folder.join("store/tree")).unwrap();
    fs::remove_file(folder.join("store/tree.stamp")).unwrap();
    let store = Store::open(folder.join("store")).unwrap();
    assert!(store.resolve("simhive/Adroit/b.xml").is_ok());
    assert!(matches!(store.resolve("envs/arms/a.xml"), Err(StoreError::Gone { .. })));
    let damages = store.verify(&mut |_| ()).unwrap();
    assert_eq!(damages.iter().map(|damage| damage.path.as_str()).collect::<Vec<_>>(), ["envs/arms/a.xml"]);
    assert_sound(&stored(&folder, &FIRST));
}

#[test]
fn two_imports_at_once_are_refused() {
    let folder = scratch("lock");
    let mut store = stored(&folder, &FIRST);
    let lock = File::options().write(true).open(folder.join("store/lock")).unwrap();
    lock.lock().unwrap();
    let busy = import(&mut store, &folder.join("source.tar")).unwrap_err();
    assert!(matches!(busy, StoreError::Busy { .. }) && busy.to_string().contains("another import"), "{busy}");
    lock.unlock().unwrap();
    assert_eq!(import(&mut store, &folder.join("source.tar")).unwrap().unchanged, 2);
}

#[test]
fn a_damaged_manifest_is_an_error_that_names_its_line() {
    let folder = scratch("manifest");
    stored(&folder, &FIRST);
    let path = folder.join("store/manifest");
    let text = fs::read_to_string(&path).unwrap();
    fs::write(&path, text.replacen("\tenvs/arms/a.xml", "\tenvs/arms/../../../a.xml", 1)).unwrap();
    let error = Store::open(folder.join("store")).unwrap_err().to_string();
    assert!(error.contains("manifest, line 2: damaged") && error.contains("import again"), "{error}");
    fs::write(&path, &text[..text.len() / 2]).unwrap();
    assert!(matches!(Store::open(folder.join("store")), Err(StoreError::Manifest { .. })));
    fs::remove_file(&path).unwrap();
    assert_sound(&stored(&folder, &[FIRST, SECOND].concat()));
}
