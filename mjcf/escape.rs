//! Text from files as a terminal may show it.

use std::fmt::{self, Display, Formatter, Write};

/// Text whose control characters, and marks that change the direction of writing, are shown as escapes: what a file
/// says can then neither command a terminal nor pose as another message.
pub(crate) struct Escaped<'a>(pub &'a str);

impl Display for Escaped<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for c in self.0.chars() {
            if c.is_control() || changes_direction(c) {
                write!(f, "{}", c.escape_default())?;
            } else {
                f.write_char(c)?;
            }
        }
        Ok(())
    }
}

/// Marks, embeddings, overrides and isolates of Unicode's bidirectional algorithm.
fn changes_direction(c: char) -> bool {
    matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_to_terminals_become_visible() {
        let text = Escaped("name\u{1b}[2J\r\nok \u{202e}txt\u{9b}1m é 机").to_string();
        assert_eq!(text, r"name\u{1b}[2J\r\nok \u{202e}txt\u{9b}1m é 机");
    }
}
