//! The cache of compiled models: what is found again, and what is not.

use robohive_mjcf::files::{Disk, FileError, FileProvider, Memory, Stamp};
use robohive_mjcf::{Cache, Loader};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{SystemTime, UNIX_EPOCH};

/// Files that may change, and how often each was read.
#[derive(Clone, Default)]
struct Changing {
    files: Arc<Mutex<Memory>>,
    meshes_read: Arc<AtomicUsize>,
    /// When all files changed, if it can be told \[ns\].
    changed: Arc<Mutex<Option<i64>>>,
}

impl Changing {
    fn set(&self, path: &str, text: &str) {
        self.files.lock().unwrap().insert(path, text.as_bytes());
    }
}

impl FileProvider for Changing {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        self.meshes_read.fetch_add(usize::from(path.ends_with(".obj")), Ordering::Relaxed);
        self.files.lock().unwrap().read(path)
    }

    fn exists(&self, path: &str) -> bool {
        self.files.lock().unwrap().exists(path)
    }

    fn stamp(&self, _: &str) -> Option<Stamp> {
        self.changed.lock().unwrap().map(|changed| Stamp { length: 0, changed, place: 0 })
    }
}

const MODEL: &str = "<mujoco><asset><mesh file='m.obj'/></asset><include file='part.xml'/></mujoco>";
const PART: &str =
    "<mujoco><worldbody><body><freejoint/><geom type='mesh' mesh='m'/></body></worldbody></mujoco>";
const MESH: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

fn files() -> Changing {
    let files = Changing::default();
    files.set("model.xml", MODEL);
    files.set("part.xml", PART);
    files.set("m.obj", MESH);
    files
}

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("cache").join(name);
    _ = std::fs::remove_dir_all(&folder);
    folder
}

fn entries(folder: &PathBuf) -> Vec<PathBuf> {
    of_kind(folder, "rhc")
}

fn of_kind(folder: &PathBuf, kind: &str) -> Vec<PathBuf> {
    let all = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    let mut all: Vec<_> = all.filter(|path| path.extension().is_some_and(|e| e == kind)).collect();
    all.sort();
    all
}

#[test]
fn a_model_is_found_again_until_a_file_changes() {
    let (files, folder) = (files(), folder("found"));
    let loader = Loader::default().files(files.clone()).cache(Cache::new(&folder));
    let plain = Loader::default().files(files.clone());
    let bytes = plain.load("model.xml").unwrap().model.to_bytes();
    assert_eq!(loader.load("model.xml").unwrap().model.to_bytes(), bytes);
    let written = std::fs::read(&entries(&folder)[0]).unwrap();
    assert_eq!(loader.load("model.xml").unwrap().model.to_bytes(), bytes);
    // Another mesh of the same length, then another part.
    for (path, text) in [
        ("m.obj", MESH.replace("v 1 0 0", "v 2 0 0")),
        ("part.xml", PART.replace("<freejoint/>", "<freejoint name='f'/>")),
    ] {
        files.set(path, &text);
        let changed = loader.load("model.xml").unwrap().model.to_bytes();
        assert_eq!(changed, plain.load("model.xml").unwrap().model.to_bytes(), "{path}");
        assert_ne!(changed, bytes, "{path}");
    }
    assert_eq!(entries(&folder).len(), 1);
    assert_ne!(std::fs::read(&entries(&folder)[0]).unwrap(), written);
    // Edits ask for another model.
    let edited = loader.clone().substitute("<freejoint name='f'/>", "");
    assert_eq!(edited.load("model.xml").unwrap().model.nv, 0);
    assert_eq!(loader.load("model.xml").unwrap().model.nv, 6);
    assert_eq!(entries(&folder).len(), 2);
}

