//! The expanded element tree to a [`Spec`].
//!
//! Sections are read in MuJoCo's order: settings, default classes, assets and constraints first, the body
//! tree last, because `replicate` and `attach` copy what refers into it. A model file that `attach` takes parts
//! of is read by a reader of its own. URDF has other sections and the same elements.

mod actuator;
mod asset;
mod attach;
mod attached_frames;
mod attributes;
mod authored;
mod cable_skin;
mod composite;
mod conflict;
mod constraint;
pub(crate) mod copy;
mod dc_motor;
mod defaults;
mod deformable;
mod flexcomp;
mod kept;
mod model_file;
mod plugin;
mod reader;
mod replicate;
mod sensor;
mod settings;
mod tree;
mod urdf;

use crate::include::Expansion;
use crate::spec::Spec;
use crate::xml::Element;
pub use authored::Authored;
pub(crate) use kept::rename_files;
use reader::check_root;
pub(crate) use reader::{ModelFile, Reader};
pub(crate) use tree::Place;

/// Reads one section of the model.
type Section<R> = fn(&mut R, &Element);

/// Checks and reads a tree, and notes which settings it gives; faulty values leave defaults behind and errors in the diagnostics. `None` when the
/// root is no model.
pub fn read(root: &Element, mut expansion: Expansion<'_>) -> Option<(Spec, Authored)> {
    if root.name.eq_ignore_ascii_case("robot") {
        return Some((urdf::read(root, expansion), Authored::default()));
    }
    check_root(root, &mut expansion)?;
    let path = expansion.sources.get(root.loc.file).map_or(String::new(), |s| s.path.clone());
    let mut reader = Reader::new(root, expansion, vec![path]);
    reader.model(root);
    Some((reader.spec, reader.authored))
}

impl Reader<'_> {
    /// Reads all sections.
    fn model(&mut self, root: &Element) {
        self.spec.modelname = root.value("model").unwrap_or("MuJoCo Model").to_string();
        self.spec.world.name = "world".into();
        self.sections(root);
    }

    /// Reads the sections below `root` into what is there.
    pub(crate) fn sections(&mut self, root: &Element) {
        let sections: [(&str, Section<Self>); 17] = [
            ("compiler", Self::compiler),
            ("option", Self::option),
            ("size", Self::size),
            ("visual", Self::visual),
            ("statistic", Self::statistic),
            ("default", Self::top_default),
            ("extension", Self::extensions),
            ("custom", Self::custom),
            ("asset", Self::asset),
            ("contact", Self::contact),
            ("deformable", Self::deformable),
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
}
