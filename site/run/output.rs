//! What blocks print beside what pages say that they do.

/// Lines of a message that are shown.
const SHOWN: usize = 40;

/// Whether the lines of `expected` were printed, in their order; `…` stands for any text, and as a line for any lines.
///
/// # Errors
/// The first line that was not.
pub fn agrees(expected: &str, printed: &str) -> Result<(), String> {
    let mut lines = printed.lines();
    for line in expected.lines().map(str::trim_end).filter(|line| !line.is_empty() && *line != "…") {
        if !lines.any(|found| fits(line.trim(), found.trim())) {
            return Err(line.to_owned());
        }
    }
    Ok(())
}

/// Whether `text` is `pattern`, in which `…` stands for any text.
fn fits(pattern: &str, text: &str) -> bool {
    let mut parts = pattern.split('…');
    let Some(mut rest) = parts.next().and_then(|first| text.strip_prefix(first)) else { return false };
    let parts: Vec<&str> = parts.collect();
    for (i, part) in parts.iter().enumerate() {
        if i + 1 == parts.len() {
            return rest.ends_with(part);
        }
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.is_empty()
}

/// A text that is not too long to be read.
pub fn listed(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    let more = lines.len().saturating_sub(SHOWN);
    let shown = lines.iter().take(SHOWN).map(|line| format!("    {line}")).collect::<Vec<_>>().join("\n");
    if more == 0 { shown } else { format!("{shown}\n    … and {more} more lines") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_lines_are_found_in_their_order() {
        let printed = "a 1\nnoise\nb 22 s\nc\n";
        assert_eq!(agrees("a 1\nb … s\nc", printed), Ok(()));
        assert_eq!(agrees("a …\n…\nc", printed), Ok(()));
        assert_eq!(agrees("c\na 1", printed), Err("a 1".into()));
        assert_eq!(agrees("b … m", printed), Err("b … m".into()));
        assert_eq!(agrees("a", printed), Err("a".into()));
    }

    #[test]
    fn dots_stand_for_any_text() {
        assert!(fits("…", "anything") && fits("a…b…c", "a1b2b3c") && fits("a…", "a"));
        assert!(!fits("a…b", "ab1") && !fits("ab…b", "ab"));
    }
}
