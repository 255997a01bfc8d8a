//! XML text to an owned element tree with byte positions.
//!
//! A linear scan runs before the parser proper (roxmltree) and bounds what hostile text can cost: nesting,
//! size, attributes per element, document type declarations. It also blanks comments and processing
//! instructions in place, so their bytes need be neither well-formed nor UTF-8, as MuJoCo's parser allows,
//! and offsets stay as in the file.

use std::sync::Arc;

use crate::budget::{ADVICE, ATTRIBUTE, Budget, ELEMENT};
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::encoding::{foreign, nul, refused};

/// One XML element.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Element {
    /// Tag name.
    pub name: String,
    /// Attributes in text order.
    pub attributes: Vec<Attribute>,
    /// Child elements in text order; text between them is dropped.
    pub children: Vec<Element>,
    /// Position of the opening `<`.
    pub loc: Loc,
}

/// One attribute of an element.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Attribute {
    /// Name as written.
    pub name: String,
    /// Value after reference resolution and white space normalisation.
    pub value: String,
    /// Position of the name.
    pub loc: Loc,
    /// Position of the first byte of the value.
    pub value_loc: Loc,
}

impl Element {
    /// The attribute of this name.
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.name == name)
    }

    /// The value of the attribute of this name.
    pub fn value(&self, name: &str) -> Option<&str> {
        self.attribute(name).map(|a| a.value.as_str())
    }

    /// Children with this tag.
    pub fn children_named<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.children.iter().filter(move |c| c.name == name)
    }

    /// The number of levels below and including this one.
    pub fn depth(&self) -> usize {
        1 + self.children.iter().map(Element::depth).max().unwrap_or(0)
    }

    /// The first element in document order, this one included, that satisfies `test`.
    pub fn find_mut(&mut self, test: &dyn Fn(&Element) -> bool) -> Option<&mut Element> {
        if test(self) {
            return Some(self);
        }
        self.children.iter_mut().find_map(|c| c.find_mut(test))
    }

    /// Detaches and returns the first descendant in document order that satisfies `test`.
    pub fn take(&mut self, test: &dyn Fn(&Element) -> bool) -> Option<Element> {
        if let Some(i) = self.children.iter().position(test) {
            return Some(self.children.remove(i));
        }
        self.children.iter_mut().find_map(|c| c.take(test))
    }

    /// Moves the body named `body` under the body named `parent`, as its last child.
    ///
    /// The tree is unchanged, and the reason returned, when either is absent or `parent` is inside `body`.
    pub(crate) fn reparent_body(&mut self, body: &str, parent: &str) -> Result<(), String> {
        let is = |name: &str, e: &Element| e.name == "body" && e.value("name") == Some(name);
        let moved =
            self.find_mut(&|e| is(body, e)).ok_or_else(|| format!("no body named '{body}' to move"))?;
        if moved.find_mut(&|e| is(parent, e)).is_some() {
            return Err(format!("body '{parent}' is part of the moved body '{body}'"));
        }
        if self.find_mut(&|e| is(parent, e)).is_none() {
            return Err(format!("no body named '{parent}' to move '{body}' under"));
        }
        let moved = self.take(&|e| is(body, e));
        if let (Some(parent), Some(moved)) = (self.find_mut(&|e| is(parent, e)), moved) {
            parent.children.push(moved);
        }
        Ok(())
    }
}

/// Bounds on what a text may cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Limits {
    /// Levels of nested elements, includes counted through.
    pub depth: usize,
    /// Bytes of one text.
    pub text_bytes: usize,
    /// Bytes of all texts of a model together.
    pub total_bytes: usize,
    /// Attributes of one element.
    pub attributes: usize,
    /// Files included, counted with repetition.
    pub includes: usize,
    /// Elements made by `replicate` and `attach`; nesting multiplies.
    pub copies: usize,
    /// Bytes of what a text asks for: elements, read and copied; height fields, textures and meshes; the arrays of
    /// the model and of the data of one simulation.
    pub memory: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            depth: 200,
            text_bytes: 64 << 20,
            total_bytes: 256 << 20,
            attributes: 128,
            includes: 4096,
            copies: 1_000_000,
            memory: 2 << 30,
        }
    }
}

