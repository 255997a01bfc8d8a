//! MJCF: elements with their attributes, sensors, and what is dropped, from the tables that read them.

use super::{cell, plain};
use mjcf::format::{Element, dropped as dropped_attributes, elements, sensors as all_sensors};
use physics::model::{DataType, Stage};
use std::fmt::Write;

/// All elements, by sections, after a table of the sections.
pub fn format() -> String {
    let elements = elements();
    let mut sections: Vec<&str> = Vec::new();
    for element in &elements {
        if !sections.contains(&element.section) {
            sections.push(element.section);
        }
    }
    let of = |section: &str| -> Vec<&Element> {
        elements.iter().filter(|element| element.section == section).collect()
    };
    let mut text = String::from("| section | elements | attributes | |\n|---|---|---|---|\n");
    // Writing to a String cannot fail.
    for section in &sections {
        let members = of(section);
        let attributes: usize = members.iter().map(|element| element.attributes.len()).sum();
        let doc = members.first().map_or("", |element| element.doc);
        let _ = writeln!(
            text,
            "| [`{section}`](#section-{section}) | {} | {attributes} | {} |",
            members.len(),
            cell(doc)
        );
    }
    let attributes: usize = elements.iter().map(|element| element.attributes.len()).sum();
    let _ = writeln!(text, "| all | {} | {attributes} | |\n", elements.len());
    for section in sections {
        let _ = writeln!(text, "## Section {section}\n");
        of(section).into_iter().for_each(|element| describe(&mut text, element));
    }
    text
}

fn describe(out: &mut String, element: &Element) {
    let parents: Vec<_> = element.parents.iter().map(|tag| format!("`{tag}`")).collect();
    let inside = if parents.is_empty() { String::new() } else { format!(" In {}.", parents.join(", ")) };
    // Writing to a String cannot fail.
    let _ = writeln!(out, "### `{}`\n\n{}.{inside}\n", element.tag, plain(element.doc));
    if !element.attributes.is_empty() {
        let _ = writeln!(out, "| attribute | value | in default classes | meaning |\n|---|---|---|---|");
    }
    for attribute in &element.attributes {
        let needed = if attribute.required { " (required)" } else { "" };
        let classes = if attribute.in_defaults { "yes" } else { "" };
        let kind = cell(&attribute.kind.replace('|', " · "));
        let _ = writeln!(
            out,
            "| `{}`{needed} | {kind} | {classes} | {} |",
            attribute.name,
            plain(&cell(attribute.doc))
        );
    }
    let _ = writeln!(out);
    for rule in &element.rules {
        let _ = writeln!(out, "- {rule}");
    }
    let _ = writeln!(out);
}

/// All sensors with the numbers that they give.
pub fn sensors() -> String {
    let elements = elements();
    let mut text =
        String::from("| sensor | measures | of | numbers | computed with |\n|---|---|---|---|---|\n");
    for sensor in all_sensors() {
        let element =
            elements.iter().find(|element| element.section == "sensor" && element.tag == sensor.tag);
        let needed = element.into_iter().flat_map(|element| &element.attributes);
        let needed: Vec<_> =
            needed.filter(|attribute| attribute.required).map(|a| format!("`{}`", a.name)).collect();
        let numbers = match sensor.numbers {
            DataType::Real => "any",
            DataType::Positive => "not negative",
            DataType::Axis => "unit vector",
            DataType::Quaternion => "quaternion",
        };
        let stage = match sensor.stage {
            Stage::None => "nothing",
            Stage::Pos => "positions",
            Stage::Vel => "velocities",
            Stage::Acc => "accelerations",
        };
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {numbers} | {stage} |",
            sensor.tag,
            plain(&cell(sensor.doc)),
            needed.join(", ")
        );
    }
    text
}

/// Attributes of older models that are ignored.
pub fn dropped() -> String {
    let mut text = String::from("| element | attribute | accepted | why |\n|---|---|---|---|\n");
    for (element, attribute, value, why) in dropped_attributes() {
        let value = value.map_or("any value".to_owned(), |value| format!("`{value}`"));
        // Writing to a String cannot fail.
        let _ = writeln!(text, "| `{element}` | `{attribute}` | {value} | {} |", cell(why));
    }
    text
}
