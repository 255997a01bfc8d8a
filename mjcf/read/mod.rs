//! The expanded element tree to a [`Spec`].
//!
//! Sections are read in MuJoCo's order: settings, default classes, assets and constraints first, the body
//! tree last, because `replicate` and `attach` copy what refers into it. A model file that `attach` takes parts
//! of is read by a reader of its own.

mod actuator;
mod asset;
mod attach;
mod attributes;
mod conflict;
mod constraint;
mod copy;
mod dc_motor;
mod defaults;
mod model_file;
mod replicate;
mod sensor;
mod settings;
mod tree;

use std::collections::BTreeSet;

use crate::diagnostic::Loc;
use crate::include::Expansion;
use crate::schema::check;
use crate::schema::root::MUJOCO;
use crate::spec::{Body, Spec};
use crate::xml::Element;
use conflict::Authored;
use defaults::Classes;
use model_file::ModelFile;

/// Reads one section of the model.
type Section<R> = fn(&mut R, &Element);

/// What reading needs to know and what it fills.
pub struct Reader<'a> {
    /// Where texts come from and findings go.
    expansion: Expansion<'a>,
    /// Directory of the main file, which asset paths are tried from first.
    model_dir: String,
    classes: Classes,
    /// Elements made by `replicate` and `attach` so far.
    copied: usize,
    /// Numbers of assets that are computed instead of given, so far.
    computed: usize,
    /// Settings that the text gives, for conflicts with those of attached models.
    authored: Authored,
    /// Warnings about conflicts given already.
    warned: BTreeSet<String>,
    /// Models that `attach` takes parts of, in the order of the file.
    models: Vec<ModelFile>,
    /// Files of the models around this one, outermost first, and its own.
    open_files: Vec<String>,
    /// The bodies being read, outermost first.
    open: Vec<Body>,
    spec: Spec,
}

/// Checks and reads a tree; faulty values leave defaults behind and errors in the diagnostics. `None` when the
/// root is no model.
pub fn read(root: &Element, mut expansion: Expansion<'_>) -> Option<Spec> {
    check_root(root, &mut expansion)?;
    let path = expansion.sources.get(root.loc.file).map_or(String::new(), |s| s.path.clone());
    let mut reader = Reader::new(root, expansion, vec![path]);
    reader.model(root);
    Some(reader.spec)
}

/// Checks the element that holds the model, and everything below it.
fn check_root(root: &Element, expansion: &mut Expansion<'_>) -> Option<()> {
    let (sources, diagnostics) = (&*expansion.sources, &mut *expansion.diagnostics);
    match root.name.as_str() {
        "mujoco" => {}
        "mujocoinclude" => {
            diagnostics.warning(sources, root.loc, "root element <mujocoinclude> is read as <mujoco>");
        }
        "robot" => {
            diagnostics.error(sources, root.loc, "this is URDF: only MJCF is supported");
            return None;
        }
        other => {
            let message = format!("root element <{other}> is not <mujoco>");
            diagnostics.error(sources, root.loc, message);
            return None;
        }
    }
    check::check(root, &MUJOCO, sources, diagnostics);
    Some(())
}

impl<'a> Reader<'a> {
    fn new(root: &Element, expansion: Expansion<'a>, open_files: Vec<String>) -> Self {
        Reader {
            model_dir: expansion.sources.get(root.loc.file).map_or(String::new(), |s| s.dir.clone()),
            expansion,
            classes: Classes::default(),
            copied: 0,
            computed: 0,
            authored: Authored::default(),
            warned: BTreeSet::new(),
            models: Vec::new(),
            open_files,
            open: Vec::new(),
            spec: Spec::default(),
        }
    }

    fn model(&mut self, root: &Element) {
        self.spec.modelname = root.value("model").unwrap_or("MuJoCo Model").to_string();
        self.spec.world.name = "world".into();
        let sections: [(&str, Section<Self>); 15] = [
            ("compiler", Self::compiler),
            ("option", Self::option),
            ("size", Self::size),
            ("visual", Self::visual),
            ("statistic", Self::statistic),
            ("default", Self::top_default),
            ("custom", Self::custom),
            ("asset", Self::asset),
            ("contact", Self::contact),
            ("equality", Self::equality),
            ("tendon", Self::tendon),
            ("actuator", Self::actuator),
            ("sensor", Self::sensor),
            ("keyframe", Self::keyframe),
            ("worldbody", Self::worldbody),
        ];
        for (tag, read) in sections {
            root.children_named(tag).for_each(|section| read(self, section));
        }
    }

    fn error(&mut self, loc: Loc, message: impl Into<String>) {
        self.expansion.diagnostics.error(self.expansion.sources, loc, message);
    }

    fn warning(&mut self, loc: Loc, message: impl Into<String>) {
        self.expansion.diagnostics.warning(self.expansion.sources, loc, message);
    }

    fn error_with(&mut self, loc: Loc, message: impl Into<String>, advice: Option<String>) {
        self.expansion.diagnostics.error_with(self.expansion.sources, loc, message, advice);
    }

    fn unsupported(&mut self, loc: Loc, feature: &str) {
        self.error(loc, format!("{feature} are not supported: they are not simulated"));
    }
}
