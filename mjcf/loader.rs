//! From a path or a text to a [`Model`], with every edit a program may ask for in between.

use std::io::{Cursor, Read};
use std::path::Path;
use std::sync::Arc;

use physics::Model;
use physics::model::binary;
use physics::plugin::Registry;

use crate::budget::Budget;
use crate::cache::{Cache, Miss, Noted};
use crate::compile::{Resources, compile};
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::files::{Disk, FileProvider};
use crate::include::{Expansion, Substitution, report_unmatched};
use crate::loaded::Loaded;
use crate::mesh::stored::MeshStore;
use crate::read::{self, Authored};
use crate::spec::Spec;
use crate::write::text;
use crate::xml::{Element, Limits};

/// Reads models; the default reads from the whole disk and changes nothing.
#[derive(Clone)]
pub struct Loader {
    files: Arc<dyn FileProvider + Send + Sync>,
    limits: Limits,
    substitutions: Vec<Substitution>,
    moves: Vec<(String, String)>,
    cache: Option<Cache>,
    plugins: Registry,
}

impl Default for Loader {
    fn default() -> Self {
        Self {
            files: Arc::new(Disk::everywhere()),
            limits: Limits::default(),
            substitutions: Vec::new(),
            moves: Vec::new(),
            cache: None,
            plugins: Registry::default(),
        }
    }
}

/// A model as its text describes it.
#[derive(Debug, Clone)]
pub struct Parsed {
    /// The elements.
    pub spec: Spec,
    /// Settings that the text gives, as opposed to those left at their defaults.
    pub authored: Authored,
    /// The texts that they came from.
    pub sources: Sources,
    /// What was ignored or assumed; no errors.
    pub warnings: Diagnostics,
    /// Memory asked for so far.
    budget: Budget,
}

/// Loads the model at `path`, as [`Loader::load`] of the default loader does.
///
/// # Errors
/// All that is wrong with the model, each finding with its place in a file.
pub fn load(path: impl AsRef<Path>) -> Result<Loaded, Diagnostics> {
    Loader::default().load(path)
}

/// Loads a model from text; files that it names are looked up from the working directory.
///
/// # Errors
/// All that is wrong with the model, each finding with its place in the text.
pub fn load_str(text: impl AsRef<str>) -> Result<Loaded, Diagnostics> {
    Loader::default().load_str(text)
}

/// Reads a model from text without compiling it.
///
/// # Errors
/// All that is wrong with the text, each finding with its place.
pub fn parse_str(text: impl AsRef<str>) -> Result<Parsed, Diagnostics> {
    Loader::default().parse_str(text)
}

/// What is gathered while one model is read.
struct Gathered {
    /// Which template replacements have replaced something.
    matched: Vec<bool>,
    budget: Budget,
    sources: Sources,
    diagnostics: Diagnostics,
}

impl Gathered {
    fn of(loader: &Loader) -> Self {
        Gathered {
            matched: vec![false; loader.substitutions.len()],
            budget: Budget::new(loader.limits.memory),
            sources: Sources::default(),
            diagnostics: Diagnostics::default(),
        }
    }

    /// The expansion of includes that fills it; a `whole` model declares all names that it uses.
    fn expansion<'a>(
        &'a mut self,
        loader: &'a Loader,
        files: &'a dyn FileProvider,
        whole: bool,
    ) -> Expansion<'a> {
        Expansion {
            files,
            whole,
            substitutions: &loader.substitutions,
            matched: &mut self.matched,
            limits: &loader.limits,
            budget: &mut self.budget,
            sources: &mut self.sources,
            diagnostics: &mut self.diagnostics,
        }
    }
}

impl Loader {
    /// Reads files from `files` instead of the disk.
    pub fn files(mut self, files: impl FileProvider + Send + Sync + 'static) -> Self {
        self.files = Arc::new(files);
        self
    }

    /// Replaces `from` by `to` in the text of every file, as templates such as `OBJECT_NAME` ask for.
    pub fn substitute(self, from: impl Into<String>, to: impl Into<String>) -> Self {
        self.replace(from.into(), to.into(), false)
    }

    /// As [`Loader::substitute`], but a model in which no text is replaced is an error.
    pub fn define(self, from: impl Into<String>, to: impl Into<String>) -> Self {
        self.replace(from.into(), to.into(), true)
    }

    fn replace(mut self, from: String, to: String, required: bool) -> Self {
        self.substitutions.push(Substitution { from, to, required });
        self
    }

