//! Which protocol a terminal speaks, from what it says in the environment.

use super::Protocol;

/// Values of TERM_PROGRAM.
const PROGRAMS: [(&str, Protocol); 5] = [
    ("ghostty", Protocol::Kitty),
    ("iTerm.app", Protocol::ITerm2),
    ("WezTerm", Protocol::ITerm2),
    ("mintty", Protocol::Sixel),
    ("contour", Protocol::Sixel),
];

/// Beginnings of TERM.
const TERMS: [(&str, Protocol); 6] = [
    ("xterm-kitty", Protocol::Kitty),
    ("xterm-ghostty", Protocol::Kitty),
    ("foot", Protocol::Sixel),
    ("mlterm", Protocol::Sixel),
    ("contour", Protocol::Sixel),
    ("yaft", Protocol::Sixel),
];

/// Beginnings of TERM of multiplexers: what the terminal around them can show does not come through.
const MULTIPLEXERS: [&str; 2] = ["screen", "tmux"];

/// First version of Konsole with Kitty's protocol, as KONSOLE_VERSION has it.
const KONSOLE: u32 = 220_400;

impl Protocol {
    /// The protocol of the terminal that this process runs in, or none if TERM is unset, empty or `dumb`.
    ///
    /// Whether the output is a terminal at all is for the caller to ask.
    pub fn detect() -> Option<Self> {
        Self::from_environment(|name| std::env::var(name).ok())
    }

    /// The same from any set of variables: TERM, TERM_PROGRAM, KITTY_WINDOW_ID, KONSOLE_VERSION, TMUX, COLORTERM.
    pub fn from_environment(variable: impl Fn(&str) -> Option<String>) -> Option<Self> {
        let value = |name: &str| variable(name).unwrap_or_default();
        let term = value("TERM");
        if term.is_empty() || term == "dumb" {
            return None;
        }
        let multiplexed = !value("TMUX").is_empty() || MULTIPLEXERS.iter().any(|name| term.starts_with(name));
        let pictures = match multiplexed {
            true => None,
            false => graphics(&term, &value),
        };
        Some(pictures.unwrap_or_else(|| match value("COLORTERM").as_str() {
            "truecolor" | "24bit" => Protocol::HalfBlocks,
            _ if term.contains("direct") => Protocol::HalfBlocks,
            _ => Protocol::HalfBlocks256,
        }))
    }
}

/// A protocol for real pixels, where one is known to work. The innermost program sets TERM, so it goes first.
fn graphics(term: &str, value: &impl Fn(&str) -> String) -> Option<Protocol> {
    let named = TERMS.iter().find(|(name, _)| term.starts_with(name)).map(|&(_, protocol)| protocol);
    let program = value("TERM_PROGRAM");
    named
        .or_else(|| term.contains("sixel").then_some(Protocol::Sixel))
        .or_else(|| PROGRAMS.iter().find(|(name, _)| *name == program).map(|&(_, protocol)| protocol))
        .or_else(|| (!value("KITTY_WINDOW_ID").is_empty()).then_some(Protocol::Kitty))
        .or_else(|| {
            let version = value("KONSOLE_VERSION").parse::<u32>().ok()?;
            (version >= KONSOLE).then_some(Protocol::Kitty)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(variables: &[(&str, &str)]) -> Option<Protocol> {
        Protocol::from_environment(|name| {
            variables.iter().find(|(key, _)| *key == name).map(|(_, value)| (*value).to_owned())
        })
    }

    #[test]
    fn terminals_are_known_by_their_variables() {
        assert_eq!(found(&[]), None);
        assert_eq!(found(&[("TERM", "dumb"), ("COLORTERM", "truecolor")]), None);
        assert_eq!(found(&[("TERM", "xterm-kitty")]), Some(Protocol::Kitty));
        assert_eq!(found(&[("TERM", "xterm-256color"), ("KITTY_WINDOW_ID", "1")]), Some(Protocol::Kitty));
        assert_eq!(found(&[("TERM", "xterm"), ("KONSOLE_VERSION", "230401")]), Some(Protocol::Kitty));
        assert_eq!(found(&[("TERM", "xterm"), ("KONSOLE_VERSION", "190401")]), Some(Protocol::HalfBlocks256));
        assert_eq!(
            found(&[("TERM", "xterm-256color"), ("TERM_PROGRAM", "iTerm.app")]),
            Some(Protocol::ITerm2)
        );
        assert_eq!(found(&[("TERM", "foot-extra")]), Some(Protocol::Sixel));
        assert_eq!(found(&[("TERM", "xterm"), ("COLORTERM", "24bit")]), Some(Protocol::HalfBlocks));
        assert_eq!(found(&[("TERM", "xterm-256color")]), Some(Protocol::HalfBlocks256));
    }

    #[test]
    fn a_multiplexer_hides_the_terminal_around_it() {
        let inside = [("TERM", "tmux-256color"), ("KITTY_WINDOW_ID", "1"), ("COLORTERM", "truecolor")];
        assert_eq!(found(&inside), Some(Protocol::HalfBlocks));
        assert_eq!(found(&[("TERM", "xterm-kitty"), ("TMUX", "socket,1,0")]), Some(Protocol::HalfBlocks256));
    }
}
