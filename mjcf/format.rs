//! The format as data, for references and tools: elements with their attributes, sensors, and what was dropped.

use crate::compile::{datatype, needstage};
use crate::schema::legacy::{DROPPED, Fate};
use crate::schema::print::KindText;
use crate::schema::root::MUJOCO;
use crate::schema::sensor::{MEASUREMENTS, Simple};
use crate::schema::{ElementType, Rows, Rule};
use physics::model::{DataType, Stage};

/// An attribute of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attribute {
    /// Its name.
    pub name: &'static str,
    /// What it may hold, as in `3 real`.
    pub kind: String,
    /// One line on meaning, with unit.
    pub doc: &'static str,
    /// It must be present.
    pub required: bool,
    /// A default class may set it.
    pub in_defaults: bool,
}

/// An element of the format. One that may stand in several others is listed once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Element {
    /// Tag.
    pub tag: &'static str,
    /// One line on what it declares.
    pub doc: &'static str,
    /// Tags of the elements that it may stand in; none for the root.
    pub parents: Vec<&'static str>,
    /// The child of the root that it belongs to, or is; the root's own tag for the root.
    pub section: &'static str,
    /// Attributes.
    pub attributes: Vec<Attribute>,
    /// Rules between attributes, as sentences without a full stop.
    pub rules: Vec<String>,
}

/// All elements, the root first, in the order in which they stand in a text. What `default` holds repeats elements of other
/// sections and is left out: [`Attribute::in_defaults`] tells what may stand there.
///
/// ```
/// let elements = robohive_mjcf::format::elements();
/// let geom = elements.iter().find(|e| e.tag == "geom" && e.section == "worldbody").ok_or("no geom")?;
/// assert!(geom.parents.contains(&"body"));
/// let size = geom.attributes.iter().find(|a| a.name == "size").ok_or("no size")?;
/// assert!(size.kind.contains("real") && size.in_defaults && !size.required);
/// let compiler = elements.iter().find(|e| e.tag == "compiler").ok_or("no compiler")?;
/// assert!(compiler.attributes.iter().all(|a| !a.in_defaults));
/// # Ok::<(), &str>(())
/// ```
pub fn elements() -> Vec<Element> {
    let mut found = Vec::new();
    collect(&MUJOCO, None, MUJOCO.tag, &mut found);
    found.into_iter().map(|(_, element)| element).collect()
}

fn collect(
    kind: &'static ElementType,
    parent: Option<&'static ElementType>,
    section: &'static str,
    found: &mut Vec<(&'static ElementType, Element)>,
) {
    if let Some((_, known)) = found.iter_mut().find(|(other, _)| std::ptr::eq(*other, kind)) {
        known.parents.extend(parent.map(|parent| parent.tag).filter(|tag| !known.parents.contains(tag)));
        return;
    }
    let parents = parent.map(|parent| parent.tag).into_iter().collect();
    let rules = kind.rules.iter().map(sentence).collect();
    let element =
        Element { tag: kind.tag, doc: kind.doc, parents, section, attributes: attributes(kind), rules };
    found.push((kind, element));
    for child in kind.children.iter().filter(|child| !child.defaults) {
        collect(child.element, Some(kind), if parent.is_none() { child.element.tag } else { section }, found);
    }
}

fn attributes(kind: &ElementType) -> Vec<Attribute> {
    let mut list = Vec::new();
    for rows in kind.rows {
        let stands_in_classes = stands_in_classes(*rows);
        rows.describe(&mut |facts, kind, doc| {
            let (name, required) = (facts.name, facts.required);
            let in_defaults = facts.in_defaults && stands_in_classes;
            list.push(Attribute { name, kind: KindText(kind).to_string(), doc, required, in_defaults });
        });
    }
    list
}

/// Whether a block of rows belongs to an element that default classes hold.
fn stands_in_classes(rows: &'static dyn Rows) -> bool {
    let classes = MUJOCO.child("default").into_iter().flat_map(|default| default.element.children);
    let blocks = classes.filter(|child| child.defaults).flat_map(|child| child.element.rows);
    blocks.into_iter().any(|block| std::ptr::addr_eq(*block, rows))
}

fn sentence(rule: &Rule) -> String {
    let list = |bundles: &[&[&str]]| {
        let quoted = bundles.iter().map(|bundle| format!("`{}`", bundle.join("` with `")));
        quoted.collect::<Vec<_>>().join(", ")
    };
    match rule {
        Rule::Exclusive(bundles) => format!("only one of {}", list(bundles)),
        Rule::Together(names) => format!("`{}` only together", names.join("` and `")),
        Rule::OneOf(bundles) => format!("at least one of {}", list(bundles)),
    }
}

/// A sensor of the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sensor {
    /// Tag.
    pub tag: &'static str,
    /// What it measures.
    pub doc: &'static str,
    /// The stage of a forward pass that computes it; for `user` the text tells.
    pub stage: Stage,
    /// The kind of its numbers; for `user` the text tells.
    pub numbers: DataType,
}

/// All sensors but `plugin`, whose numbers its plugin tells.
pub fn sensors() -> Vec<Sensor> {
    let sensor = |row: &Simple| Sensor {
        tag: row.element.tag,
        doc: row.element.doc,
        stage: needstage(row.kind),
        numbers: datatype(row.kind),
    };
    MEASUREMENTS.iter().map(sensor).collect()
}

/// Attributes that newer versions of the format have dropped and models still carry: element, attribute, the only value that is
/// accepted where there is one, and why it makes no difference.
pub fn dropped() -> impl Iterator<Item = (&'static str, &'static str, Option<&'static str>, &'static str)> {
    DROPPED.iter().map(|&(element, attribute, fate)| match fate {
        Fate::Ignored(why) => (element, attribute, None, why),
        Fate::IgnoredIf(value, why) => (element, attribute, Some(value), why),
    })
}
