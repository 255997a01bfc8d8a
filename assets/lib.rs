//! Our own models, for programs that carry them along: their texts, the meshes that they name, the configs of their robots, and policies that
//! were trained in their environments. What each shows, and where its numbers come from, stands in the README of its folder.
//!
//! Meshes are not stored. The file `shapes.rs` of a folder says how each is made (with `robohive_workshop`), and [`Own`] makes it when a
//! model is compiled that names it. [`write()`] puts all files into a folder, for programs that read disks.
//!
//! ```
//! use robohive_assets::Own;
//!
//! let panda = mjcf::Loader::default().files(Own).load("panda/scene.xml")?.model;
//! assert_eq!(panda.nu, 9);
//! assert!(panda.nmesh > 10);
//! # Ok::<(), mjcf::diagnostic::Diagnostics>(())
//! ```

mod adroit;
mod allegro;
mod arms;
mod atlas;
mod bones;
mod car;
mod darwin;
mod dclaw;
mod dhand;
mod dkitty;
mod dmanus;
mod dynamixel;
mod fetch;
mod fingers;
mod hand;
mod hopper;
mod kitchen;
mod minicheetah;
mod mpl;
mod myoarm;
mod myoelbow;
mod myofinger;
mod myohand;
mod myolegs;
mod objects;
mod panda;
mod robotiq;
mod sawyer;
mod shadow;
mod shape;
mod snake;
mod so101;
mod spot;
mod trifinger;

use mjcf::files::{FileError, FileProvider};
use shape::Shape;
use std::borrow::Cow;
use std::io;
use std::path::Path;
use std::sync::Arc;
use workshop::Mesh;

/// Every model and config by its path in this folder, as `build.rs` finds them, sorted. Models include others by relative paths.
static TEXTS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/texts.rs"));

/// Ids of the environments of trained policies, as `build.rs` finds them in the folder `policies`, sorted; and the policies, apart, so that a
/// program which only lists them does not hold them.
static POLICY_IDS: &[&str] = include!(concat!(env!("OUT_DIR"), "/policy_ids.rs"));
static POLICIES: &[&[u8]] = include!(concat!(env!("OUT_DIR"), "/policies.rs"));

/// Every mesh, by the folder that it is in.
static MESHES: &[(&str, &[Shape])] = &[
    ("adroit/", adroit::MESHES),
    ("allegro/", allegro::MESHES),
    ("atlas/", atlas::MESHES),
    ("car/", car::MESHES),
    ("darwin/", darwin::MESHES),
    ("dclaw/", dclaw::MESHES),
    ("dhand/", dhand::MESHES),
    ("dkitty/", dkitty::MESHES),
    ("dmanus/", dmanus::MESHES),
    ("fetch/", fetch::MESHES),
    ("hopper/", hopper::MESHES),
    ("kitchen/", kitchen::MESHES),
    ("minicheetah/", minicheetah::MESHES),
    ("mpl/", mpl::MESHES),
    ("myoarm/", myoarm::MESHES),
    ("myoelbow/", myoelbow::MESHES),
    ("myofinger/", myofinger::MESHES),
    ("myohand/", myohand::MESHES),
    ("myolegs/", myolegs::MESHES),
    ("objects/desk/", objects::DESK),
    ("objects/gadgets/", objects::GADGETS),
    ("objects/kitchen/", objects::KITCHEN),
    ("objects/solids/", objects::SOLIDS),
    ("objects/things/", objects::THINGS),
    ("objects/toys/", objects::TOYS),
    ("panda/", panda::MESHES),
    ("robotiq/", robotiq::MESHES),
    ("sawyer/", sawyer::MESHES),
    ("shadow/", shadow::MESHES),
    ("snake/", snake::MESHES),
    ("so101/", so101::MESHES),
    ("spot/", spot::MESHES),
    ("trifinger/", trifinger::MESHES),
];

/// Faces that meet at less than this angle are shaded as one surface \[rad\].
const CREASE: f64 = 0.6;

/// Paths of all texts and meshes.
pub fn paths() -> impl Iterator<Item = Cow<'static, str>> {
    let meshes = MESHES.iter().flat_map(|(folder, meshes)| {
        meshes.iter().map(move |(name, _)| Cow::Owned(format!("{folder}{name}.obj")))
    });
    TEXTS.iter().map(|(path, _)| Cow::Borrowed(*path)).chain(meshes)
}

/// Names and paths of the models that stand for themselves: a folder's `scene.xml` by the name of the folder, and in folders without one,
/// models by the names of their files. Left out are parts of models (folders `parts`), and scenes with what a task adds (folders
/// `tasks`).
pub fn models() -> impl Iterator<Item = (&'static str, &'static str)> {
    TEXTS.iter().filter_map(|(path, _)| {
        let (folder, file) = path.strip_suffix(".xml")?.split_once('/')?;
        let whole = text(&format!("{folder}/scene.xml")).is_none() && !file.contains('/');
        (whole || file == "scene").then_some((if whole { file } else { folder }, *path))
    })
}

/// The text of a model or a config; `None` where there is none, and for meshes.
pub fn text(path: &str) -> Option<&'static str> {
    TEXTS.binary_search_by_key(&path, |(own, _)| own).ok().map(|found| TEXTS[found].1)
}

/// Ids of environments that a trained policy is shipped for, sorted.
pub fn policies() -> impl Iterator<Item = &'static str> {
    POLICY_IDS.iter().copied()
}

/// The trained policy for the environments of an id, a safetensors file; `None` where none is shipped.
pub fn policy(id: &str) -> Option<&'static [u8]> {
    POLICY_IDS.binary_search(&id).ok().map(|found| POLICIES[found])
}

/// The mesh that an OBJ file holds.
pub fn mesh(path: &str) -> Option<Mesh> {
    let named = |(folder, meshes): &(&str, &[Shape])| {
        let name = path.strip_prefix(folder)?.strip_suffix(".obj")?;
        meshes.iter().find(|(own, _)| *own == name).map(|(_, make)| make())
    };
    MESHES.iter().find_map(named)
}

/// The content of a file, made where it is a mesh.
pub fn read(path: &str) -> Option<Cow<'static, [u8]>> {
    let made = || mesh(path).map(|mesh| Cow::Owned(mesh.to_obj(CREASE).into_bytes()));
    text(path).map(|text| Cow::Borrowed(text.as_bytes())).or_else(made)
}

/// Writes every file below `folder`, each at its path, and returns how many there are. Files of these names are replaced.
///
/// # Errors
/// A folder or a file cannot be written.
pub fn write(folder: &Path) -> io::Result<usize> {
    let mut count = 0;
    for path in paths() {
        let file = folder.join(&*path);
        file.parent().map_or(Ok(()), std::fs::create_dir_all)?;
        let content = read(&path).ok_or(io::ErrorKind::NotFound)?;
        std::fs::write(&file, content)?;
        count += 1;
    }
    Ok(count)
}

/// All files, for a loader.
#[derive(Clone, Copy, Debug, Default)]
pub struct Own;

impl FileProvider for Own {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, FileError> {
        read(path).map(|bytes| Arc::from(&*bytes)).ok_or(FileError::NotFound)
    }

    fn exists(&self, path: &str) -> bool {
        paths().any(|own| own == path)
    }
}
