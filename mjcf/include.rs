//! Replaces every `include` element by the children of the file it names.
//!
//! The root of an included file may have any name; its attributes are ignored. A relative path is tried from
//! the main file's directory first, then from the including file's. A file may be included once, in the
//! sense of MuJoCo 3.12: the check compares path strings, and a path found from the main directory is
//! remembered as seen from the including one, so nested spellings of one file can repeat it. An include that
//! would never end is always an error.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::budget::Budget;
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::files::{FileProvider, fold, is_absolute, join};
use crate::xml::{self, Element, Limits};

/// A replacement made in the text of every file before it is parsed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Substitution {
    /// What is replaced.
    pub from: String,
    /// What stands there instead.
    pub to: String,
    /// Whether a model in which nothing is replaced is an error.
    pub required: bool,
}

/// What expansion needs to know and what it fills.
pub struct Expansion<'a> {
    /// Where files come from.
    pub files: &'a dyn FileProvider,
    /// Template replacements, in order.
    pub substitutions: &'a [Substitution],
    /// Which of them have replaced something.
    pub matched: &'a mut [bool],
    /// The text is the whole model: names that nothing declares are errors. Otherwise the compiler finds them, once the
    /// description is whole.
    pub whole: bool,
    /// Bounds on depth, size and number.
    pub limits: &'a Limits,
    /// Memory asked for so far.
    pub(crate) budget: &'a mut Budget,
    /// Receives every text read.
    pub sources: &'a mut Sources,
    /// Receives every finding.
    pub diagnostics: &'a mut Diagnostics,
}

/// Progress through the includes of one model.
struct State {
    model_dir: String,
    included: BTreeSet<String>,
    open: Vec<String>,
    count: usize,
    bytes: usize,
}

impl Expansion<'_> {
    /// The same, lent to the reader of another model.
    pub(crate) fn lend(&mut self) -> Expansion<'_> {
        Expansion {
            files: self.files,
            substitutions: self.substitutions,
            matched: self.matched,
            whole: self.whole,
            limits: self.limits,
            budget: self.budget,
            sources: self.sources,
            diagnostics: self.diagnostics,
        }
    }

    /// Reads the file at `path` and everything it includes.
    pub fn read(&mut self, path: &str) -> Option<Element> {
        let path = fold(path);
        match self.files.read(&path) {
            Ok(bytes) => self.expand(&path, &bytes),
            Err(e) => {
                let file = self.sources.add(&path, Arc::from(""), None);
                self.diagnostics.error(
                    self.sources,
                    Loc { file, offset: 0 },
                    format!("cannot read model: {e}"),
                );
                None
            }
        }
    }

    /// Parses `bytes` as the main file and expands its includes as if it stood at `path`.
    pub fn expand(&mut self, path: &str, bytes: &[u8]) -> Option<Element> {
        let mut root = self.parse(path, bytes, None)?;
        let model_dir = self.sources.get(root.loc.file)?.dir.clone();
        let included = BTreeSet::from([path.to_string()]);
        let mut state =
            State { model_dir, included, open: vec![path.to_string()], count: 0, bytes: bytes.len() };
        self.children(&mut root, "", 1, &mut state);
        Some(root)
    }

    fn parse(&mut self, path: &str, bytes: &[u8], included_at: Option<Loc>) -> Option<Element> {
        let replaced = substitute(bytes, self.substitutions, self.matched);
        let bytes = replaced.as_deref().unwrap_or(bytes);
        xml::parse(path, bytes, included_at, self.limits, self.budget, self.sources, self.diagnostics)
    }

    fn children(&mut self, parent: &mut Element, dir: &str, depth: usize, state: &mut State) {
        let mut expanded = Vec::with_capacity(parent.children.len());
        for mut child in std::mem::take(&mut parent.children) {
            if child.name.eq_ignore_ascii_case("include") {
                expanded.extend(self.include(&child, dir, depth, state));
            } else {
                self.children(&mut child, dir, depth + 1, state);
                expanded.push(child);
            }
        }
        parent.children = expanded;
    }

    fn include(&mut self, element: &Element, dir: &str, depth: usize, state: &mut State) -> Vec<Element> {
        match self.try_include(element, dir, depth, state) {
            Ok(children) => children,
            Err((loc, message)) => {
                self.diagnostics.error(self.sources, loc, message);
                Vec::new()
            }
        }
    }

    fn try_include(
        &mut self,
        element: &Element,
        dir: &str,
        depth: usize,
        state: &mut State,
    ) -> Result<Vec<Element>, (Loc, String)> {
        let fail = |loc: Loc, message: String| Err((loc, message));
        if !element.children.is_empty() {
            return fail(
                element.loc,
                "<include> holds nothing: move the elements inside it behind it".into(),
            );
        }
        if let Some(other) = element.attributes.iter().find(|a| a.name != "file") {
            return fail(other.loc, format!("unknown attribute '{}' of <include>", other.name));
        }
        let Some(attribute) = element.attribute("file") else {
            return fail(element.loc, "<include> needs the attribute 'file'".into());
        };
        let loc = attribute.value_loc;
        let place = self.locate(&attribute.value, element.loc.file, dir, &state.model_dir);
        if state.open.contains(&place.path) {
            return fail(loc, format!("'{}' includes itself", place.path));
        }
        if state.included.contains(&place.key) {
            return fail(
                loc,
                format!("file '{}' is included a second time: remove one of the two", place.key),
            );
        }
        let bytes = match self.files.read(&place.path) {
            Ok(bytes) => bytes,
            Err(e) => return fail(loc, format!("cannot include '{}': {e}", place.path)),
        };
        state.count += 1;
        state.bytes += bytes.len();
        if state.count > self.limits.includes || state.bytes > self.limits.total_bytes {
            return fail(loc, "included files exceed the limit on number or size".into());
        }
        let Some(mut root) = self.parse(&place.path, &bytes, Some(loc)) else { return Ok(Vec::new()) };
        state.included.insert(place.remembered);
        if root.children.is_empty() {
            return fail(loc, format!("included file '{}' has no elements", place.path));
        }
        if depth + root.depth() > self.limits.depth {
            return fail(loc, format!("elements are nested more than {} deep", self.limits.depth));
        }
        let next_dir = self.sources.get(root.loc.file).map_or(String::new(), |s| s.dir.clone());
        state.open.push(place.path);
        self.children(&mut root, &next_dir, depth, state);
        state.open.pop();
        Ok(root.children)
    }

    fn locate(&self, file: &str, including: u32, dir: &str, model_dir: &str) -> Place {
        let file = fold(file);
        let from_model = join(model_dir, &file);
        if is_absolute(&file) || dir.is_empty() || self.files.exists(&from_model) {
            return Place { path: from_model, remembered: join(dir, &file), key: file };
        }
        let including_dir = self.sources.get(including).map_or("", |s| s.dir.as_str());
        let path = join(including_dir, &file);
        Place { key: path.clone(), remembered: path.clone(), path }
    }
}

