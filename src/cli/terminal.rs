//! What a person sees: lines on standard output and standard error, with colour where a terminal shows it.
//!
//! Names, paths and messages may come from a file that somebody else wrote, so control characters never reach the
//! terminal: every line is escaped here, and only here are styles added. Colour is left out where the output is no
//! terminal, and where `NO_COLOR` or `TERM=dumb` asks for none.

use clap::builder::styling::{AnsiColor, Style};
use serde_json::Value;
use std::borrow::Cow;
use std::fmt::{self, Write as _};
use std::io::{ErrorKind, Write};

const GOOD: Style = AnsiColor::Green.on_default().bold();
const BAD: Style = AnsiColor::Red.on_default().bold();

/// Writes a line to standard output.
macro_rules! show {
    ($($text:tt)*) => { $crate::terminal::write_line(&$crate::terminal::printable(&format!($($text)*))) };
}
pub(crate) use show;

/// Writes a line that begins with a verdict in colour.
pub fn show_verdict(good: bool, before: &str, verdict: &str, after: &str) {
    let style = if good { GOOD } else { BAD };
    write_line(&format!("{}{style}{verdict}{style:#}{}", printable(before), printable(after)));
}

/// Writes a JSON value on one line.
pub fn show_json(value: &Value) {
    let mut text = String::new();
    for c in value.to_string().chars() {
        // Inside strings only; the rest of JSON is plain ASCII.
        match is_harmless(c) {
            true => text.push(c),
            false => c.encode_utf16(&mut [0; 2]).iter().for_each(|unit| _ = write!(text, "\\u{unit:04x}")),
        }
    }
    write_line(&text);
}

/// Writes a message, which may have several lines, to standard error.
pub fn complain(message: &str) {
    write_error(&format!("{BAD}robohive:{BAD:#} {}", printable_lines(message)));
}

/// Writes what does not stop a command, which may have several lines, to standard error.
pub fn note(message: &str) {
    write_error(&printable_lines(message));
}

/// `text` with control characters, and those that reorder or hide other characters, spelt out.
pub fn printable(text: &str) -> Cow<'_, str> {
    if text.chars().all(is_harmless) {
        return text.into();
    }
    let escaped = |c: char| if is_harmless(c) { c.to_string() } else { c.escape_default().to_string() };
    text.chars().map(escaped).collect()
}

fn printable_lines(text: &str) -> String {
    text.lines().map(printable).collect::<Vec<_>>().join("\n")
}

fn is_harmless(c: char) -> bool {
    let hidden = matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}');
    !(c.is_control() || hidden)
}

/// Writes a line to standard output as it is. A reader that has seen enough, such as `head`, ends the process silently.
pub fn write_line(line: &str) {
    let mut out = anstream::stdout().lock();
    leave_if_closed(writeln!(out, "{line}").and_then(|()| out.flush()));
}

/// Writes bytes to standard output as they are.
pub fn write_bytes(bytes: &[u8]) {
    let mut out = std::io::stdout().lock();
    leave_if_closed(out.write_all(bytes).and_then(|()| out.flush()));
}

fn leave_if_closed(written: std::io::Result<()>) {
    match written {
        Ok(()) => {}
        Err(error) if error.kind() == ErrorKind::BrokenPipe => std::process::exit(0),
        Err(error) => {
            complain(&format!("standard output: {error}"));
            std::process::exit(1);
        }
    }
}

/// Writes a line to standard error over the one that stands there, without beginning another; as much as the terminal has columns.
#[cfg(unix)]
pub fn redraw(line: &str) {
    let columns =
        terminal_size::terminal_size().map_or(80, |(terminal_size::Width(columns), _)| usize::from(columns));
    let text: String = printable(line).chars().take(columns.saturating_sub(1)).collect();
    _ = write!(anstream::stderr().lock(), "\r{text}\x1b[K");
}

/// There is nobody left to tell when standard error is closed.
fn write_error(text: &str) {
    _ = writeln!(anstream::stderr().lock(), "{text}");
}

/// Names for a message, quoted, at most `most` of them.
pub fn listed<T: fmt::Debug>(names: impl IntoIterator<Item = T>, most: usize) -> String {
    let mut names = names.into_iter();
    let mut text: Vec<_> = names.by_ref().take(most).map(|name| format!("{name:?}")).collect();
    let more = names.count();
    if more > 0 {
        text.push(format!("and {more} more"));
    }
    text.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_spelt_out() {
        assert_eq!(printable("plain näme 机"), "plain näme 机");
        assert_eq!(printable("a\u{1b}[31mb\u{9b}\u{7f}"), "a\\u{1b}[31mb\\u{9b}\\u{7f}");
        assert_eq!(printable("x\ny\u{202e}"), "x\\ny\\u{202e}");
        assert_eq!(printable_lines("one\ntwo\r\u{7}"), "one\ntwo\\r\\u{7}");
    }

    #[test]
    fn lists_say_how_much_they_leave_out() {
        assert_eq!(listed(["a", "b", "c"], 2), "\"a\", \"b\", and 1 more");
        assert_eq!(listed(["a"], 2), "\"a\"");
    }
}
