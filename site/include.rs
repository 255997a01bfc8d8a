//! Parts of files of the repository in pages.

use crate::link::joined;
use std::path::Path;

/// The text that `{{#include FILE}}` or `{{#include FILE:ANCHOR}}` in `source` asks for, and the file in the repository.
///
/// # Errors
/// There is no such file or no such anchor.
pub fn included(root: &Path, source: &str, directive: &str) -> Result<(String, String), String> {
    let wanted = directive.trim_start_matches("{{#include ").trim_end_matches("}}").trim();
    let (path, anchor) = wanted.split_once(':').map_or((wanted, None), |(path, anchor)| (path, Some(anchor)));
    let file = joined(source, path);
    let text = std::fs::read_to_string(root.join(&file)).map_err(|error| format!("{file}: {error}"))?;
    let is_mark = |line: &&str| line.contains("ANCHOR: ") || line.contains("ANCHOR_END: ");
    let lines: Vec<&str> = match anchor {
        None => text.lines().filter(|line| !is_mark(line)).collect(),
        Some(anchor) => {
            let (begin, end) = (format!("ANCHOR: {anchor}"), format!("ANCHOR_END: {anchor}"));
            let inside = text.lines().skip_while(|line| !line.trim_end().ends_with(&begin)).skip(1);
            let inside: Vec<_> = inside.take_while(|line| !line.trim_end().ends_with(&end)).collect();
            if inside.is_empty() {
                return Err(format!("{file} has no anchor {anchor:?}"));
            }
            inside.into_iter().filter(|line| !is_mark(line)).collect()
        }
    };
    let blanks = |line: &&&str| line.len() - line.trim_start().len();
    let margin =
        lines.iter().filter(|line| !line.trim().is_empty()).map(|line| blanks(&line)).min().unwrap_or(0);
    let cut = |line: &&str| line.get(margin..).unwrap_or_default().to_owned() + "\n";
    Ok((lines.iter().map(cut).collect(), file))
}