#[test]
fn files_whose_stamp_stayed_are_not_read() {
    let (files, folder) = (files(), folder("stamps"));
    let loader = Loader::default().files(files.clone()).cache(Cache::new(folder));
    let set_changed = |time: i64| *files.changed.lock().unwrap() = Some(time);
    let load = || {
        files.meshes_read.store(0, Ordering::Relaxed);
        let vertices = loader.load("model.xml").unwrap().model.mesh_vert.clone();
        (vertices, files.meshes_read.load(Ordering::Relaxed))
    };
    set_changed(5);
    let (first, _) = load();
    assert_eq!(load(), (first.clone(), 0));
    set_changed(6);
    assert_eq!(load(), (first.clone(), 1), "another time, the same digest");
    files.set("m.obj", &MESH.replace("v 1 0 0", "v 2 0 0"));
    let (second, _) = load();
    assert_ne!(first, second);
    assert_eq!(load(), (second.clone(), 0));
    // Written so lately that the time may not tell of another change.
    set_changed(SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_nanos() as i64);
    assert_eq!(load(), (second.clone(), 1));
    files.set("m.obj", MESH);
    assert_eq!(load().0, first);
    files.set("m.obj", &MESH.replace("v 1 0 0", "v 2 0 0"));
    assert_eq!(load().0, second);
}

#[test]
fn a_file_written_anew_has_another_stamp() {
    let folder = folder("stamp");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("a").to_str().unwrap().to_owned();
    let stamp = || Disk::everywhere().stamp(&path);
    assert_eq!(stamp(), None);
    std::fs::write(&path, "one").unwrap();
    let first = stamp().unwrap();
    assert_eq!((first.length, stamp()), (3, Some(first)));
    // A copy with the old time in its place.
    let copy = folder.join("b");
    std::fs::write(&copy, "two").unwrap();
    let time = std::fs::metadata(&path).unwrap().modified().unwrap();
    std::fs::File::options().append(true).open(&copy).unwrap().set_modified(time).unwrap();
    std::fs::rename(&copy, &path).unwrap();
    if cfg!(unix) {
        assert_ne!(stamp(), Some(first));
    }
}

#[test]
fn meshes_are_kept_apart_from_the_models_that_show_them() {
    let (files, folder) = (files(), folder("meshes"));
    let loader = Loader::default().files(files.clone()).cache(Cache::new(&folder));
    let plain = Loader::default().files(files.clone());
    loader.load("model.xml").unwrap();
    let [kept] = &of_kind(&folder, "rhmesh")[..] else { panic!("one mesh") };
    files.set("part.xml", &PART.replace("<freejoint/>", "<freejoint name='f'/>"));
    let bytes = loader.load("model.xml").unwrap().model.to_bytes();
    assert_eq!(bytes, plain.load("model.xml").unwrap().model.to_bytes());
    assert_eq!(of_kind(&folder, "rhmesh").len(), 1);
    // What stands under the name of the mesh is what a new text shows, unless it is damaged.
    files.set("model.xml", &MODEL.replace("<mesh ", "<mesh scale='2 2 2' "));
    let large = loader.load("model.xml").unwrap().model.mesh_vert.clone();
    let other = of_kind(&folder, "rhmesh").into_iter().find(|path| path != kept).unwrap();
    let small = std::fs::read(kept).unwrap();
    std::fs::copy(&other, kept).unwrap();
    files.set("model.xml", &MODEL.replace("<asset>", "<asset> "));
    assert_eq!(loader.load("model.xml").unwrap().model.mesh_vert, large);
    std::fs::write(kept, &small[..small.len() - 1]).unwrap();
    files.set("model.xml", MODEL);
    assert_eq!(loader.load("model.xml").unwrap().model.to_bytes(), bytes);
    assert_eq!(std::fs::read(kept).unwrap(), small);
}

/// Two threads read what is large, the split falling behind each kind of array.
#[test]
fn large_models_are_read_on_two_threads() {
    let [a, b] = ["a", "b"].map(|name| format!("<mesh name='{name}' builtin='sphere' params='4'/>"));
    let sphere = format!("{a}{b}");
    let wide = "<texture name='t' type='2d' builtin='flat' width='1500' height='900'/>";
    for (name, assets) in [("mesh", &*sphere), ("texture", wide), ("both", &format!("{sphere}{wide}"))] {
        let (files, folder) = (files(), folder(&format!("large-{name}")));
        files.set("model.xml", &format!("<mujoco><asset>{assets}</asset></mujoco>"));
        let loader = Loader::default().files(files).cache(Cache::new(&folder));
        let bytes = loader.load("model.xml").unwrap().model.to_bytes();
        assert!(bytes.len() > 1 << 20, "{name} {}", bytes.len());
        let again = loader.load("model.xml").unwrap();
        assert!(again.warnings.is_empty(), "{name}");
        assert!(again.model.to_bytes() == bytes, "{name}");
        let entry = &entries(&folder)[0];
        let mut damaged = std::fs::read(entry).unwrap();
        let last = damaged.len() - 1000;
        damaged[last] ^= 1;
        std::fs::write(entry, damaged).unwrap();
        let warnings = loader.load("model.xml").unwrap().warnings.to_string();
        assert!(warnings.contains("cached model was damaged"), "{name} {warnings}");
    }
}

