//! What a machine has for environments: imported models, a cache of compiled ones, weights of networks, memory,
//! what draws pictures, and devices of robots, real or simulated.
//!
//! ```no_run
//! # use env as robohive_env;
//! use robohive_env::{Env, Options};
//! use std::sync::Arc;
//! use robohive_library::{Library, Weights};
//!
//! let library = Library::from_environment(None, None).map_err(std::io::Error::other)?;
//! let options = Options::default().with_networks(Arc::new(Weights::from_environment()));
//! let env = Env::make("door-v1", &library, &options)?;
//! assert_eq!(env.action_len(), 28);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cache;
mod cameras;
pub mod memory;
mod rehearsal;
mod renderer;
mod weights;

pub use rehearsal::{Rehearsal, RehearsalError, real_hardware};
pub use renderer::{NoGpu, Renderer, RendererError};
pub use weights::Weights;

use env::{AssetError, Assets};
use mjcf::Loader;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use store::Search;

/// Imported files, and a cache of compiled models.
pub struct Library {
    search: Search,
    cache: Option<mjcf::Cache>,
}

impl Library {
    /// Files of `assets`, a folder with RoboHive's envs and simhive, or else the imported ones and those that
    /// `ROBOHIVE_ASSETS` names; models compiled into `cache`, or else into `ROBOHIVE_CACHE`, or else into the user's cache
    /// folder.
    ///
    /// # Errors
    /// The store of imported files cannot be read.
    pub fn from_environment(assets: Option<&Path>, cache: Option<&Path>) -> Result<Self, store::StoreError> {
        let search = match assets {
            Some(folder) => Search::new(None, vec![folder.to_owned()]),
            None => Search::from_environment()?,
        };
        let folder = cache.map(Path::to_owned).or_else(cache::folder);
        Ok(Library { search, cache: folder.map(mjcf::Cache::new) })
    }
}

impl Library {
    /// Whether a file is one that was imported.
    pub fn is_imported(&self, file: &Path) -> bool {
        self.search.is_imported(file)
    }
}

impl Assets for Library {
    fn model(&self, path: &str) -> Result<(Loader, PathBuf), AssetError> {
        let file = self.search.resolve(path).map_err(|error| error.to_string())?;
        let loader = Loader::default();
        Ok((if let Some(cache) = &self.cache { loader.cache(cache.clone()) } else { loader }, file))
    }

    fn read(&self, path: &str) -> Result<Arc<[u8]>, AssetError> {
        let file = self.search.resolve(path).map_err(|error| error.to_string())?;
        std::fs::read(&file).map(Into::into).map_err(|error| format!("{}: {error}", file.display()).into())
    }
}