impl Limits {
    /// Levels of nested elements, includes counted through.
    #[must_use]
    pub fn with_depth(mut self, depth: usize) -> Self {
        self.depth = depth;
        self
    }

    /// Bytes of one text.
    #[must_use]
    pub fn with_text_bytes(mut self, text_bytes: usize) -> Self {
        self.text_bytes = text_bytes;
        self
    }

    /// Bytes of all texts of a model together.
    #[must_use]
    pub fn with_total_bytes(mut self, total_bytes: usize) -> Self {
        self.total_bytes = total_bytes;
        self
    }

    /// Attributes of one element.
    #[must_use]
    pub fn with_attributes(mut self, attributes: usize) -> Self {
        self.attributes = attributes;
        self
    }

    /// Files included, counted with repetition.
    #[must_use]
    pub fn with_includes(mut self, includes: usize) -> Self {
        self.includes = includes;
        self
    }

    /// Elements made by `replicate` and `attach`.
    #[must_use]
    pub fn with_copies(mut self, copies: usize) -> Self {
        self.copies = copies;
        self
    }

    /// Bytes of what a text asks for.
    #[must_use]
    pub fn with_memory(mut self, memory: usize) -> Self {
        self.memory = memory;
        self
    }
}

/// A text that could not become a tree: byte offset and reason.
struct Fault {
    offset: usize,
    message: String,
}

fn fault<T>(offset: usize, message: impl Into<String>) -> Result<T, Fault> {
    Err(Fault { offset, message: message.into() })
}

/// Parses the bytes of one file and registers them in `sources`.
///
/// The root element comes back, or nothing and at least one error in `diagnostics`.
pub(crate) fn parse(
    path: &str,
    bytes: &[u8],
    included_at: Option<Loc>,
    limits: &Limits,
    budget: &mut Budget,
    sources: &mut Sources,
    diagnostics: &mut Diagnostics,
) -> Option<Element> {
    let mut scanned = bytes.to_vec();
    let scan = scan(&mut scanned, limits, budget).map(|found| {
        scanned = spaced(&scanned, &found.joints);
        // Joints stand before the end of the root, and have moved what follows.
        found.ignored.map(|offset| offset + found.joints.len())
    });
    let kept = if scan.is_ok() { &scanned[..] } else { &bytes[..bytes.len().min(limits.text_bytes)] };
    let text: Arc<str> = String::from_utf8_lossy(kept).into();
    let invalid = std::str::from_utf8(kept).err().map(|e| e.valid_up_to());
    let file = sources.add(path, text.clone(), included_at);
    let tree = scan.and_then(|ignored| match invalid {
        Some(offset) => fault(offset, "text is not UTF-8"),
        None => {
            if let Some(offset) = ignored {
                let message = "what follows the end of the first element is ignored";
                diagnostics.warning(sources, Loc { file, offset: offset as u32 }, message);
            }
            tree(&text, file, sources)
        }
    });
    match tree {
        Ok(root) => Some(root),
        Err(Fault { offset, message }) => {
            diagnostics.error(sources, Loc { file, offset: offset as u32 }, message);
            None
        }
    }
}

/// Puts a space at each of `joints`, where two attributes touch: MuJoCo's parser reads `a="1"b="2"`.
fn spaced(text: &[u8], joints: &[usize]) -> Vec<u8> {
    let mut out = Vec::with_capacity(text.len() + joints.len());
    let mut start = 0;
    for &joint in joints {
        out.extend_from_slice(&text[start..joint]);
        out.push(b' ');
        start = joint;
    }
    out.extend_from_slice(&text[start..]);
    out
}

/// What a scan found.
struct Scan {
    /// Places where attributes touch.
    joints: Vec<usize>,
    /// Where elements begin that the reference does not read.
    ignored: Option<usize>,
}

