//! RoboHive's configs: Python literals with a little arithmetic, read without evaluating code.
//!
//! ```text
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = { "+" | "-" } atom
//! atom    = "{" [key ":" sum {"," key ":" sum}] "}" | "[" … "]" | "(" … ")" | text {text} | number
//!         | "True" | "False" | "None" | "np.pi" | "numpy.pi" | "math.pi" | "pi"
//! ```

use super::error::{ConfigError, Source};
use super::node::{Content, Key, Node};
use super::text_literal::TextLiteral;
use std::collections::HashSet;

/// Deepest nesting of brackets and signs.
const MAX_DEPTH: usize = 64;

/// The one value of the text.
pub(super) fn parse(source: &Source) -> Result<Node, ConfigError> {
    let mut parser = Parser { source, at: 0, depth: 0 };
    parser.skip_blank();
    // A byte order mark is no part of the literal.
    if parser.rest().starts_with('\u{feff}') {
        parser.at += '\u{feff}'.len_utf8();
    }
    let value = parser.sum()?;
    parser.skip_blank();
    if parser.at < source.text.len() {
        let seen = parser.seen();
        return Err(parser.wrong(&format!("{seen} after the end of the literal")));
    }
    Ok(value)
}

struct Parser<'a> {
    source: &'a Source<'a>,
    at: usize,
    depth: usize,
}