    /// Moves the body `body` under the body `parent` before anything is read.
    pub fn reparent(mut self, body: impl Into<String>, parent: impl Into<String>) -> Self {
        self.moves.push((body.into(), parent.into()));
        self
    }

    /// Bounds what a text may cost.
    pub fn limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Takes models that were compiled of the same content from a cache, and keeps others there.
    pub fn cache(mut self, cache: Cache) -> Self {
        self.cache = Some(cache);
        self
    }

    /// Knows the plugins of `registry` instead of MuJoCo's alone.
    pub fn plugins(mut self, registry: Registry) -> Self {
        self.plugins = registry;
        self
    }

    /// Reads the model at `path` and all it includes, without compiling it. Names that nothing declares are found when it is
    /// compiled: what declares them may be added before.
    ///
    /// # Errors
    /// All that is wrong with the texts; a path that is not UTF-8.
    pub fn parse(&self, path: impl AsRef<Path>) -> Result<Parsed, Diagnostics> {
        let path = text_of(path.as_ref())?;
        self.parse_from(&*self.files, false, |expansion| expansion.read(path))
    }

    /// Reads a model from text; relative paths start at the top of the file provider.
    ///
    /// # Errors
    /// All that is wrong with the texts.
    pub fn parse_str(&self, text: impl AsRef<str>) -> Result<Parsed, Diagnostics> {
        self.parse_text(text.as_ref(), false)
    }

    fn parse_text(&self, text: &str, whole: bool) -> Result<Parsed, Diagnostics> {
        self.parse_from(&*self.files, whole, |expansion| expansion.expand("<text>", text.as_bytes()))
    }

    /// The text of the model at `path` with includes in their places and every edit made, and else as its author wrote
    /// it: default classes, shortcuts and units. `name` says how the text names a file, given the path that is opened.
    ///
    /// # Errors
    /// All that is wrong with the texts; a path that is not UTF-8.
    pub fn flatten(
        &self,
        path: impl AsRef<Path>,
        mut name: impl FnMut(&str) -> String,
    ) -> Result<String, Diagnostics> {
        let path = text_of(path.as_ref())?;
        let mut gathered = Gathered::of(self);
        let mut expansion = gathered.expansion(self, &*self.files, false);
        let Some(mut root) = expansion.read(path) else { return Err(gathered.diagnostics) };
        if root.name.eq_ignore_ascii_case("robot") {
            return Err(Diagnostics::of_error(
                "a URDF has no default classes to keep: write it as MJCF with all resolved",
            ));
        }
        self.edit(&mut root, expansion.sources, expansion.diagnostics);
        read::rename_files(&mut root, expansion, &mut name);
        match gathered.diagnostics.has_errors() {
            true => Err(gathered.diagnostics),
            false => text::print(&root, self.limits.depth).map_err(Diagnostics::of_error),
        }
    }

    /// Compiles what [`Loader::parse`] read, and what a program may have changed in it; assets come from the same
    /// files.
    ///
    /// # Errors
    /// All that is wrong with the elements and the assets.
    pub fn compile(&self, parsed: Parsed) -> Result<Loaded, Diagnostics> {
        compile_from(self.resources(&*self.files, None), parsed)
    }

    /// Reads and compiles the model at `path`, or takes it as it is when the file holds a compiled one.
    ///
    /// # Errors
    /// All that is wrong with the model; a path that is not UTF-8.
    pub fn load(&self, path: impl AsRef<Path>) -> Result<Loaded, Diagnostics> {
        let path = text_of(path.as_ref())?;
        if let Some((mut source, length)) = self.open_compiled(path) {
            return self.load_compiled(path, &mut source, length);
        }
        match &self.cache {
            Some(cache) => self.load_cached(cache, path),
            None => self.compile(self.parse_from(&*self.files, true, |expansion| expansion.read(path))?),
        }
    }

    /// Reads and compiles a model from text.
    ///
    /// # Errors
    /// All that is wrong with the model.
    pub fn load_str(&self, text: impl AsRef<str>) -> Result<Loaded, Diagnostics> {
        self.compile(self.parse_text(text.as_ref(), true)?)
    }

    /// The content of the file at `path` and its length, if it begins as a compiled model does.
    fn open_compiled(&self, path: &str) -> Option<(impl Read + use<>, u64)> {
        let (mut source, length) = self.files.open(path).ok()?;
        let mut mark = binary::MARK;
        source.read_exact(&mut mark).ok()?;
        binary::is_model(&mark).then(|| (Cursor::new(mark).chain(source), length))
    }