/// Checks structure and limits in one pass, and blanks everything but the root and text. As in the reference, elements
/// after the root are ignored, and everything from a closing tag on that closes nothing.
fn scan(text: &mut [u8], limits: &Limits, budget: &mut Budget) -> Result<Scan, Fault> {
    if text.len() > limits.text_bytes {
        return fault(
            0,
            format!("text has {} bytes, more than the limit of {}", text.len(), limits.text_bytes),
        );
    }
    if let Some(why) = refused(text) {
        return fault(0, why);
    }
    if let Some(at) = nul(text) {
        return fault(at, "the text has a NUL here (a zero byte), which XML has no place for: remove it");
    }
    if let Some(encoding) = foreign(text) {
        return fault(0, format!("file is {encoding}: a model is text in UTF-8"));
    }
    if text.starts_with(b"\xEF\xBB\xBF") {
        text[..3].fill(b' ');
    }
    if text.iter().all(|b| b.is_ascii_whitespace()) {
        return fault(0, "file is empty");
    }
    let mut open: Vec<(usize, usize)> = Vec::new();
    let mut joints = Vec::new();
    let mut rest = Rest::default();
    let mut at = 0;
    while let Some(step) = text[at..].iter().position(|&b| b == b'<') {
        let start = at + step;
        let before = joints.len();
        if rest.complete && open.is_empty() && text.get(start + 1) == Some(&b'/') {
            rest.ignored.get_or_insert(start);
            erase(text, start, text.len());
            break;
        }
        at = match &text[start + 1..] {
            [b'!', b'-', b'-', ..] => blank(text, start, b"-->", "comment is never closed")?,
            [b'!', b'[', ..] => skip_past(text, start, b"]]>", "CDATA section is never closed")?,
            [b'!', ..] => blank_doctype(text, start)?,
            [b'?', ..] => blank(text, start, b"?>", "processing instruction is never closed")?,
            [b'/', ..] => close_tag(text, start, &mut open)?,
            _ => open_tag(text, start, &mut open, &mut joints, limits, budget)?,
        };
        if rest.complete {
            joints.truncate(before);
        }
        rest.pass(text, start, at, open.len());
    }
    match open.pop() {
        Some((start, end)) => fault(start, format!("<{}> is never closed", shown(&text[start + 1..end]))),
        None => Ok(Scan { joints, ignored: rest.ignored }),
    }
}

/// Progress beyond the root.
#[derive(Default)]
struct Rest {
    /// The root is closed.
    complete: bool,
    /// Where the element after it begins that is being passed.
    from: Option<usize>,
    ignored: Option<usize>,
}

impl Rest {
    /// Takes note of what stands from `start` to `end`, after which `depth` elements are open.
    fn pass(&mut self, text: &mut [u8], start: usize, end: usize, depth: usize) {
        // What is not an element is blank already.
        if text[start] != b'<' || text[start + 1..].starts_with(b"![") {
            return;
        }
        if self.complete {
            self.ignored.get_or_insert(start);
            let from = *self.from.get_or_insert(start);
            if depth == 0 {
                erase(text, from, end);
                self.from = None;
            }
        }
        self.complete |= depth == 0;
    }
}

/// Blanks a part of the text; lines stay.
fn erase(text: &mut [u8], start: usize, end: usize) {
    text[start..end].iter_mut().filter(|b| **b != b'\n').for_each(|b| *b = b' ');
}

fn skip_past(text: &[u8], start: usize, end: &[u8], message: &str) -> Result<usize, Fault> {
    let found = text[start..].windows(end.len()).position(|w| w == end);
    found.map(|i| start + i + end.len()).ok_or(Fault { offset: start, message: message.into() })
}

fn blank(text: &mut [u8], start: usize, end: &[u8], message: &str) -> Result<usize, Fault> {
    let past = skip_past(text, start, end, message)?;
    erase(text, start, past);
    Ok(past)
}

