//! Where models come from.

use super::episodes::{Recording, trajectory};
use crate::files::{Files, is_archive};
use crate::own::{own_loader, own_models};
use crate::play::{Play, PlayError};
use crate::session::Session;
use env::{Env, Options, OwnModels, Registry};
use mjcf::diagnostic::Diagnostics;
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
    /// A model among files in memory, by its path.
    Among(Arc<Files>, String),
    /// A model of our own: its name, and its path in `assets/`.
    Own(&'static str, &'static str),
    /// An environment.
    Environment(Recipe),
    /// Recorded episodes of an environment.
    Episodes(Recording),
    /// A model with states of it that were recorded.
    States(Box<States>),
    /// A model that a program has sent, by its title.
    Program(String),
}

/// Recorded states of a model: numpy archives, as `robohive sim --out` writes them.
#[derive(Clone, Debug)]
pub struct States {
    /// The model.
    pub of: Source,
    /// Those that are replayed; without them the model is simulated.
    pub replayed: Option<PathBuf>,
    /// Those that are drawn beside the others, at the same time.
    pub reference: Option<PathBuf>,
}

impl States {
    fn start(&self) -> Result<(Session, String), String> {
        let (mut session, warnings) = self.of.start()?;
        if session.play().is_some() {
            return Err(format!(
                "{} is an environment; recorded states are those of a model",
                self.of.title()
            ));
        }
        if let Some(path) = &self.replayed {
            let states = trajectory(path, &session)?;
            session.set_replay(Some(states)).map_err(|error| error.to_string())?;
        }
        if let Some(path) = &self.reference {
            let states = trajectory(path, &session)?;
            session.set_reference(Some(states)).map_err(|error| error.to_string())?;
        }
        Ok((session, warnings))
    }

    fn title(&self) -> String {
        let model = self.of.title();
        self.replayed.as_ref().map_or(model.clone(), |path| format!("{}: {model}", path.display()))
    }
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
        own_models().map(|(name, path)| Source::Own(name, path))
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

    /// The model among files that is nearest to the top.
    ///
    /// # Errors
    /// None of them is a model.
    pub fn among(files: Files) -> Result<Source, NoModel> {
        let Some(path) = files.models().into_iter().next() else { return Err(NoModel(files.len())) };
        Ok(Source::Among(Arc::new(files), path))
    }

    /// Models that lie beside this one in the same files.
    pub fn siblings(&self) -> Vec<Source> {
        let Source::Among(files, _) = self else { return Vec::new() };
        files.models().into_iter().map(|path| Source::Among(files.clone(), path)).collect()
    }

    /// What people call it.
    pub fn title(&self) -> String {
        match self {
            Source::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            Source::Among(_, path) => path.clone(),
            Source::Own(name, _) => (*name).to_owned(),
            Source::Environment(recipe) => recipe.id.clone(),
            Source::Episodes(recording) => recording.path.display().to_string(),
            Source::States(states) => states.title(),
            Source::Program(title) => title.clone(),
        }
    }

    /// Tries whether it can be opened.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn check(&self) -> Result<(), Unopened> {
        let tried = match self {
            Source::Episodes(recording) => recording.start().map(drop),
            _ => self.start().map(drop),
        };
        tried.map_err(Unopened)
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
        if let Source::States(states) = self {
            return states.start();
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
            Source::Among(files, path) => files.load_gathered(path).map_err(|error| error.to_string()),
            Source::Environment(recipe) => Err(format!("{} is an environment, not a model", recipe.id)),
            Source::Episodes(recording) => {
                Err(format!("{} holds episodes, not a model", recording.path.display()))
            }
            Source::States(states) => states.of.load(),
            Source::Program(title) => {
                Err(format!("{title} is the model of a program, which alone can read it again"))
            }
            Source::Own(_, path) => own_loader().load(path).map_err(|errors| errors.to_string()),
        }
    }

    /// The model as one MJCF text, as it was read; files of assets are named from the folder where the program runs.
    ///
    /// # Errors
    /// It is no MJCF or URDF of a file or of our own, or has names that no text can say.
    pub(super) fn mjcf(&self) -> Result<String, String> {
        let parsed = match self {
            Source::File(path) => Loader::default().parse(path),
            Source::Own(_, path) => own_loader().parse(path),
            Source::States(states) => return states.of.mjcf(),
            _ => return Err(format!("{} is not a file of MJCF or URDF", self.title())),
        };
        let mut spec = parsed.map_err(|errors| errors.to_string())?.spec;
        if let Source::File(_) = self {
            spec.place_assets("").map_err(|errors| errors.to_string())?;
        }
        spec.to_xml().map_err(|errors| errors.to_string())
    }

    /// When its file was changed last.
    pub fn changed(&self) -> Option<SystemTime> {
        match self {
            Source::File(path) => std::fs::metadata(path).and_then(|about| about.modified()).ok(),
            Source::States(states) => states.of.changed(),
            Source::Among(..)
            | Source::Own(..)
            | Source::Environment(_)
            | Source::Episodes(_)
            | Source::Program(_) => None,
        }
    }
}

/// Why something cannot be opened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unopened(String);

impl fmt::Display for Unopened {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unopened {}

/// None of some files is a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoModel(usize);

impl fmt::Display for NoModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "none of {} files is a model: a model is MJCF or URDF, .xml, .mjcf or .urdf", self.0)
    }
}

impl std::error::Error for NoModel {}

/// What a path that was dropped leads to: a file, or what is nearest to the top of a folder or an archive.
pub(super) fn dropped(path: &Path) -> Result<Source, String> {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let mut files = Files::new();
    if path.is_dir() {
        add_folder(&mut files, path, &name)?;
    } else if is_archive(&name) {
        let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
        files.add(&name, bytes).map_err(|error| error.to_string())?;
    } else {
        return Ok(Source::File(path.to_owned()));
    }
    let source = Source::among(files).map_err(|error| format!("{name}: {error}"))?;
    // Models of a folder stay where they are, so that they are read again when they change.
    match (path.parent().filter(|_| path.is_dir()), source) {
        (Some(parent), Source::Among(_, inside)) => Ok(Source::File(parent.join(inside))),
        (_, source) => Ok(source),
    }
}

/// Deepest folder that is looked into.
const DEEPEST: usize = 32;

/// Lists the files of a folder.
fn add_folder(files: &mut Files, folder: &Path, name: &str) -> Result<(), String> {
    let wrong = |error: std::io::Error| format!("{}: {error}", folder.display());
    if name.matches('/').count() > DEEPEST {
        return Err(format!("{}: folders are nested more than {DEEPEST} deep", folder.display()));
    }
    for entry in std::fs::read_dir(folder).map_err(wrong)? {
        let entry = entry.map_err(wrong)?;
        let inside = format!("{name}/{}", entry.file_name().to_string_lossy());
        let kind = entry.file_type().map_err(wrong)?;
        if kind.is_dir() {
            add_folder(files, &entry.path(), &inside)?;
        } else if kind.is_file() {
            // Their contents are read where they are.
            files.insert(&inside, Vec::new()).map_err(|error| error.to_string())?;
        }
    }
    Ok(())
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
