//! The cache of compiled models: what is found again, and what is not.

use robohive_mjcf::files::{FileError, FileProvider, Memory};
use robohive_mjcf::{Cache, Loader};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

/// Files that may change, and how often each was read.
#[derive(Clone, Default)]
struct Changing {
    files: Arc<Mutex<Memory>>,
    meshes_read: Arc<AtomicUsize>,
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
    let mut all: Vec<_> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
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
fn warnings_are_kept_with_the_model() {
    let (files, folder) = (files(), folder("warnings"));
    files.set("part.xml", &PART.replace("<worldbody>", "<option apirate='1'/><worldbody>"));
    let loader = Loader::default().files(files.clone()).cache(Cache::new(folder));
    let [first, second] = [0, 1].map(|_| loader.load("model.xml").unwrap().warnings);
    assert!(!first.list.is_empty());
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
        bounded.clone().substitute("none", &k.to_string()).load("model.xml").unwrap();
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
    let [with, without] =
        [true, false].map(|threads| robohive_mjcf::load_str(&model(threads)).unwrap().model);
    assert!(with.nmesh == 37 && with.nmeshvert > 1000);
    assert_eq!(with.to_bytes(), without.to_bytes());
}
