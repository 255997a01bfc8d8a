//! Models of our own, as pages show them.

use crate::stage::names;
use std::path::Path;

/// How descriptions begin of models that check something and are nothing to look at.
const PLAIN: &str = "Not a robot";

/// A model in `assets/`.
pub struct Own {
    /// Its name: of its file, without the ending.
    pub name: String,
    /// The file, in the repository.
    pub file: String,
    /// What README.md calls it.
    pub title: String,
    /// What README.md says of it, in Markdown.
    pub description: String,
    /// Its first camera.
    pub camera: Option<String>,
}

impl Own {
    /// Whether it is something to look at.
    pub fn is_shown(&self) -> bool {
        !self.description.trim_start().starts_with(PLAIN)
    }
}

/// All models of our own, by the names of their folders.
///
/// # Errors
/// A model or its description cannot be read.
pub fn own_models(root: &Path) -> Result<Vec<Own>, String> {
    let read =
        |file: &str| std::fs::read_to_string(root.join(file)).map_err(|error| format!("{file}: {error}"));
    let mut list = Vec::new();
    for folder in names(root, "assets")?.into_iter().filter(|name| root.join("assets").join(name).is_dir()) {
        let files = names(root, &format!("assets/{folder}"))?;
        let Some((name, file)) = files.iter().find_map(|file| Some((file.strip_suffix(".xml")?, file)))
        else {
            continue;
        };
        let file = format!("assets/{folder}/{file}");
        let text = read(&file)?;
        let camera = text.split_once("<camera name=\"").and_then(|(_, rest)| rest.split_once('"'));
        let readme = read(&format!("assets/{folder}/README.md"))?;
        let (title, description) = readme.split_once('\n').unwrap_or((&readme, ""));
        list.push(Own {
            name: name.to_owned(),
            file,
            title: title.trim_start_matches("# ").to_owned(),
            description: description.to_owned(),
            camera: camera.map(|(name, _)| name.to_owned()),
        });
    }
    Ok(list)
}
