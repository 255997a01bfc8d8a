//! From a path or a text to a [`Model`], with every edit a program may ask for in between.

use std::io::{Cursor, Read};
use std::sync::Arc;

use physics::Model;
use physics::model::binary;

use crate::cache::{Cache, Miss, Noted};
use crate::compile::compile;
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::files::{Disk, FileProvider};
use crate::include::{Expansion, Substitution, report_unmatched};
use crate::read;
use crate::spec::Spec;
use crate::xml::{Element, Limits};

/// Reads models; the default reads from the whole disk and changes nothing.
#[derive(Clone)]
pub struct Loader {
    files: Arc<dyn FileProvider + Send + Sync>,
    limits: Limits,
    substitutions: Vec<Substitution>,
    moves: Vec<(String, String)>,
    cache: Option<Cache>,
}

impl Default for Loader {
    fn default() -> Self {
        Self {
            files: Arc::new(Disk::everywhere()),
            limits: Limits::default(),
            substitutions: Vec::new(),
            moves: Vec::new(),
            cache: None,
        }
    }
}

/// A model as its text describes it.
#[derive(Debug, Clone)]
pub struct Parsed {
    /// The elements.
    pub spec: Spec,
    /// The texts that they came from.
    pub sources: Sources,
    /// What was ignored or assumed; no errors.
    pub warnings: Diagnostics,
}

/// A model ready for physics.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The model.
    pub model: Model,
    /// What was ignored or assumed; no errors.
    pub warnings: Diagnostics,
}

/// Loads the model at `path`.
pub fn load(path: &str) -> Result<Loaded, Diagnostics> {
    Loader::default().load(path)
}

/// Loads a model from text.
pub fn load_str(text: &str) -> Result<Loaded, Diagnostics> {
    Loader::default().load_str(text)
}

/// Reads a model from text without compiling it.
pub fn parse_str(text: &str) -> Result<Parsed, Diagnostics> {
    Loader::default().parse_str(text)
}

impl Loader {
    /// Reads files from `files` instead of the disk.
    pub fn files(mut self, files: impl FileProvider + Send + Sync + 'static) -> Self {
        self.files = Arc::new(files);
        self
    }

    /// Replaces `from` by `to` in the text of every file, as templates such as `OBJECT_NAME` ask for.
    pub fn substitute(self, from: &str, to: &str) -> Self {
        self.replace(from, to, false)
    }

    /// As [`Loader::substitute`], but a model in which no text is replaced is an error.
    pub fn define(self, from: &str, to: &str) -> Self {
        self.replace(from, to, true)
    }

    fn replace(mut self, from: &str, to: &str, required: bool) -> Self {
        self.substitutions.push(Substitution { from: from.into(), to: to.into(), required });
        self
    }