#[test]
fn warnings_are_kept_with_the_model() {
    let (files, folder) = (files(), folder("warnings"));
    files.set("part.xml", &PART.replace("<worldbody>", "<option apirate='1'/><worldbody>"));
    let loader = Loader::default().files(files.clone()).cache(Cache::new(folder));
    let [first, second] = [0, 1].map(|_| loader.load("model.xml").unwrap().warnings);
    assert!(!first.is_empty());
    assert_eq!(first, second);
}

#[test]
fn a_damaged_entry_is_compiled_anew_and_mended() {
    let (files, folder) = (files(), folder("damaged"));
    let loader = Loader::default().files(files).cache(Cache::new(&folder));
    let bytes = loader.load("model.xml").unwrap().model.to_bytes();
    let entry = &entries(&folder)[0];
    let whole = std::fs::read(entry).unwrap();
    for at in [0, 9, 40, whole.len() / 2, whole.len() - 1] {
        let mut damaged = whole.clone();
        damaged[at] ^= 0x10;
        std::fs::write(entry, &damaged).unwrap();
        let loaded = loader.load("model.xml").unwrap();
        assert_eq!(loaded.model.to_bytes(), bytes, "byte {at}");
        assert!(loaded.warnings.to_string().contains("cached model was damaged"), "byte {at}");
        assert_eq!(std::fs::read(entry).unwrap(), whole, "byte {at}");
    }
    for length in (0..whole.len()).step_by(97) {
        std::fs::write(entry, &whole[..length]).unwrap();
        assert_eq!(loader.load("model.xml").unwrap().model.to_bytes(), bytes, "length {length}");
    }
}

#[test]
fn the_folder_is_bounded_and_a_folder_that_cannot_be_written_only_warns() {
    let (files, folder) = (files(), folder("bounded"));
    let loader = Loader::default().files(files.clone());
    let size = loader.load("model.xml").unwrap().model.to_bytes().len() as u64;
    let bounded = loader.clone().cache(Cache::new(&folder).max_bytes(3 * size + size / 2));
    for k in 0..6 {
        bounded.clone().substitute("none", k.to_string()).load("model.xml").unwrap();
        assert!(entries(&folder).len() <= 3, "{:?}", entries(&folder));
    }
    assert!(entries(&folder).len() > 1);
    let file = folder.join("file");
    std::fs::write(&file, "").unwrap();
    let loaded = loader.cache(Cache::new(file)).load("model.xml").unwrap();
    assert!(loaded.warnings.to_string().contains("cannot be cached"), "{}", loaded.warnings);
}

/// Work is shared among threads by size; what comes out does not depend on it.
#[test]
fn threads_make_the_same_model() {
    let shapes: String =
        (3..40).map(|n| format!("<mesh name='x{n}' builtin='sphere' params='{}'/>", n % 4 + 1)).collect();
    let model = |threads: bool| {
        format!(
            "<mujoco><compiler usethread='{threads}'/><asset>{shapes}</asset><worldbody>{}</worldbody></mujoco>",
            (3..40).map(|n| format!("<geom type='mesh' mesh='x{n}'/>")).collect::<String>()
        )
    };
    let [with, without] = [true, false].map(|threads| robohive_mjcf::load_str(model(threads)).unwrap().model);
    assert!(with.nmesh == 37 && with.nmeshvert > 1000);
    assert_eq!(with.to_bytes(), without.to_bytes());
}
