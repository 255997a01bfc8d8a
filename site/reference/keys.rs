//! Keys of the viewer, from the table that its help shows.

use super::cell;
use std::fmt::Write;
use viewer::shortcuts;

/// Keys with what they do.
pub fn keys() -> String {
    let mut text = String::from("| key | does |\n|---|---|\n");
    for shortcut in shortcuts() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "| `{}` | {} |", shortcut.key, cell(&shortcut.name));
    }
    text
}
