//! Where a config is wrong.

use std::fmt;

/// Longest text of a config, in bytes.
pub(super) const MAX_TEXT: usize = 1 << 20;

/// Why a config cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConfigError {
    /// File, as the caller named it.
    pub file: String,
    /// Line and column, from 1; `None` for the file as a whole.
    pub position: Option<(usize, usize)>,
    /// What is wrong and how to fix it.
    pub message: String,
}

impl fmt::Display for ConfigError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.file)?;
        if let Some((line, column)) = self.position {
            write!(f, "{line}:{column}:")?;
        }
        write!(f, " {}", self.message)
    }
}

impl std::error::Error for ConfigError {}

/// A text and its name.
pub(super) struct Source<'a> {
    pub(super) text: &'a str,
    file: &'a str,
}

impl<'a> Source<'a> {
    /// A text of bounded length.
    pub(super) fn new(text: &'a str, file: &'a str) -> Result<Self, ConfigError> {
        let source = Source { text, file };
        if text.len() > MAX_TEXT {
            return Err(ConfigError {
                file: file.to_owned(),
                position: None,
                message: too_long(text.len() as u64),
            });
        }
        Ok(source)
    }

    /// An error at byte `at`.
    pub(super) fn error(&self, at: usize, message: impl Into<String>) -> ConfigError {
        ConfigError { file: self.file.to_owned(), position: Some(self.position(at)), message: message.into() }
    }

    /// Line and column of byte `at`, from 1.
    pub(super) fn position(&self, at: usize) -> (usize, usize) {
        let mut at = at.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        let before = &self.text[..at];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.bytes().filter(|&byte| byte == b'\n').count() + 1;
        (line, before[line_start..].chars().count() + 1)
    }
}

/// The message of a text of `bytes` bytes.
pub(super) fn too_long(bytes: u64) -> String {
    format!("{bytes} bytes are no config of a robot; it may have {MAX_TEXT}")
}
