//! Blocks that are no programs: models are compiled and stepped, the others read.

use super::command::Run;
use crate::block::Block;
use crate::html::tags;
use std::path::Path;

/// Loads a model and takes a step; files that it names are those of the page.
pub fn model(folder: &Path, block: &Block) -> Run {
    let loaded = match &block.marks.file {
        Some(name) => mjcf::load(folder.join(name)),
        None => mjcf::load_str(&block.text),
    };
    let folder = format!("{}/", folder.display());
    let outcome = loaded.map_err(|error| error.to_string().replace(&folder, "")).and_then(|loaded| {
        let mut data = physics::Data::new(&loaded.model);
        physics::step(&loaded.model, &mut data).map_err(|error| error.to_string())?;
        Ok(loaded.warnings.to_string().replace(&folder, ""))
    });
    ended(outcome)
}

/// Reads TOML.
pub fn toml(block: &Block) -> Run {
    ended(block.text.parse::<toml::Table>().map(|_| String::new()).map_err(|error| error.to_string()))
}

/// Reads JSON.
pub fn json(block: &Block) -> Run {
    let read: Result<serde_json::Value, _> = serde_json::from_str(&block.text);
    ended(read.map(|_| String::new()).map_err(|error| error.to_string()))
}

fn ended(outcome: Result<String, String>) -> Run {
    match outcome {
        Ok(printed) => Run::Ended { well: true, printed },
        Err(reason) => Run::failed(reason),
    }
}

/// Attributes that any element may have.
const ANY: [&str; 7] = ["id", "class", "style", "title", "hidden", "lang", "tabindex"];

/// Whether `<robohive-viewer>` knows all attributes that a block of HTML gives it.
///
/// # Errors
/// The element's sources cannot be read.
pub fn element(root: &Path, block: &Block) -> Result<Run, String> {
    let file = root.join("web/page/robohive.js");
    let text = std::fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
    let known = |name: &str| ANY.contains(&name) || text.contains(&format!("\"{name}\""));
    let elements = tags(&block.text).into_iter().filter(|tag| tag.name == "robohive-viewer");
    let unknown: Vec<String> =
        elements.flat_map(|tag| tag.attributes).map(|(name, _)| name).filter(|name| !known(name)).collect();
    Ok(match unknown.is_empty() {
        true => Run::Ended { well: true, printed: String::new() },
        false => Run::failed(format!("<robohive-viewer> has no attribute {}", unknown.join(", "))),
    })
}