    fn load_compiled(&self, path: &str, source: &mut dyn Read, length: u64) -> Result<Loaded, Diagnostics> {
        let edited = !self.substitutions.is_empty() || !self.moves.is_empty();
        let model = if edited {
            Err("a compiled model cannot be edited; edit the text and compile it".to_owned())
        } else {
            Model::read_with(source, length, &self.plugins).map_err(|error| error.to_string())
        };
        match model {
            Ok(model) => Ok(Loaded { model, warnings: Diagnostics::default() }),
            Err(message) => Err(Diagnostics::of_error(format!("{path}: {message}"))),
        }
    }

    fn load_cached(&self, cache: &Cache, path: &str) -> Result<Loaded, Diagnostics> {
        let limits = format!("{:?}", self.limits);
        let required: Vec<_> = self.substitutions.iter().map(|s| s.required).collect();
        let counts = format!("{required:?} {}", self.moves.len());
        let replaced = self.substitutions.iter().flat_map(|s| [&*s.from, &*s.to]);
        let edits = replaced.chain(self.moves.iter().flat_map(|(body, parent)| [&**body, &**parent]));
        let request: Vec<&str> =
            [path, &limits, &counts].into_iter().chain(edits).chain(self.plugins.names()).collect();
        let damaged = match cache.find_model(&request, &*self.files, &self.plugins) {
            Ok(loaded) => return Ok(loaded),
            Err(miss) => matches!(miss, Miss::Damaged),
        };
        let noted = Noted::new(&*self.files);
        let parsed = self.parse_from(&noted, true, |expansion| expansion.read(path))?;
        let mut loaded = compile_from(self.resources(&noted, Some(cache)), parsed)?;
        let kept = cache.keep_model(&request, noted.reads(), &loaded);
        let mut warn = |message: String| {
            loaded.warnings.warning(&Sources::default(), Loc::NONE, format!("{path}: {message}"));
        };
        if damaged {
            warn("the cached model was damaged; it was compiled again".into());
        }
        if let Err(error) = kept {
            warn(format!("the model cannot be cached: {error}"));
        }
        Ok(loaded)
    }

    fn parse_from(
        &self,
        files: &dyn FileProvider,
        whole: bool,
        read: impl FnOnce(&mut Expansion<'_>) -> Option<Element>,
    ) -> Result<Parsed, Diagnostics> {
        let mut gathered = Gathered::of(self);
        let mut expansion = gathered.expansion(self, files, whole);
        let Some(mut root) = read(&mut expansion) else { return Err(gathered.diagnostics) };
        self.edit(&mut root, expansion.sources, expansion.diagnostics);
        let read = read::read(&root, expansion);
        let Gathered { matched, budget, sources, mut diagnostics } = gathered;
        report_unmatched(&self.substitutions, &matched, &sources, &mut diagnostics);
        match read.filter(|_| !diagnostics.has_errors()) {
            Some((spec, authored)) => Ok(Parsed { spec, authored, sources, warnings: diagnostics, budget }),
            None => Err(diagnostics),
        }
    }

    fn resources<'a>(&'a self, files: &'a dyn FileProvider, meshes: Option<&'a Cache>) -> Resources<'a> {
        Resources { files, meshes: meshes.map(|cache| cache as &dyn MeshStore), registry: &self.plugins }
    }

    fn edit(&self, root: &mut Element, sources: &Sources, diagnostics: &mut Diagnostics) {
        for (body, parent) in &self.moves {
            if let Err(message) = root.reparent_body(body, parent) {
                diagnostics.error(sources, root.loc, message);
            }
        }
    }
}

fn compile_from(resources: Resources<'_>, parsed: Parsed) -> Result<Loaded, Diagnostics> {
    let Parsed { spec, sources, warnings: mut diagnostics, budget, .. } = parsed;
    match compile(&spec, resources, &sources, &mut diagnostics, budget) {
        Some(model) => Ok(Loaded { model, warnings: diagnostics }),
        None => Err(diagnostics),
    }
}

/// A path as text: paths of models have one spelling on disk, in memory and in include elements.
fn text_of(path: &Path) -> Result<&str, Diagnostics> {
    path.to_str().ok_or_else(|| {
        let shown = path.display();
        Diagnostics::of_error(format!(
            "the path '{shown}' is not UTF-8, as paths of models must be; rename it"
        ))
    })
}
