//! Structure and names of a tree against the tables: unknown elements and attributes, missing and
//! conflicting attributes, repeated elements, features that are not simulated, duplicate names, and names
//! that nothing declares. All findings are collected.

use std::collections::BTreeMap;

use super::legacy::{self, Fate};
use super::root::MUJOCO;
use super::tree::WORLDBODY;
use super::{Child, Count, ElementType, Facts, Naming, Rule, Space};
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::files::base_name;
use crate::xml::{Attribute, Element};

/// Names that the tree declares and uses.
#[derive(Default)]
struct Names {
    declared: BTreeMap<Space, BTreeMap<String, Loc>>,
    used: Vec<(Space, String, Loc)>,
    /// Some objects do not show in the tree, so an unknown name need not be an error.
    open: bool,
}

/// What fragments that are made to be included hold at their top, and MuJoCo loads as an empty world.
const STRAYS: [&str; 3] = ["body", "frame", "replicate"];

struct Check<'a> {
    sources: &'a Sources,
    diagnostics: &'a mut Diagnostics,
    names: Names,
}

/// Checks a piece of a model; the names that it uses may be declared elsewhere.
pub fn check_piece(
    piece: &Element,
    element: &'static ElementType,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) {
    let names = Names { open: true, ..Names::default() };
    Check { sources, diagnostics, names }.element(piece, element, false);
}

/// Checks `root` and everything below it against `element`; names that nothing declares are errors of a `whole` model.
pub fn check(
    root: &Element,
    element: &'static ElementType,
    whole: bool,
    sources: &Sources,
    diagnostics: &mut Diagnostics,
) {
    let names = Names { open: !whole, ..Names::default() };
    let mut check = Check { sources, diagnostics, names };
    for (space, name) in [(Space::Body, "world"), (Space::Class, "main")] {
        check.names.declared.entry(space).or_default().insert(name.into(), Loc::NONE);
    }
    check.element(root, element, false);
    check.references();
}

