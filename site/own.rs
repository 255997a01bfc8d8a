//! Models of our own, as pages show them.

use std::path::Path;

/// How descriptions begin of models that check something and are nothing to look at.
const PLAIN: &str = "Not a robot";

/// A model.
pub struct Own {
    /// Its name.
    pub name: String,
    /// What the command calls it.
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
/// A description cannot be read.
pub fn own_models(root: &Path) -> Result<Vec<Own>, String> {
    let mut list = Vec::new();
    for (name, path) in assets::models() {
        let text = assets::text(path).ok_or_else(|| format!("{path} is no model of our own"))?;
        let camera = text.split_once("<camera name=\"").and_then(|(_, rest)| rest.split_once('"'));
        let folder = path.split('/').next().unwrap_or_default();
        let file = format!("assets/{folder}/README.md");
        let readme = std::fs::read_to_string(root.join(&file)).map_err(|error| format!("{file}: {error}"))?;
        let (title, description) = readme.split_once('\n').unwrap_or((&readme, ""));
        list.push(Own {
            name: name.to_owned(),
            file: format!("hive/{path}"),
            title: title.trim_start_matches("# ").to_owned(),
            description: description.to_owned(),
            camera: camera.map(|(name, _)| name.to_owned()),
        });
    }
    Ok(list)
}
