//! Models of our own, each with its description, live.

use crate::own::{Own, own_models as all};
use std::fmt::Write;
use std::path::Path;

/// A live model with the picture that stands in its place.
fn live(Own { name, camera, .. }: &Own) -> String {
    let camera = camera.as_ref().map_or(String::new(), |camera| format!(" camera=\"{camera}\""));
    format!(
        "<figure class=\"live\"><robohive-viewer own=\"{name}\"{camera} running></robohive-viewer>\
         <img src=\"../pictures/{name}.png\" alt=\"The model {name}\" width=\"960\" height=\"540\"></figure>\n"
    )
}

/// The descriptions in `assets/*/README.md`, a heading each, for a page in a folder.
///
/// # Errors
/// A model or its description cannot be read.
pub fn own_models(root: &Path) -> Result<String, String> {
    let mut text = String::new();
    let mut models = all(root)?;
    models.sort_by_key(|own| !own.is_shown());
    for own in models {
        let shown = if own.is_shown() { live(&own) } else { String::new() };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "## {}\n\n`{}`\n\n{shown}{}", own.title, own.name, own.description);
    }
    Ok(text)
}
