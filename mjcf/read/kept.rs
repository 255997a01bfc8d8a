//! The text as its author wrote it, includes in place: only files of assets and of models are named as they are found from
//! elsewhere.

use super::reader::Reader;
use crate::include::Expansion;
use crate::schema::asset::SIDES;
use crate::xml::{Attribute, Element};

/// Attributes of `compiler` that say where files are.
const FOLDERS: [&str; 4] = ["assetdir", "meshdir", "texturedir", "strippath"];

/// Names the files of `root` by what `name` makes of the path that is opened.
pub(crate) fn rename_files(
    root: &mut Element,
    expansion: Expansion<'_>,
    name: &mut dyn FnMut(&str) -> String,
) {
    let path = expansion.sources.get(root.loc.file).map_or(String::new(), |s| s.path.clone());
    let mut reader = Reader::new(root, expansion, vec![path]);
    root.children_named("compiler").for_each(|section| reader.compiler(section));
    for section in &mut root.children {
        match section.name.as_str() {
            "compiler" => section.attributes.retain(|a| !FOLDERS.contains(&a.name.as_str())),
            "asset" | "deformable" => {
                section.children.iter_mut().for_each(|asset| rename(asset, &reader, name))
            }
            "worldbody" => rename_below(section, &reader, name),
            _ => {}
        }
    }
}

/// Names the files of the flexcomps in a body.
fn rename_below(body: &mut Element, reader: &Reader<'_>, name: &mut dyn FnMut(&str) -> String) {
    for child in &mut body.children {
        if child.name == "flexcomp" {
            rename(child, reader, name);
        } else {
            rename_below(child, reader, name);
        }
    }
}

fn rename(asset: &mut Element, reader: &Reader<'_>, name: &mut dyn FnMut(&str) -> String) {
    let compiler = &reader.spec.compiler;
    let dir = match asset.name.as_str() {
        "texture" => &compiler.texturedir,
        "mesh" | "hfield" | "skin" | "flexcomp" => &compiler.meshdir,
        _ => "",
    };
    let called = stem(asset.value("file").unwrap_or_default());
    for attribute in &mut asset.attributes {
        if attribute.name == "file" || SIDES.contains(&attribute.name.as_str()) {
            let (file, _) = reader.asset_file(attribute, dir);
            if !file.is_empty() {
                attribute.value = name(&file);
            }
        }
    }
    // What is called by its file keeps what it is called.
    let is_called = !matches!(asset.name.as_str(), "model" | "flexcomp");
    let unnamed = is_called && asset.value("name").unwrap_or_default().is_empty();
    if unnamed && !called.is_empty() && stem(asset.value("file").unwrap_or_default()) != called {
        asset.attributes.retain(|a| a.name != "name");
        asset.attributes.insert(0, Attribute { name: "name".into(), value: called, ..Attribute::default() });
    }
}

fn stem(path: &str) -> String {
    crate::spec::asset_name("", path)
}
