//! References made from the code, as Markdown.

mod environments;
mod format;
mod javascript;
mod keys;
mod models;

pub use environments::{environments, sizes};
pub use format::{dropped, format, sensors};
pub use javascript::javascript;
pub use keys::keys;
pub use models::own_models;

/// Text in a cell of a table: no line ends, and no bar that would end it.
fn cell(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

/// Text that no mark of it turns into something else.
fn plain(text: &str) -> String {
    text.replace('<', "&lt;").replace('*', "\\*").replace('_', "\\_").replace('[', "\\[")
}
