//! Where a fact about a model stands in its source text, and what is wrong with it.
//!
//! A [`Loc`] is eight bytes and travels with every element of the tree and every object of the `Spec`;
//! [`Sources`] turns it into `file:line:column` and the chain of includes that led there. A compile
//! collects all its findings in [`Diagnostics`] instead of stopping at the first.

use std::fmt;
use std::sync::Arc;

use crate::suggestion::Suggestions;

/// A byte position in one of the model's source files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Loc {
    /// Index into [`Sources`], `u32::MAX` for objects that no text declares.
    pub file: u32,
    /// Byte offset from the start of that file.
    pub offset: u32,
}

impl Loc {
    /// The position of objects made by the compiler or by code.
    pub const NONE: Loc = Loc { file: u32::MAX, offset: 0 };
}

impl Default for Loc {
    fn default() -> Self {
        Loc::NONE
    }
}

/// One text that a model is read from.
#[derive(Debug, Clone)]
pub struct Source {
    /// Path as opened, or a label such as `<string>`.
    pub path: String,
    /// Directory of `path` with its trailing slash, empty for a bare name.
    pub dir: String,
    /// The `file` attribute that included this text.
    pub included_at: Option<Loc>,
    text: Arc<str>,
    line_starts: Vec<u32>,
}

impl Source {
    /// The text, replacements made.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// All texts of one model, in the order they were opened.
#[derive(Debug, Clone, Default)]
pub struct Sources {
    files: Vec<Source>,
}

impl Sources {
    /// Registers a text and returns its index.
    pub fn add(&mut self, path: &str, text: Arc<str>, included_at: Option<Loc>) -> u32 {
        let line_starts = std::iter::once(0)
            .chain(text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i as u32 + 1))
            .collect();
        let dir = path.rfind('/').map_or(String::new(), |i| path[..=i].to_string());
        self.files.push(Source { path: path.to_string(), dir, included_at, text, line_starts });
        self.files.len() as u32 - 1
    }

    /// The text with this index.
    pub fn get(&self, file: u32) -> Option<&Source> {
        self.files.get(file as usize)
    }

    /// Bytes of all texts together.
    pub fn bytes(&self) -> usize {
        self.files.iter().map(|f| f.text.len()).sum()
    }

    /// All texts, main file first.
    pub fn iter(&self) -> impl Iterator<Item = &Source> {
        self.files.iter()
    }

    /// Path, line and column of `loc`; lines and columns count from one, columns in characters.
    pub fn position(&self, loc: Loc) -> Option<Position> {
        let source = self.get(loc.file)?;
        let line = source.line_starts.partition_point(|&s| s <= loc.offset).max(1);
        let start = source.line_starts[line - 1] as usize;
        let end = (loc.offset as usize).clamp(start, source.text.len());
        let before = source.text.get(start..end).unwrap_or("");
        Some(Position { path: source.path.clone(), line, column: before.chars().count() + 1 })
    }

    /// The byte offset of a line and a column in characters, both from one.
    pub fn offset(&self, file: u32, line: u32, column: u32) -> usize {
        let Some(source) = self.get(file) else { return 0 };
        let line = (line.max(1) as usize - 1).min(source.line_starts.len() - 1);
        let start = source.line_starts[line] as usize;
        let rest = &source.text[start..];
        start + rest.char_indices().nth(column.max(1) as usize - 1).map_or(rest.len(), |(i, _)| i)
    }

    /// The include attributes that led to the file of `loc`, innermost first.
    pub fn include_chain(&self, loc: Loc) -> Vec<Position> {
        let mut chain = Vec::new();
        let mut at = self.get(loc.file).and_then(|s| s.included_at);
        while let Some(include) = at {
            chain.extend(self.position(include));
            at = self.get(include.file).and_then(|s| s.included_at);
        }
        chain
    }
}

/// A resolved [`Loc`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Position {
    /// Path of the file as opened.
    pub path: String,
    /// Line, from one.
    pub line: usize,
    /// Column in characters, from one.
    pub column: usize,
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.path, self.line, self.column)
    }
}

/// Whether a finding stops the load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Severity {
    /// The model cannot be used.
    Error,
    /// Something was ignored or assumed.
    Warning,
}

/// One finding about a model.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// One sentence without position.
    pub message: String,
    /// Where it stands, absent for findings about no particular text.
    pub position: Option<Position>,
    /// The includes that led there, innermost first.
    pub include_chain: Vec<Position>,
    /// What to write instead.
    pub suggestion: Option<String>,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(position) = &self.position {
            write!(f, "{position}: ")?;
        }
        f.write_str(match self.severity {
            Severity::Error => "error: ",
            Severity::Warning => "warning: ",
        })?;
        f.write_str(&self.message)?;
        if let Some(suggestion) = &self.suggestion {
            write!(f, "; {suggestion}")?;
        }
        self.include_chain.iter().try_for_each(|p| write!(f, "\n  included from {p}"))
    }
}

/// Errors beyond this number are counted, not kept.
const MAX_KEPT: usize = 200;

/// All findings of one load, in the order they were made.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagnostics {
    /// The findings.
    pub list: Vec<Diagnostic>,
    /// Errors dropped after the first few hundred findings.
    pub dropped: usize,
    suggestions: Suggestions,
}

impl Diagnostics {
    /// Adds an error at `loc`.
    pub fn error(&mut self, sources: &Sources, loc: Loc, message: impl Into<String>) {
        self.push(sources, Severity::Error, loc, message.into(), None);
    }

    /// Adds an error at `loc` with advice, for example `did you mean 'mass'?`.
    pub fn error_with(
        &mut self,
        sources: &Sources,
        loc: Loc,
        message: impl Into<String>,
        advice: Option<String>,
    ) {
        self.push(sources, Severity::Error, loc, message.into(), advice);
    }

    /// The candidate nearest to the misspelt `word`; none for findings that are not kept.
    pub fn nearest<'a>(&mut self, word: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
        if self.list.len() >= MAX_KEPT {
            return None;
        }
        self.suggestions.nearest(word, candidates)
    }

    /// Adds a warning at `loc`.
    pub fn warning(&mut self, sources: &Sources, loc: Loc, message: impl Into<String>) {
        self.push(sources, Severity::Warning, loc, message.into(), None);
    }

    fn push(
        &mut self,
        sources: &Sources,
        severity: Severity,
        loc: Loc,
        message: String,
        suggestion: Option<String>,
    ) {
        if self.list.len() >= MAX_KEPT {
            self.dropped += usize::from(severity == Severity::Error);
            return;
        }
        let position = sources.position(loc);
        let include_chain = sources.include_chain(loc);
        self.list.push(Diagnostic { severity, message, position, include_chain, suggestion });
    }

    /// True when something stops the load.
    pub fn has_errors(&self) -> bool {
        self.dropped > 0 || self.list.iter().any(|d| d.severity == Severity::Error)
    }

    /// The findings of severity error.
    pub fn errors(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter().filter(|d| d.severity == Severity::Error)
    }

    /// The findings of severity warning.
    pub fn warnings(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter().filter(|d| d.severity == Severity::Warning)
    }

    /// Appends the findings of another stage.
    pub fn extend(&mut self, other: Diagnostics) {
        self.list.extend(other.list);
        self.dropped += other.dropped;
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // What stops the load comes first.
        for (i, diagnostic) in self.errors().chain(self.warnings()).enumerate() {
            let newline = if i == 0 { "" } else { "\n" };
            write!(f, "{newline}{diagnostic}")?;
        }
        if self.dropped > 0 {
            write!(f, "\n{} more not shown", self.dropped)?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}
