//! Where a fact about a model stands in its source text, and what is wrong with it.
//!
//! A [`Loc`] is eight bytes and travels with every element of the tree and every object of the `Spec`;
//! [`Sources`] turns it into `file:line:column` and the chain of includes that led there. A compile
//! collects all its findings in [`Diagnostics`] instead of stopping at the first.
//!
//! ```
//! let text = "<mujoco>\n  <worldbody><geom size='0.1' mas='1'/></worldbody>\n</mujoco>";
//! let findings = robohive_mjcf::load_str(text).unwrap_err();
//! let finding = findings.errors().next().unwrap();
//! let position = finding.position.as_ref().unwrap();
//! assert_eq!((position.line, position.column), (2, 31));
//! assert_eq!(finding.element.as_deref(), Some("geom"));
//! assert_eq!(finding.hint.as_deref(), Some("did you mean 'mass'?"));
//! ```

use std::fmt;
use std::sync::Arc;

use crate::escape::Escaped;
use physics::model::Suggestions;

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
pub(crate) struct Source {
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
    pub(crate) fn add(&mut self, path: &str, text: Arc<str>, included_at: Option<Loc>) -> u32 {
        let line_starts = std::iter::once(0)
            .chain(text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i as u32 + 1))
            .collect();
        let dir = path.rfind('/').map_or(String::new(), |i| path[..=i].to_string());
        self.files.push(Source { path: path.to_string(), dir, included_at, text, line_starts });
        self.files.len() as u32 - 1
    }

    /// The text with this index.
    pub(crate) fn get(&self, file: u32) -> Option<&Source> {
        self.files.get(file as usize)
    }

    /// The folder of the main file with its closing slash, empty for a text of no file.
    pub fn folder(&self) -> &str {
        self.files.first().map_or("", |source| &source.dir)
    }

    /// Bytes of all texts together.
    pub(crate) fn bytes(&self) -> usize {
        self.files.iter().map(|f| f.text.len()).sum()
    }

    /// All texts, main file first.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &Source> {
        self.files.iter()
    }

    /// The paths of all texts, that of the main file first.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|source| &*source.path)
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
    pub(crate) fn offset(&self, file: u32, line: u32, column: u32) -> usize {
        let Some(source) = self.get(file) else { return 0 };
        let line = (line.max(1) as usize - 1).min(source.line_starts.len() - 1);
        let start = source.line_starts[line] as usize;
        let rest = &source.text[start..];
        start + rest.char_indices().nth(column.max(1) as usize - 1).map_or(rest.len(), |(i, _)| i)
    }

    /// The tag of the element that `loc` stands in.
    pub fn element(&self, loc: Loc) -> Option<&str> {
        let text = self.get(loc.file)?.text();
        let after = text.get(loc.offset as usize..)?;
        // A location points to the element's '<', or to something inside its opening tag.
        let tag = match after.strip_prefix('<') {
            Some(tag) => tag,
            None => &text[text[..loc.offset as usize].rfind('<')? + 1..],
        };
        let end = tag.find(|c: char| c.is_whitespace() || matches!(c, '/' | '>' | '<'))?;
        (end > 0).then(|| &tag[..end])
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
#[non_exhaustive]
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
        write!(f, "{}:{}:{}", Escaped(&self.path), self.line, self.column)
    }
}

/// Whether a finding stops the load.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Severity {
    /// The model cannot be used.
    Error,
    /// Something was ignored or assumed.
    Warning,
}

/// One finding about a model. What it quotes from a file is kept as it is, and escaped where it is displayed.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// One sentence without position.
    pub message: String,
    /// Where it stands, absent for findings about no particular text.
    pub position: Option<Position>,
    /// Tag of the element that it is about.
    pub element: Option<String>,
    /// The includes that led there, innermost first.
    pub include_chain: Vec<Position>,
    /// What to write instead.
    pub hint: Option<String>,
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
        write!(f, "{}", Escaped(&self.message))?;
        if let Some(hint) = &self.hint {
            write!(f, "; {}", Escaped(hint))?;
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
    pub(crate) list: Vec<Diagnostic>,
    /// Errors dropped after the first few hundred findings.
    pub(crate) dropped: usize,
    suggestions: Suggestions,
}

impl Diagnostics {
    /// Adds an error at `loc`.
    pub(crate) fn error(&mut self, sources: &Sources, loc: Loc, message: impl Into<String>) {
        self.push(sources, Severity::Error, loc, message.into(), None);
    }

    /// Adds an error at `loc` with advice, for example `did you mean 'mass'?`.
    pub(crate) fn error_with(
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
    pub(crate) fn warning(&mut self, sources: &Sources, loc: Loc, message: impl Into<String>) {
        self.push(sources, Severity::Warning, loc, message.into(), None);
    }

    fn push(
        &mut self,
        sources: &Sources,
        severity: Severity,
        loc: Loc,
        message: String,
        hint: Option<String>,
    ) {
        if self.list.len() >= MAX_KEPT {
            self.dropped += usize::from(severity == Severity::Error);
            return;
        }
        let position = sources.position(loc);
        let include_chain = sources.include_chain(loc);
        let element = sources.element(loc).map(str::to_owned);
        self.list.push(Diagnostic { severity, message, position, element, include_chain, hint });
    }

    /// Findings that were kept from an earlier load.
    pub(crate) fn of(list: Vec<Diagnostic>) -> Self {
        Diagnostics { list, ..Diagnostics::default() }
    }

    /// An error about no place in a text.
    pub(crate) fn of_error(message: impl Into<String>) -> Self {
        let mut diagnostics = Diagnostics::default();
        diagnostics.error(&Sources::default(), Loc::NONE, message);
        diagnostics
    }

    /// All findings that were kept, in the order in which they were made.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// Whether nothing was found.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty() && self.dropped == 0
    }

    /// Number of errors that are counted and not kept, because there were hundreds before them.
    pub fn dropped(&self) -> usize {
        self.dropped
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

impl<'a> IntoIterator for &'a Diagnostics {
    type Item = &'a Diagnostic;
    type IntoIter = std::slice::Iter<'a, Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
