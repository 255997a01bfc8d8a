//! Where models come from.

use crate::play::{Play, PlayError};
use crate::session::Session;
use env::{Env, Options, OwnModels, Registry};
use mjcf::diagnostic::Diagnostics;
use mjcf::files::Memory;
use mjcf::{Loaded, Loader};
use physics::Model;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

/// A model or an environment that can be opened.
#[derive(Clone, Debug)]
pub enum Source {
    /// A file: MJCF, URDF, or what `robohive compile` wrote.
    File(PathBuf),
    /// A model of our own, by its path in `assets/`.
    Own(&'static str),
    /// An environment.
    Environment(Recipe),
    /// A model that a program has sent, by its title.
    Program(String),
}

/// How an environment is made.
#[derive(Clone)]
pub struct Recipe {
    id: String,
    make: Arc<dyn Fn() -> Result<Play, PlayError> + Send + Sync>,
}

impl Recipe {
    /// The environment of an id, made and started by `make`.
    pub fn new(id: &str, make: impl Fn() -> Result<Play, PlayError> + Send + Sync + 'static) -> Self {
        Recipe { id: id.to_owned(), make: Arc::new(make) }
    }
}

impl fmt::Debug for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Recipe").field(&self.id).finish()
    }
}

impl Source {
    /// Models of our own.
    pub fn own() -> impl Iterator<Item = Source> {
        assets::FILES
            .iter()
            .map(|(path, _)| *path)
            .filter(|path| path.ends_with(".xml") && !is_part(path))
            .map(Source::Own)
    }

    /// Environments on models of our own.
    pub fn own_environments() -> impl Iterator<Item = Source> {
        let own = Registry::builtin().specs().iter().filter(|spec| spec.id.starts_with("hive/"));
        own.map(|spec| {
            let id = spec.id.clone();
            let make = move || Play::new(Env::make(&id, &OwnModels, &Options::default())?, None, 0);
            Source::Environment(Recipe::new(&spec.id, make))
        })
    }

    /// What people call it.
    pub fn title(&self) -> String {
        match self {
            Source::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            Source::Own(path) => {
                Path::new(path).file_stem().unwrap_or_default().to_string_lossy().into_owned()
            }
            Source::Environment(recipe) => recipe.id.clone(),
            Source::Program(title) => title.clone(),
        }
    }

    /// A session with it, and what was ignored or assumed when its model was read.
    ///
    /// # Errors
    /// What is wrong with it, with file, line and column.
    pub(super) fn start(&self) -> Result<(Session, String), String> {
        if let Source::Environment(recipe) = self {
            let play = (recipe.make)().map_err(|error| error.to_string())?;
            let warnings = play.env().warnings().to_string();
            return Ok((Session::playing(play), warnings));
        }
        let loaded = self.load()?;
        let session = Session::new(loaded.model).map_err(|error| error.to_string())?;
        Ok((session, loaded.warnings.to_string()))
    }

    /// Reads and compiles a model.
    ///
    /// # Errors
    /// What is wrong with it, with file, line and column.
    pub(super) fn load(&self) -> Result<Loaded, String> {
        match self {
            Source::File(path) => load_file(path),
            Source::Environment(recipe) => Err(format!("{} is an environment, not a model", recipe.id)),
            Source::Program(title) => {
                Err(format!("{title} is the model of a program, which alone can read it again"))
            }
            Source::Own(path) => {
                let mut files = Memory::default();
                assets::FILES.iter().for_each(|(path, text)| files.insert(path, text.as_bytes()));
                Loader::default().files(files).load(path).map_err(|errors| errors.to_string())
            }
        }
    }

    /// When its file was changed last.
    pub fn changed(&self) -> Option<SystemTime> {
        match self {
            Source::File(path) => std::fs::metadata(path).and_then(|about| about.modified()).ok(),
            Source::Own(_) | Source::Environment(_) | Source::Program(_) => None,
        }
    }
}

/// Whether a file is a part of models rather than one.
fn is_part(path: &str) -> bool {
    path.contains("/parts/")
}

fn load_file(path: &Path) -> Result<Loaded, String> {
    let mut start = [0; 64];
    let is_compiled = std::fs::File::open(path)
        .and_then(|mut file| std::io::Read::read(&mut file, &mut start))
        .is_ok_and(|_| physics::binary::is_model(&start));
    if is_compiled {
        let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let model = Model::from_bytes(&bytes).map_err(|error| format!("{}: {error}", path.display()))?;
        return Ok(Loaded { model, warnings: Diagnostics::default() });
    }
    mjcf::load(path).map_err(|errors| errors.to_string())
}
