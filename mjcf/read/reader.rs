//! What reading a model needs to know and what it fills; the sections are read in files of their own.

use std::collections::BTreeSet;

use super::authored::Authored;
use crate::diagnostic::Loc;
use crate::include::Expansion;
use crate::schema::check;
use crate::schema::root::MUJOCO;
use crate::spec::{Body, Spec};
use crate::xml::Element;

/// What reading needs to know and what it fills.
pub(crate) struct Reader<'a> {
    /// Where texts come from and findings go.
    pub(crate) expansion: Expansion<'a>,
    /// Directory of the main file, which asset paths are tried from first.
    pub(super) model_dir: String,
    /// Elements made by `replicate` and `attach` so far.
    pub(super) copied: usize,
    /// Settings that the text gives, for conflicts with attached models.
    pub(crate) authored: Authored,
    /// Warnings about conflicts given already.
    pub(super) warned: BTreeSet<String>,
    /// Models that `attach` takes parts of, in the order of the file.
    pub(super) models: Vec<ModelFile>,
    /// Files of the models around this one, outermost first, and its own.
    pub(super) open_files: Vec<String>,
    /// The bodies being read, outermost first.
    pub(crate) open: Vec<Body>,
    pub(crate) spec: Spec,
}

/// A model whose parts may be attached.
pub(crate) struct ModelFile {
    /// What `attach` calls it.
    pub name: String,
    /// Index of its first text; texts of models inside it follow.
    pub first_file: u32,
    /// Its elements.
    pub spec: Spec,
    /// The settings that its text gives.
    pub authored: Authored,
}

/// Checks the element that holds the model, and everything below it.
pub(super) fn check_root(root: &Element, expansion: &mut Expansion<'_>) -> Option<()> {
    let (sources, diagnostics) = (&*expansion.sources, &mut *expansion.diagnostics);
    match root.name.as_str() {
        "mujoco" => {}
        "mujocoinclude" => {
            diagnostics.warning(sources, root.loc, "root element <mujocoinclude> is read as <mujoco>");
        }
        "robot" => {
            diagnostics.error(
                sources,
                root.loc,
                "this is URDF: parts can be attached from MJCF alone; convert it first",
            );
            return None;
        }
        other => {
            let message = format!("root element <{other}> is not <mujoco>");
            diagnostics.error(sources, root.loc, message);
            return None;
        }
    }
    check::check(root, &MUJOCO, expansion.whole, sources, diagnostics);
    Some(())
}

impl<'a> Reader<'a> {
    /// A reader of the model at `root`, inside the models of `open_files`.
    pub(crate) fn new(root: &Element, expansion: Expansion<'a>, open_files: Vec<String>) -> Self {
        Reader {
            model_dir: expansion.sources.get(root.loc.file).map_or(String::new(), |s| s.dir.clone()),
            expansion,
            copied: 0,
            authored: Authored::default(),
            warned: BTreeSet::new(),
            models: Vec::new(),
            open_files,
            open: Vec::new(),
            spec: Spec::default(),
        }
    }

    pub(super) fn error(&mut self, loc: Loc, message: impl Into<String>) {
        self.expansion.diagnostics.error(self.expansion.sources, loc, message);
    }

    /// Adds `bytes` that `what` asks for to the budget; false, with an error at `loc`, when they are beyond it.
    pub(super) fn charge(&mut self, loc: Loc, what: &str, bytes: usize) -> bool {
        let Expansion { budget, sources, diagnostics, .. } = &mut self.expansion;
        budget.charge(sources, diagnostics, loc, (what, bytes))
    }

    pub(super) fn warning(&mut self, loc: Loc, message: impl Into<String>) {
        self.expansion.diagnostics.warning(self.expansion.sources, loc, message);
    }

    pub(super) fn error_with(&mut self, loc: Loc, message: impl Into<String>, advice: Option<String>) {
        self.expansion.diagnostics.error_with(self.expansion.sources, loc, message, advice);
    }
}