/// A bare document type declaration is ignored; one with an internal subset could declare entities.
fn blank_doctype(text: &mut [u8], start: usize) -> Result<usize, Fault> {
    let past = skip_past(text, start, b">", "declaration is never closed")?;
    if text[start..past].contains(&b'[') || text[start..].starts_with(b"<!ENTITY") {
        return fault(start, "entity declarations are not supported in a model");
    }
    blank(text, start, b">", "declaration is never closed")
}

fn name_end(text: &[u8], start: usize) -> usize {
    let stop = |b: &u8| b.is_ascii_whitespace() || matches!(b, b'/' | b'>' | b'<');
    text[start..].iter().position(stop).map_or(text.len(), |i| start + i)
}

fn close_tag(text: &[u8], start: usize, open: &mut Vec<(usize, usize)>) -> Result<usize, Fault> {
    let end = name_end(text, start + 2);
    let name = &text[start + 2..end];
    let Some((opened, opened_end)) = open.pop() else {
        return fault(start, format!("</{}> closes nothing", shown(name)));
    };
    let expected = &text[opened + 1..opened_end];
    if expected != name {
        let line = 1 + text[..opened].iter().filter(|b| **b == b'\n').count();
        let (name, expected) = (shown(name), shown(expected));
        return fault(start, format!("</{name}> does not close <{expected}> opened on line {line}"));
    }
    skip_past(text, end, b">", "closing tag has no '>'")
}

fn open_tag(
    text: &[u8],
    start: usize,
    open: &mut Vec<(usize, usize)>,
    joints: &mut Vec<usize>,
    limits: &Limits,
    budget: &mut Budget,
) -> Result<usize, Fault> {
    let end = name_end(text, start + 1);
    let mut at = end;
    let mut attributes = 0;
    loop {
        match text.get(at) {
            None | Some(b'<') => {
                return fault(start, format!("<{} has no '>'", shown(&text[start + 1..end])));
            }
            Some(b'>') => break,
            Some(&quote @ (b'"' | b'\'')) => {
                let Some(length) = text[at + 1..].iter().position(|&b| b == quote) else {
                    return fault(at, "attribute value has no closing quote");
                };
                attributes += 1;
                at += length + 2;
                if text.get(at).is_some_and(|b| !b.is_ascii_whitespace() && !matches!(b, b'/' | b'>' | b'<'))
                {
                    joints.push(at);
                }
            }
            Some(_) => at += 1,
        }
    }
    if attributes > limits.attributes {
        return fault(
            start,
            format!("element has {attributes} attributes, more than the limit of {}", limits.attributes),
        );
    }
    if let Err(message) = budget.take("elements of the text", ELEMENT + attributes * ATTRIBUTE) {
        return fault(start, format!("{message}; {ADVICE}"));
    }
    if text[at - 1] != b'/' {
        open.push((start, end));
        if open.len() > limits.depth {
            return fault(start, format!("elements are nested more than {} deep", limits.depth));
        }
    }
    Ok(at + 1)
}

/// A name short enough for a message.
fn shown(name: &[u8]) -> String {
    String::from_utf8_lossy(&name[..name.len().min(40)]).into_owned()
}

fn tree(text: &str, file: u32, sources: &Sources) -> Result<Element, Fault> {
    let document = roxmltree::Document::parse(text).map_err(|e| {
        let message = e.to_string();
        let message = message.replace(&format!(" at {}", e.pos()), "");
        Fault {
            offset: sources.offset(file, e.pos().row, e.pos().col),
            message: format!("not XML: {message}"),
        }
    })?;
    Ok(owned(document.root_element(), file))
}

fn owned(node: roxmltree::Node, file: u32) -> Element {
    let at = |offset: usize| Loc { file, offset: offset as u32 };
    Element {
        name: node.tag_name().name().to_string(),
        attributes: node
            .attributes()
            .map(|a| Attribute {
                name: a.name().to_string(),
                value: a.value().to_string(),
                loc: at(a.range().start),
                value_loc: at(a.range_value().start),
            })
            .collect(),
        children: node.children().filter(|c| c.is_element()).map(|c| owned(c, file)).collect(),
        loc: at(node.range().start),
    }
}