/// Where an included file is and under which names the repetition check knows it.
struct Place {
    path: String,
    key: String,
    remembered: String,
}

fn substitute(bytes: &[u8], substitutions: &[Substitution], matched: &mut [bool]) -> Option<Vec<u8>> {
    let mut text = std::str::from_utf8(bytes).ok()?.to_string();
    let mut changed = false;
    for (Substitution { from, to, .. }, matched) in substitutions.iter().zip(matched) {
        if !from.is_empty() && text.contains(from.as_str()) {
            text = text.replace(from.as_str(), to);
            (changed, *matched) = (true, true);
        }
    }
    changed.then(|| text.into_bytes())
}

/// Most placeholders that a message lists.
const MAX_LISTED: usize = 8;

/// Reports the required replacements that replaced nothing, with the placeholders that could be meant.
pub(crate) fn report_unmatched(
    substitutions: &[Substitution],
    matched: &[bool],
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) {
    let unmatched = substitutions.iter().zip(matched).filter(|(s, matched)| s.required && !**matched);
    for (Substitution { from, .. }, _) in unmatched {
        let candidates: BTreeSet<&str> =
            sources.iter().flat_map(|source| placeholders(source.text())).collect();
        let listed: Vec<_> = candidates.iter().take(MAX_LISTED).map(|word| format!("'{word}'")).collect();
        let advice = match diagnostics.nearest(from, candidates.iter().copied()) {
            Some(word) => Some(format!("did you mean '{word}'?")),
            None if listed.is_empty() => None,
            None => Some(format!("words in capitals there: {}", listed.join(", "))),
        };
        let start = Loc { file: 0, offset: 0 };
        let message = format!("nothing to replace: no file of the model contains '{from}'");
        diagnostics.error_with(sources, start, message, advice);
    }
}

/// Words in capitals outside comments, as placeholders of templates are written.
fn placeholders(text: &str) -> impl Iterator<Item = &str> {
    let markup = text.split("<!--").enumerate().map(|(i, part)| match i {
        0 => part,
        _ => part.split_once("-->").map_or("", |(_, rest)| rest),
    });
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    markup.flat_map(move |part| part.split(move |c| !word(c))).filter(|word| {
        let capitals = word.bytes().all(|b| b.is_ascii_uppercase() || b.is_ascii_digit() || b == b'_');
        capitals && word.len() >= 3 && word.starts_with(|c: char| c.is_ascii_uppercase())
    })
}
