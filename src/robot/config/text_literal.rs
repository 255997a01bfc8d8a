//! Python's text literals: quoted once or three times, raw or with escapes.

/// A literal at the beginning of a text.
pub(super) struct TextLiteral<'a> {
    text: &'a str,
    /// Letters before the quotes.
    prefix: &'a str,
    /// One or three quotes.
    quotes: &'a str,
}

/// Where in the literal something is wrong, and what.
type Wrong = (usize, String);

impl<'a> TextLiteral<'a> {
    /// The literal that `text` begins with, if it does.
    pub(super) fn begin(text: &'a str) -> Option<Self> {
        let start = text.find(['\'', '"'])?;
        let prefix = &text[..start];
        let known = prefix.len() <= 2 && prefix.bytes().all(|byte| byte.is_ascii_alphabetic());
        let quote = &text[start..start + 1];
        let triple = text[start..].starts_with(&quote.repeat(3));
        let quotes = &text[start..start + if triple { 3 } else { 1 }];
        known.then_some(TextLiteral { text, prefix, quotes })
    }

    /// Appends what it says; returns its length in the text.
    pub(super) fn read_into(&self, out: &mut String) -> Result<usize, Wrong> {
        let raw = match self.prefix.to_ascii_lowercase().as_str() {
            "" | "u" => false,
            "r" => true,
            other => return Err((0, format!("texts of the form {other}'…' have no place in a config"))),
        };
        let mut at = self.prefix.len() + self.quotes.len();
        loop {
            let rest = &self.text[at..];
            let Some(c) = rest.chars().next() else {
                return Err((0, format!("a text without its closing {}", self.quotes)));
            };
            if rest.starts_with(self.quotes) {
                return Ok(at + self.quotes.len());
            }
            match c {
                '\n' if self.quotes.len() == 1 => {
                    return Err((0, format!("a text without its closing {} on the line", self.quotes)));
                }
                '\\' if raw => {
                    // A raw backslash stays, and keeps a quote after it from closing the text.
                    let kept = rest.chars().take(2).map(char::len_utf8).sum::<usize>();
                    out.push_str(&rest[..kept]);
                    at += kept;
                }
                '\\' => at += escape(rest, out).map_err(|message| (at, message))?,
                _ => {
                    out.push(c);
                    at += c.len_utf8();
                }
            }
        }
    }
}

/// Appends the character of the escape that `rest` begins with; returns the length of the escape.
fn escape(rest: &str, out: &mut String) -> Result<usize, String> {
    let letter = rest[1..].chars().next().ok_or("a text that ends in a backslash")?;
    let simple = match letter {
        '\\' | '\'' | '"' => Some(letter),
        'a' => Some('\u{7}'),
        'b' => Some('\u{8}'),
        'f' => Some('\u{c}'),
        'n' => Some('\n'),
        'r' => Some('\r'),
        't' => Some('\t'),
        'v' => Some('\u{b}'),
        _ => None,
    };
    if let Some(c) = simple {
        out.push(c);
        return Ok(2);
    }
    let (digits, radix) = match letter {
        '\n' => return Ok(2),
        'x' => (take_digits(&rest[2..], 2, 16).filter(|digits| digits.len() == 2), 16),
        'u' => (take_digits(&rest[2..], 4, 16).filter(|digits| digits.len() == 4), 16),
        'U' => (take_digits(&rest[2..], 8, 16).filter(|digits| digits.len() == 8), 16),
        '0'..='7' => (take_digits(&rest[1..], 3, 8), 8),
        _ => return Err(format!("the escape '\\{}'; a backslash is written '\\\\'", letter.escape_debug())),
    };
    let code =
        digits.and_then(|digits| Some((digits, char::from_u32(u32::from_str_radix(digits, radix).ok()?)?)));
    let (digits, c) =
        code.ok_or_else(|| format!("an escape '\\{letter}' without the code of a character"))?;
    out.push(c);
    Ok(digits.len() + if radix == 8 { 1 } else { 2 })
}

/// Up to `most` leading digits of `text`, if there is one.
fn take_digits(text: &str, most: usize, radix: u32) -> Option<&str> {
    let length = text.chars().take(most).take_while(|c| c.is_digit(radix)).count();
    (length > 0).then(|| &text[..length])
}
