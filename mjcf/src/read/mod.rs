//! The expanded element tree to a [`Spec`].
//!
//! Sections are read in MuJoCo's order: settings, default classes, assets and constraints first, the body
//! tree last, because `replicate` copies what refers into it.

mod actuator;
mod asset;
mod attributes;
mod constraint;
mod defaults;
mod replicate;
mod sensor;
mod settings;
mod tree;

use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::files::FileProvider;
use crate::spec::Spec;
use crate::xml::Element;
use defaults::Classes;

/// Reads one section of the model.
type Section<R> = fn(&mut R, &Element);

/// What reading needs to know and what it fills.
pub struct Reader<'a> {
    sources: &'a Sources,
    diagnostics: &'a mut Diagnostics,
    files: &'a dyn FileProvider,
    /// Directory of the main file, which asset paths are tried from first.
    model_dir: String,
    classes: Classes,
    /// Elements made by `replicate` so far.
    copied: usize,
    spec: Spec,
}

/// Reads a checked tree; faulty values leave defaults behind and errors in `diagnostics`.
pub fn read(
    root: &Element,
    files: &dyn FileProvider,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) -> Spec {
    let model_dir = sources.get(root.loc.file).map_or(String::new(), |s| s.dir.clone());
    let mut reader = Reader {
        sources,
        diagnostics,
        files,
        model_dir,
        classes: Classes::default(),
        copied: 0,
        spec: Spec::default(),
    };
    reader.model(root);
    reader.spec
}

impl Reader<'_> {
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
        self.diagnostics.error(self.sources, loc, message);
    }

    fn error_with(&mut self, loc: Loc, message: impl Into<String>, advice: Option<String>) {
        self.diagnostics.error_with(self.sources, loc, message, advice);
    }

    fn unsupported(&mut self, loc: Loc, feature: &str) {
        self.error(loc, format!("{feature} are not supported: they are not simulated"));
    }
}
