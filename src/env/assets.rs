//! Where the files of a registry come from.

use crate::message::message;
use mjcf::Loader;
use std::path::{Path, PathBuf};
use std::sync::Arc;

message! {
    /// A file that is not there or cannot be read: why, and how to get it.
    AssetError
}

/// Files by the paths that the registry uses, such as `envs/arms/franka/assets/franka_reach_v0.xml`.
pub trait Assets: Send + Sync {
    /// A loader that finds the model at `path` and all that it includes, and the path to give it.
    ///
    /// # Errors
    /// The file is not there: how to get it.
    fn model(&self, path: &str) -> Result<(Loader, PathBuf), AssetError>;

    /// The content of a file.
    ///
    /// # Errors
    /// The file is not there, or cannot be read: why, and how to get it.
    fn read(&self, path: &str) -> Result<Arc<[u8]>, AssetError>;
}

/// Files in a folder.
#[derive(Clone, Debug)]
pub struct Folder {
    root: PathBuf,
    cache: Option<mjcf::Cache>,
}

impl Folder {
    /// The files below `root`.
    pub fn new(root: impl AsRef<Path>) -> Self {
        Folder { root: root.as_ref().into(), cache: None }
    }

    /// Keeps compiled models in `cache`.
    pub fn cache(mut self, cache: mjcf::Cache) -> Self {
        self.cache = Some(cache);
        self
    }

    fn find(&self, path: &str) -> Result<PathBuf, String> {
        let file = self.root.join(path);
        if file.is_file() { Ok(file) } else { Err(format!("{} does not exist", file.display())) }
    }
}

impl Assets for Folder {
    fn model(&self, path: &str) -> Result<(Loader, PathBuf), AssetError> {
        let file = self.find(path)?;
        let loader = Loader::default();
        Ok((if let Some(cache) = &self.cache { loader.cache(cache.clone()) } else { loader }, file))
    }

    fn read(&self, path: &str) -> Result<Arc<[u8]>, AssetError> {
        let file = self.find(path)?;
        std::fs::read(&file).map(Into::into).map_err(|error| format!("{}: {error}", file.display()).into())
    }
}

/// What the paths of models begin with that are compiled into this crate.
const OWN: &str = "hive/";

/// A loader for a model of our own, and the path to give it; `None` for paths of other models.
///
/// # Errors
/// We have no such model.
pub(crate) fn own_model(path: &str) -> Option<Result<(Loader, PathBuf), AssetError>> {
    let path = path.strip_prefix(OWN)?;
    if assets::text(path).is_none() {
        let names: Vec<_> = assets::paths().filter(|path| path.ends_with(".xml")).collect();
        return Some(Err(format!("our own models are {}", names.join(", ")).into()));
    }
    Some(Ok((Loader::default().files(assets::Own), path.into())))
}

/// What the paths of models begin with that belong to Gymnasium's package.
const GYMNASIUM: &str = "gymnasium:";

/// A loader for a model anywhere on this machine, named by an absolute path; `None` for paths within assets.
///
/// # Errors
/// The file does not exist; the path names a model of a package that the user is to bring.
pub(crate) fn foreign_model(path: &str) -> Option<Result<(Loader, PathBuf), AssetError>> {
    if let Some(name) = path.strip_prefix(GYMNASIUM) {
        return Some(Err(format!(
            "it is a file of the Python package gymnasium; set model_path to the absolute path of an MJCF file such as \
             gymnasium/envs/mujoco/assets/{name} there"
        )
        .into()));
    }
    let file = Path::new(path);
    if !file.is_absolute() {
        return None;
    }
    let missing = || format!("{path} does not exist").into();
    Some(if file.is_file() { Ok((Loader::default(), file.into())) } else { Err(missing()) })
}

/// The content of a file of our own; `None` for paths of other files, and for files that we do not have.
pub(crate) fn own_file(path: &str) -> Option<Arc<[u8]>> {
    let path = path.strip_prefix(OWN)?;
    assets::read(path).map(|bytes| Arc::from(&*bytes))
}

/// No files at all: enough for models of our own.
#[derive(Clone, Copy, Debug, Default)]
pub struct OwnModels;

impl Assets for OwnModels {
    fn model(&self, _: &str) -> Result<(Loader, PathBuf), AssetError> {
        Err("only models of our own (hive/...) are here".into())
    }

    fn read(&self, _: &str) -> Result<Arc<[u8]>, AssetError> {
        Err("only models of our own (hive/...) are here".into())
    }
}