impl<'a> Parser<'a> {
    fn rest(&self) -> &'a str {
        &self.source.text[self.at..]
    }

    /// The next character after blanks and comments.
    fn peek(&mut self) -> Option<char> {
        self.skip_blank();
        self.rest().chars().next()
    }

    /// Takes `wanted`, if it comes next.
    fn take(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.at += wanted.len_utf8();
        }
        found
    }

    fn skip_blank(&mut self) {
        loop {
            let rest = self.rest();
            let blank = rest.trim_start_matches([' ', '\t', '\r', '\n', '\u{c}']);
            let comment = if blank.starts_with('#') { blank.find('\n').unwrap_or(blank.len()) } else { 0 };
            let skipped = rest.len() - blank.len() + comment;
            self.at += skipped;
            if skipped == 0 {
                return;
            }
        }
    }

    /// What stands here, for messages.
    fn seen(&mut self) -> String {
        self.peek().map_or_else(|| "the end of the text".to_owned(), |c| format!("'{}'", c.escape_debug()))
    }

    fn wrong(&self, message: &str) -> ConfigError {
        self.source.error(self.at, message)
    }

    fn nested<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Result<T, ConfigError>,
    ) -> Result<T, ConfigError> {
        if self.depth == MAX_DEPTH {
            return Err(self.wrong(&format!("more than {MAX_DEPTH} levels of brackets and signs")));
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    fn sum(&mut self) -> Result<Node, ConfigError> {
        let mut left = self.product()?;
        while let Some(operator @ ('+' | '-')) = self.peek() {
            self.at += 1;
            let right = self.product()?;
            left = self.combine(left, operator, right)?;
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<Node, ConfigError> {
        let mut left = self.signed()?;
        while let Some(operator @ ('*' | '/')) = self.peek() {
            let power = self.rest().starts_with("**");
            if power || self.rest().starts_with("//") {
                return Err(self.wrong("of operators, a config may use + - * /"));
            }
            self.at += 1;
            let right = self.signed()?;
            left = self.combine(left, operator, right)?;
        }
        Ok(left)
    }

    fn signed(&mut self) -> Result<Node, ConfigError> {
        let Some(sign @ ('+' | '-')) = self.peek() else { return self.atom() };
        let at = self.at;
        self.at += 1;
        let operand = self.nested(Parser::signed)?;
        let content = match (sign, operand.content) {
            // The smallest integer is never read: its digits are beyond 64 bits before the sign.
            ('-', Content::Integer(value)) => Content::Integer(value.wrapping_neg()),
            ('-', Content::Number(value)) => Content::Number(-value),
            ('+', value @ (Content::Integer(_) | Content::Number(_))) => value,
            _ => return Err(self.source.error(at, format!("'{sign}' before what is no number"))),
        };
        Ok(Node { at, content })
    }

    /// Python's arithmetic: integers stay integers but under `/`.
    fn combine(&self, left: Node, operator: char, right: Node) -> Result<Node, ConfigError> {
        let at = left.at;
        if let (Content::Integer(a), Content::Integer(b)) = (&left.content, &right.content) {
            let whole = match operator {
                '+' => Some(a.checked_add(*b)),
                '-' => Some(a.checked_sub(*b)),
                '*' => Some(a.checked_mul(*b)),
                _ => None,
            };
            if let Some(result) = whole {
                let value = result.ok_or_else(|| self.source.error(at, BEYOND))?;
                return Ok(Node { at, content: Content::Integer(value) });
            }
        }
        let operand = |node: &Node| match node.content {
            Content::Integer(value) => Ok(value as f64),
            Content::Number(value) => Ok(value),
            _ => Err(self.source.error(node.at, format!("'{operator}' takes numbers, not {}", node.kind()))),
        };
        let (a, b) = (operand(&left)?, operand(&right)?);
        let value = match operator {
            '+' => a + b,
            '-' => a - b,
            '*' => a * b,
            _ if b == 0.0 => return Err(self.source.error(right.at, "a division by zero")),
            _ => a / b,
        };
        Ok(Node { at, content: Content::Number(value) })
    }

    fn atom(&mut self) -> Result<Node, ConfigError> {
        let next = self.peek();
        let at = self.at;
        let content = match next {
            Some('{') => self.nested(Parser::table)?,
            Some('[') => self.nested(|parser| parser.list(']').map(|(items, _)| Content::List(items)))?,
            Some('(') => return self.nested(Parser::parentheses),
            Some(c) if c.is_ascii_digit() || c == '.' => self.number()?,
            Some('\'' | '"') => Content::Text(self.texts()?),
            Some(c) if c.is_alphabetic() || c == '_' => self.word()?,
            _ => {
                let seen = self.seen();
                return Err(self.wrong(&format!("{seen} where a value should stand")));
            }
        };
        Ok(Node { at, content })
    }

    /// `{key: value, …}`, keys texts, each once.
    fn table(&mut self) -> Result<Content, ConfigError> {
        self.at += 1;
        let mut entries: Vec<(Key, Node)> = Vec::new();
        let mut names = HashSet::new();
        while !self.take('}') {
            let key = self.sum()?;
            let kind = key.kind();
            let Content::Text(name) = key.content else {
                return Err(self.source.error(key.at, format!("a key that is {kind}; keys are texts")));
            };
            if !names.insert(name.clone()) {
                return Err(self.source.error(key.at, format!("the key '{name}' a second time")));
            }
            if !self.take(':') {
                let seen = self.seen();
                return Err(self.wrong(&format!("{seen} where the ':' after the key '{name}' should stand")));
            }
            let value = self.sum()?;
            entries.push((Key { at: key.at, name }, value));
            if !self.take(',') && self.peek() != Some('}') {
                return Err(self.missing_comma('}'));
            }
        }
        Ok(Content::Table(entries))
    }

    /// The items up to `close`, and whether a comma stands among them.
    fn list(&mut self, close: char) -> Result<(Vec<Node>, bool), ConfigError> {
        self.at += 1;
        let (mut items, mut comma) = (Vec::new(), false);
        while !self.take(close) {
            items.push(self.sum()?);
            if self.take(',') {
                comma = true;
            } else if self.peek() != Some(close) {
                return Err(self.missing_comma(close));
            }
        }
        Ok((items, comma))
    }

    /// A tuple, or a value in parentheses.
    fn parentheses(&mut self) -> Result<Node, ConfigError> {
        let at = self.at;
        let (mut items, comma) = self.list(')')?;
        match items.pop() {
            Some(only) if items.is_empty() && !comma => Ok(Node { at, ..only }),
            last => {
                items.extend(last);
                Ok(Node { at, content: Content::List(items) })
            }
        }
    }

    fn missing_comma(&mut self, close: char) -> ConfigError {
        let seen = self.seen();
        self.wrong(&format!("{seen} where ',' or '{close}' should stand"))
    }

    fn number(&mut self) -> Result<Content, ConfigError> {
        let at = self.at;
        let mut previous = ' ';
        let length = self.rest().find(|c: char| {
            let signed_exponent = matches!(c, '+' | '-') && matches!(previous, 'e' | 'E');
            previous = c;
            !(c.is_ascii_alphanumeric() || matches!(c, '.' | '_') || signed_exponent)
        });
        let text = &self.rest()[..length.unwrap_or(self.rest().len())];
        self.at += text.len();
        let wrong = || self.source.error(at, format!("'{text}' is no decimal number"));
        let separated = text.starts_with('_') || text.ends_with('_') || text.contains("__");
        let digits = text.replace('_', "");
        let whole = digits.bytes().all(|byte| byte.is_ascii_digit());
        // Python takes `00`, and refuses `07` for the octal number that it once was.
        let octal = whole && digits.starts_with('0') && digits.bytes().any(|byte| byte != b'0');
        if separated || octal || !digits.bytes().all(|b| b.is_ascii_digit() || b".eE+-".contains(&b)) {
            return Err(wrong());
        }
        if whole {
            return digits.parse().map(Content::Integer).map_err(|_| self.source.error(at, BEYOND));
        }
        digits.parse().map(Content::Number).map_err(|_| wrong())
    }

    fn word(&mut self) -> Result<Content, ConfigError> {
        let at = self.at;
        let length = self.rest().find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '.')));
        let word = &self.rest()[..length.unwrap_or(self.rest().len())];
        if word.len() <= 2 && self.rest()[word.len()..].starts_with(['\'', '"']) {
            return self.texts().map(Content::Text);
        }
        self.at += word.len();
        match word {
            "True" => Ok(Content::Bool(true)),
            "False" => Ok(Content::Bool(false)),
            "None" => Ok(Content::None),
            "np.pi" | "numpy.pi" | "math.pi" | "pi" => Ok(Content::Number(std::f64::consts::PI)),
            _ => Err(self.source.error(
                at,
                format!("'{word}' is no literal: of names, a config may use True, False, None and np.pi"),
            )),
        }
    }

    /// Texts that follow each other are one.
    fn texts(&mut self) -> Result<String, ConfigError> {
        let mut joined = String::new();
        while let Some(literal) = TextLiteral::begin(self.rest()) {
            let start = self.at;
            let length = literal
                .read_into(&mut joined)
                .map_err(|(offset, message)| self.source.error(start + offset, message))?;
            self.at += length;
            self.skip_blank();
        }
        Ok(joined)
    }
}

/// Message of integers that are too large.
const BEYOND: &str = "an integer beyond 64 bits";
