//! An element tree as text: two spaces a level, attributes on the line of their element.

use std::fmt::{Display, LowerExp};

use crate::xml::{Attribute, Element};

/// An element without attributes.
pub(super) fn element(tag: &str) -> Element {
    Element { name: tag.to_owned(), ..Element::default() }
}

impl Element {
    /// Appends an attribute.
    pub(crate) fn put(&mut self, name: &str, value: impl Into<String>) {
        self.attributes.push(Attribute {
            name: name.to_owned(),
            value: value.into(),
            ..Attribute::default()
        });
    }

    /// Whether the attribute is there.
    pub(super) fn has(&self, name: &str) -> bool {
        self.attribute(name).is_some()
    }

    /// Appends `child` unless it says nothing.
    pub(super) fn add(&mut self, child: Element) {
        if !child.attributes.is_empty() || !child.children.is_empty() {
            self.children.push(child);
        }
    }
}

/// The shortest decimal that reads as the same number.
pub(crate) fn number(x: impl Display + LowerExp) -> String {
    let (plain, scientific) = (format!("{x}"), format!("{x:e}"));
    if scientific.len() < plain.len() { scientific } else { plain }
}

/// Numbers with a space between two.
pub(crate) fn numbers<T: Display + LowerExp + Copy>(values: &[T]) -> String {
    let mut text = String::with_capacity(8 * values.len());
    for (i, &x) in values.iter().enumerate() {
        if i > 0 {
            text.push(' ');
        }
        text += &number(x);
    }
    text
}

/// Integers with a space between two.
pub(crate) fn integers(values: &[i32]) -> String {
    values.iter().map(i32::to_string).collect::<Vec<_>>().join(" ")
}

/// The tree as a document.
///
/// # Errors
/// An attribute holds a character that XML cannot, or the elements are nested more than `depth` deep.
pub(crate) fn print(root: &Element, depth: usize) -> Result<String, String> {
    let mut out = String::new();
    print_element(&mut out, root, 0, depth)?;
    Ok(out)
}

fn print_element(out: &mut String, element: &Element, level: usize, depth: usize) -> Result<(), String> {
    if level >= depth {
        return Err(format!("elements are nested more than {depth} deep, which no reader takes"));
    }
    let indent = "  ".repeat(level);
    out.push_str(&indent);
    out.push('<');
    out.push_str(&element.name);
    for attribute in &element.attributes {
        out.push(' ');
        out.push_str(&attribute.name);
        out.push_str("=\"");
        escape(out, &attribute.value).map_err(|character| {
            let (name, tag) = (&attribute.name, &element.name);
            format!("attribute '{name}' of <{tag}> holds {character:?}, which XML cannot say: remove it")
        })?;
        out.push('"');
    }
    if element.children.is_empty() {
        out.push_str("/>\n");
        return Ok(());
    }
    out.push_str(">\n");
    for child in &element.children {
        print_element(out, child, level + 1, depth)?;
    }
    out.push_str(&indent);
    out.push_str("</");
    out.push_str(&element.name);
    out.push_str(">\n");
    Ok(())
}

/// Appends `value` so that reading it gives the same characters.
fn escape(out: &mut String, value: &str) -> Result<(), char> {
    for c in value.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push_str(&format!("&#{};", c as u32)),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => return Err(c),
            _ => out.push(c),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_as_they_were() {
        for x in [0.0, -0.0, 0.1, 1.0 / 3.0, 1e-300, 1e22, 123456789.125, f64::INFINITY, -5e-324] {
            let text = number(x);
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), x.to_bits(), "{text}");
        }
        assert_eq!(numbers(&[0.1_f32, 1e-7, 1e7]), "0.1 1e-7 1e7");
        assert_eq!(integers(&[1000, -5000]), "1000 -5000");
    }

    #[test]
    fn what_xml_cannot_say_is_refused() {
        let mut root = element("mujoco");
        root.put("model", "a\u{1}b");
        assert!(print(&root, 10).unwrap_err().contains("'model' of <mujoco>"));
        let mut outer = element("a");
        outer.children.push(element("b"));
        assert!(print(&outer, 1).unwrap_err().contains("more than 1 deep"));
    }
}