impl Check<'_> {
    fn error(&mut self, loc: Loc, message: String, advice: Option<String>) {
        self.diagnostics.error_with(self.sources, loc, message, advice);
    }

    fn element(&mut self, element: &Element, kind: &'static ElementType, defaults: bool) {
        // These have names that only the reader makes up; the compiler resolves references then.
        self.names.open |= matches!(kind.tag, "replicate" | "attach" | "composite" | "flexcomp");
        self.attributes(element, kind, defaults);
        for rule in kind.rules.iter().filter(|r| !defaults || matches!(r, Rule::Exclusive(_))) {
            self.rule(element, rule);
        }
        for child in &element.children {
            match kind.child(&child.name) {
                Some(Child { element: kind, defaults, .. }) => self.element(child, kind, *defaults),
                None => self.unknown_element(child, element, kind),
            }
        }
        for child in kind.children.iter().filter(|c| c.count == Count::Once) {
            if let Some(second) = element.children_named(child.element.tag).nth(1) {
                let message = format!("<{}> may stand only once in <{}>", second.name, element.name);
                self.error(second.loc, message, None);
            }
        }
    }

    fn unknown_element(&mut self, child: &Element, parent: &Element, kind: &'static ElementType) {
        if kind.tag == MUJOCO.tag
            && let Some(stray) = WORLDBODY.child(&child.name).filter(|c| STRAYS.contains(&c.element.tag))
        {
            let message = format!("<{}> outside of <worldbody> is ignored: put it inside", child.name);
            self.diagnostics.warning(self.sources, child.loc, message);
            return check_piece(child, stray.element, self.sources, self.diagnostics);
        }
        let message = format!("unknown element <{}> in <{}>", child.name, parent.name);
        let near = self.diagnostics.nearest(&child.name, kind.children.iter().map(|c| c.element.tag));
        self.error(child.loc, message, near.map(|n| format!("did you mean <{n}>?")));
    }

    fn attributes(&mut self, element: &Element, kind: &'static ElementType, defaults: bool) {
        let mut known: Vec<Facts> = Vec::new();
        kind.each_attribute(defaults, &mut |facts| known.push(facts));
        for attribute in &element.attributes {
            match known.iter().find(|f| f.name == attribute.name) {
                Some(facts) => self.name(element, attribute, facts, defaults),
                None => self.unknown_attribute(attribute, element, &known, kind, defaults),
            }
        }
        for facts in known.iter().filter(|f| f.required && !defaults) {
            if element.attribute(facts.name).is_none() {
                self.error(
                    element.loc,
                    format!("<{}> needs the attribute '{}'", element.name, facts.name),
                    None,
                );
            }
        }
        let named = known.iter().any(|f| f.name == "file") && element.value("name").unwrap_or("").is_empty();
        let declares = known.iter().find_map(|f| match f.naming {
            Naming::Declares(space) => Some(space),
            _ => None,
        });
        if let (true, Some(space), Some(file)) = (named, declares, element.attribute("file")) {
            let base = base_name(&file.value);
            let stem = base.rfind('.').map_or(base, |i| &base[..i]);
            self.declare(space, stem, file.value_loc);
        }
    }

    fn unknown_attribute(
        &mut self,
        attribute: &Attribute,
        element: &Element,
        known: &[Facts],
        kind: &'static ElementType,
        defaults: bool,
    ) {
        match legacy::fate(&element.name, &attribute.name) {
            Some(Fate::Ignored(why)) => return self.ignored(attribute, element, why),
            Some(Fate::IgnoredIf(value, why)) if attribute.value == value => {
                return self.ignored(attribute, element, why);
            }
            Some(Fate::IgnoredIf(value, why)) => {
                let message =
                    format!("attribute '{}' of <{}> is no longer supported", attribute.name, element.name);
                return self.error(
                    attribute.loc,
                    message,
                    Some(format!("only '{value}' is accepted: {why}")),
                );
            }
            None => {}
        }
        let mut elsewhere = false;
        kind.each_attribute(false, &mut |f| elsewhere |= f.name == attribute.name);
        if defaults && elsewhere {
            let message =
                format!("attribute '{}' of <{}> cannot have a default", attribute.name, element.name);
            return self.error(attribute.loc, message, None);
        }
        let message = format!("unknown attribute '{}' of <{}>", attribute.name, element.name);
        let near = self.diagnostics.nearest(&attribute.name, known.iter().map(|f| f.name));
        self.error(attribute.loc, message, near.map(|n| format!("did you mean '{n}'?")));
    }

    fn ignored(&mut self, attribute: &Attribute, element: &Element, why: &str) {
        let message = format!("attribute '{}' of <{}> is ignored: {why}", attribute.name, element.name);
        self.diagnostics.warning(self.sources, attribute.loc, message);
    }

    fn name(&mut self, element: &Element, attribute: &Attribute, facts: &Facts, defaults: bool) {
        let refer = |space| (space, attribute.value.clone(), attribute.value_loc);
        match facts.naming {
            Naming::Declares(space) => self.declare(space, &attribute.value, attribute.value_loc),
            // A default may name what no element that takes it needs.
            Naming::Refers(_) | Naming::RefersBy(_) if defaults => {}
            // The reader knows the classes of attached models too.
            Naming::Refers(Space::Class) => {}
            Naming::Refers(space) => self.names.used.push(refer(space)),
            Naming::RefersBy(by) => {
                if let Some(space) = element.value(by).and_then(Space::from_objtype) {
                    self.names.used.push(refer(space));
                }
            }
            Naming::None => {}
        }
    }

    fn declare(&mut self, space: Space, name: &str, loc: Loc) {
        if name.is_empty() {
            return;
        }
        let known = self.names.declared.entry(space).or_default();
        match known.get(name).copied() {
            None => {
                known.insert(name.to_string(), loc);
            }
            // The top-level default class may be spelled out, and default sections may repeat.
            Some(_) if space == Space::Class && name == "main" => {}
            Some(first) => {
                let first = self.sources.position(first).map(|p| format!("the first is at {p}"));
                self.error(loc, format!("duplicate {} name '{name}'", space.word()), first);
            }
        }
    }

    fn references(&mut self) {
        if self.names.open {
            return;
        }
        let none = BTreeMap::new();
        for (space, name, loc) in std::mem::take(&mut self.names.used) {
            let known = self.names.declared.get(&space).unwrap_or(&none);
            if name.is_empty() || known.contains_key(&name) {
                continue;
            }
            let near = self.diagnostics.nearest(&name, known.keys().map(String::as_str));
            let advice = near.map(|n| format!("did you mean '{n}'?"));
            let message = format!("no {} is named '{name}'", space.word());
            self.diagnostics.error_with(self.sources, loc, message, advice);
        }
    }

    fn rule(&mut self, element: &Element, rule: &Rule) {
        let present = |name: &&str| element.attribute(name).is_some();
        let list = |bundles: &[&[&str]]| {
            let quoted = bundles.iter().map(|b| format!("'{}'", b.join("' with '")));
            quoted.collect::<Vec<_>>().join(" or ")
        };
        let broken = match rule {
            Rule::Exclusive(bundles) => {
                let some = bundles.iter().filter(|b| b.iter().any(present)).count();
                (some > 1).then(|| format!("<{}> takes only one of {}", element.name, list(bundles)))
            }
            Rule::Together(names) => {
                let some = names.iter().filter(|a| present(a)).count();
                let partial = some != 0 && some != names.len();
                partial.then(|| format!("<{}> takes '{}' only together", element.name, names.join("' and '")))
            }
            Rule::OneOf(bundles) => {
                let complete = bundles.iter().any(|b| b.iter().all(present));
                (!complete).then(|| format!("<{}> needs {}", element.name, list(bundles)))
            }
        };
        if let Some(message) = broken {
            self.error(element.loc, message, None);
        }
    }
}
