//! The reference of the format, printed from the tables.

use std::fmt::{self, Write};

use super::root::MUJOCO;
use super::{ElementType, Facts, Kind};

/// The format as text: every element and attribute with its kind and meaning, one line each, indented by level.
///
/// ```
/// assert!(robohive_mjcf::reference().lines().any(|line| line.trim_start().starts_with("worldbody")));
/// ```
pub fn reference() -> String {
    let mut text = String::new();
    let mut seen = Vec::new();
    // Writing to a String cannot fail.
    let _ = write_element(&mut text, &MUJOCO, 0, false, &mut seen);
    text
}

fn write_element(
    out: &mut String,
    element: &'static ElementType,
    level: usize,
    defaults: bool,
    path: &mut Vec<&'static str>,
) -> fmt::Result {
    let indent = "  ".repeat(level);
    writeln!(out, "{indent}{} — {}", element.tag, element.doc)?;
    for rows in element.rows {
        rows.describe(&mut |facts, kind, doc| {
            if !defaults || (facts.in_defaults && facts.name != "class") {
                let _ = writeln!(out, "{indent}    {}", attribute(facts, kind, doc));
            }
        });
    }
    if path.contains(&element.tag) {
        return Ok(());
    }
    path.push(element.tag);
    for child in element.children {
        write_element(out, child.element, level + 1, child.defaults, path)?;
    }
    path.pop();
    Ok(())
}

fn attribute(facts: Facts, kind: Kind, doc: &str) -> String {
    let required = if facts.required { " (required)" } else { "" };
    format!("{}: {}{required} — {doc}", facts.name, KindText(kind))
}

/// What an attribute may hold, as in `3 real`.
pub struct KindText(pub Kind);

impl fmt::Display for KindText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = |words: &[(&str, i32)]| words.iter().map(|(w, _)| *w).collect::<Vec<_>>().join("|");
        let (noun, min, max) = match self.0 {
            Kind::Real { min, max } | Kind::Single { min, max } => ("real", min, max),
            Kind::Int { min, max } => ("int", min, max),
            Kind::Keyword(list) => return f.write_str(&words(list)),
            Kind::Flags(list) => return write!(f, "some of {}", words(list)),
            Kind::Text => return f.write_str("text"),
            Kind::File => return f.write_str("file"),
            Kind::Name(_) => return f.write_str("name"),
            Kind::Ref(space) => return write!(f, "name of a {}", space.word()),
            Kind::ObjRef(by) => return write!(f, "name of an object, see {by}"),
        };
        match (min, max) {
            (1, Some(1)) => f.write_str(noun),
            (_, Some(max)) if min == max => write!(f, "{max} {noun}"),
            (_, Some(max)) => write!(f, "{min} to {max} {noun}"),
            (_, None) => write!(f, "list of {noun}"),
        }
    }
}