    /// Moves the body `body` under the body `parent` before anything is read.
    pub fn reparent(mut self, body: &str, parent: &str) -> Self {
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

    /// The files that models are read from.
    pub fn provider(&self) -> &dyn FileProvider {
        &*self.files
    }

    /// Reads the model at `path` and all it includes.
    pub fn parse(&self, path: &str) -> Result<Parsed, Diagnostics> {
        self.finish(&*self.files, |expansion| expansion.read(path))
    }

    /// Reads a model from text; relative paths are sought from the provider's top.
    pub fn parse_str(&self, text: &str) -> Result<Parsed, Diagnostics> {
        self.finish(&*self.files, |expansion| expansion.expand("<text>", text.as_bytes()))
    }

    /// Reads and compiles the model at `path`, or takes it as it is when the file holds a compiled one.
    pub fn load(&self, path: &str) -> Result<Loaded, Diagnostics> {
        if let Some((mut source, length)) = self.open_compiled(path) {
            return self.load_compiled(path, &mut source, length);
        }
        match &self.cache {
            Some(cache) => self.load_cached(cache, path),
            None => self.compile(&*self.files, self.parse(path)?, None),
        }
    }

    /// The content of the file at `path` and its length, if it begins as a compiled model does.
    fn open_compiled(&self, path: &str) -> Option<(impl Read + use<>, u64)> {
        let (mut source, length) = self.files.open(path).ok()?;
        let mut mark = binary::MARK;
        source.read_exact(&mut mark).ok()?;
        binary::is_model(&mark).then(|| (Cursor::new(mark).chain(source), length))
    }

    /// Reads and compiles a model from text.
    pub fn load_str(&self, text: &str) -> Result<Loaded, Diagnostics> {
        self.compile(&*self.files, self.parse_str(text)?, None)
    }

    fn load_compiled(&self, path: &str, source: &mut dyn Read, length: u64) -> Result<Loaded, Diagnostics> {
        let edited = !self.substitutions.is_empty() || !self.moves.is_empty();
        let model = if edited {
            Err("a compiled model cannot be edited; edit the text and compile it".to_owned())
        } else {
            Model::read(source, length).map_err(|error| error.to_string())
        };
        let mut diagnostics = Diagnostics::default();
        match model {
            Ok(model) => Ok(Loaded { model, warnings: diagnostics }),
            Err(message) => {
                diagnostics.error(&Sources::default(), Loc::NONE, format!("{path}: {message}"));
                Err(diagnostics)
            }
        }
    }

    fn load_cached(&self, cache: &Cache, path: &str) -> Result<Loaded, Diagnostics> {
        let limits = format!("{:?}", self.limits);
        let required: Vec<_> = self.substitutions.iter().map(|s| s.required).collect();
        let counts = format!("{required:?} {}", self.moves.len());
        let replaced = self.substitutions.iter().flat_map(|s| [&*s.from, &*s.to]);
        let edits = replaced.chain(self.moves.iter().flat_map(|(body, parent)| [&**body, &**parent]));
        let request: Vec<&str> = [path, &limits, &counts].into_iter().chain(edits).collect();
        let damaged = match cache.find(&request, &*self.files) {
            Ok(loaded) => return Ok(loaded),
            Err(miss) => matches!(miss, Miss::Damaged),
        };
        let noted = Noted::new(&*self.files);
        let parsed = self.finish(&noted, |expansion| expansion.read(path))?;
        let mut loaded = self.compile(&noted, parsed, Some(cache))?;
        let kept = cache.keep(&request, noted.reads(), &loaded);
        let mut warn = |message: String| {
            loaded.warnings.warning(&Sources::default(), Loc::NONE, format!("{path}: {message}"));
        };
        if damaged {
            warn("the cached model was damaged; compiled anew".into());
        }
        if let Err(error) = kept {
            warn(format!("the model cannot be cached: {error}"));
        }
        Ok(loaded)
    }

    fn compile(
        &self,
        files: &dyn FileProvider,
        parsed: Parsed,
        cache: Option<&Cache>,
    ) -> Result<Loaded, Diagnostics> {
        let Parsed { spec, sources, warnings: mut diagnostics } = parsed;
        match compile(&spec, files, cache, &sources, &mut diagnostics) {
            Some(model) => Ok(Loaded { model, warnings: diagnostics }),
            None => Err(diagnostics),
        }
    }

    fn finish(
        &self,
        files: &dyn FileProvider,
        read: impl FnOnce(&mut Expansion<'_>) -> Option<Element>,
    ) -> Result<Parsed, Diagnostics> {
        let (mut sources, mut diagnostics) = (Sources::default(), Diagnostics::default());
        let mut matched = vec![false; self.substitutions.len()];
        let mut expansion = Expansion {
            files,
            substitutions: &self.substitutions,
            matched: &mut matched,
            limits: &self.limits,
            sources: &mut sources,
            diagnostics: &mut diagnostics,
        };
        let Some(mut root) = read(&mut expansion) else { return Err(diagnostics) };
        self.edit(&mut root, expansion.sources, expansion.diagnostics);
        let spec = read::read(&root, expansion);
        report_unmatched(&self.substitutions, &matched, &sources, &mut diagnostics);
        match spec.filter(|_| !diagnostics.has_errors()) {
            Some(spec) => Ok(Parsed { spec, sources, warnings: diagnostics }),
            None => Err(diagnostics),
        }
    }

    fn edit(&self, root: &mut Element, sources: &Sources, diagnostics: &mut Diagnostics) {
        for (body, parent) in &self.moves {
            if let Err(message) = root.reparent_body(body, parent) {
                diagnostics.error(sources, root.loc, message);
            }
        }
    }
}
