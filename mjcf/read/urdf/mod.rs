//! URDF as MuJoCo 3.12.0 reads it (modeling chapter, "URDF extensions"; URDF specification of ROS).
//!
//! Links become bodies, below the link that a joint names as parent; those without one stand fixed in the world, and a link
//! called `world` is the world. Bodies without joints are fused and visuals discarded, unless `<mujoco><compiler .../></mujoco>`
//! says otherwise. What MuJoCo has no use for (`mimic`, `transmission`, `gazebo`, velocity limits) is ignored with a warning
//! where it would change the motion.

mod joint;
mod link;
mod shape;

use std::collections::{BTreeMap, BTreeSet};

use super::reader::Reader;
use crate::include::Expansion;
use crate::schema::ElementType;
use crate::schema::option::OPTION;
use crate::schema::settings::{COMPILER, SIZE};
use crate::spec::{Body, Spec};
use crate::xml::Element;

/// The link that is the world.
const WORLD: &str = "world";

/// Children of `robot` that say nothing about the motion, or nothing that is simulated.
const KNOWN: [&str; 6] = ["mujoco", "material", "link", "joint", "transmission", "gazebo"];

/// Reads a tree whose root is `robot`; faulty values leave errors in the diagnostics.
pub(super) fn read(root: &Element, expansion: Expansion<'_>) -> Spec {
    let mut reader = Reader::new(root, expansion, Vec::new());
    let name = root.value("name");
    reader.spec.modelname = name.unwrap_or("MuJoCo Model").to_owned();
    reader.spec.world.name = WORLD.into();
    reader.spec.compiler.fusestatic = true;
    reader.spec.compiler.discardvisual = true;
    let mut robot = Robot::default();
    if let Some(extension) = reader.only(root, "mujoco") {
        reader.extension(extension);
    }
    reader.spec.compiler.degree = false;
    reader.materials(root, &mut robot.materials);
    for other in root.children.iter().filter(|child| !KNOWN.contains(&child.name.as_str())) {
        reader.warning(other.loc, format!("<{}> is ignored in a URDF", other.name));
    }
    let links = reader.links(root);
    reader.tree(&links, &mut robot);
    reader.spec
}

/// Nothing can be touched, and nothing moves.
fn is_empty(root: &Element) -> bool {
    let touched = |link: &Element| link.children_named("collision").next().is_some();
    let moves = |joint: &Element| joint.value("type") != Some("fixed");
    !root.children_named("link").any(touched) && !root.children_named("joint").any(moves)
}

/// What is known of the whole robot while its links are read.
#[derive(Default)]
struct Robot {
    /// Colours by the name of their material.
    materials: BTreeMap<String, [f32; 4]>,
    /// Names of geoms given so far; a second one of the same name goes without.
    geoms: BTreeSet<String>,
}

/// One link, and the joint above it.
struct Link<'e> {
    element: &'e Element,
    name: &'e str,
    /// The joint that names it as child, and its parent.
    above: Option<(&'e Element, usize)>,
    children: Vec<usize>,
}

impl Reader<'_> {
    /// The only child of this name; a second one is an error.
    fn only<'e>(&mut self, parent: &'e Element, tag: &str) -> Option<&'e Element> {
        let mut found = parent.children.iter().filter(|child| child.name == tag);
        let first = found.next();
        if let Some(second) = found.next() {
            self.error(second.loc, format!("<{tag}> may stand only once in <{}>", parent.name));
        }
        first
    }

    /// The same for a child that must be there.
    fn needed<'e>(&mut self, parent: &'e Element, tag: &str) -> Option<&'e Element> {
        let found = self.only(parent, tag);
        if found.is_none() {
            self.error(parent.loc, format!("<{}> needs a <{tag}> in it", parent.name));
        }
        found
    }

    /// The text of an attribute that must be there.
    fn text<'e>(&mut self, element: &'e Element, name: &str) -> Option<&'e str> {
        let found = element.value(name);
        if found.is_none() {
            self.error(element.loc, format!("<{}> needs the attribute '{name}'", element.name));
        }
        found
    }

    /// The numbers of an attribute; blank counts as absent.
    fn exact<const N: usize>(&mut self, element: &Element, name: &str) -> Option<[f64; N]> {
        let attribute = element.attribute(name)?;
        self.between::<f64>(element, attribute, N, N)?.first_chunk().copied()
    }

    /// The same for numbers that must be there.
    fn exactly_given<const N: usize>(&mut self, element: &Element, name: &str) -> Option<[f64; N]> {
        if element.value(name).unwrap_or_default().trim().is_empty() {
            self.error(element.loc, format!("<{}> needs the attribute '{name}'", element.name));
            return None;
        }
        self.exact(element, name)
    }

    /// MuJoCo's own settings. They are read, not checked: an attribute that is none of theirs is a warning.
    fn extension(&mut self, extension: &Element) {
        let mut section = |kind: &ElementType, read: fn(&mut Self, &Element)| {
            if let Some(section) = self.only(extension, kind.tag) {
                self.warn_of_unknown(section, kind);
                read(self, section);
            }
        };
        section(&COMPILER, Self::compiler);
        section(&OPTION, Self::option);
        section(&SIZE, Self::size);
        for other in &extension.children {
            if !matches!(other.name.as_str(), "compiler" | "option" | "size") {
                let message =
                    format!("<{}> is ignored: a URDF takes <compiler>, <option> and <size>", other.name);
                self.warning(other.loc, message);
            }
        }
    }

    fn warn_of_unknown(&mut self, section: &Element, kind: &ElementType) {
        let mut known = Vec::new();
        kind.each_attribute(false, &mut |facts| known.push(facts.name));
        for attribute in section.attributes.iter().filter(|a| !known.contains(&a.name.as_str())) {
            let near = self.expansion.diagnostics.nearest(&attribute.name, known.iter().copied());
            let hint = near.map_or(String::new(), |near| format!("; did you mean '{near}'?"));
            let message = format!("attribute '{}' of <{}> is ignored{hint}", attribute.name, section.name);
            self.warning(attribute.loc, message);
        }
    }

    /// The colours of all named materials, the first of each name.
    fn materials(&mut self, element: &Element, known: &mut BTreeMap<String, [f32; 4]>) {
        if element.name == "material"
            && let Some(name) = element.value("name").filter(|name| !known.contains_key(*name))
            && let Some(color) = self.only(element, "color")
            && let Some(rgba) = self.color(color)
        {
            known.insert(name.to_owned(), rgba);
        }
        for child in &element.children {
            self.materials(child, known);
        }
    }

    /// All links with their places in the tree.
    fn links<'e>(&mut self, root: &'e Element) -> Vec<Link<'e>> {
        let mut links: Vec<Link<'e>> = Vec::new();
        let mut places: BTreeMap<&'e str, usize> = BTreeMap::new();
        for element in root.children_named("link") {
            let Some(name) = self.text(element, "name") else { continue };
            if places.insert(name, links.len()).is_some() {
                self.error(element.loc, format!("duplicate link name '{name}'"));
            }
            links.push(Link { element, name, above: None, children: Vec::new() });
        }
        if links.is_empty() && root.children_named("link").next().is_none() {
            let hint = "add <link name=\"...\"> with <inertial> and <collision>".to_owned();
            self.error_with(root.loc, "<robot> has no <link>: nothing would be simulated", Some(hint));
        } else if is_empty(root) {
            let message = "no link has a <collision>, and no joint moves one: nothing is simulated";
            self.warning(root.loc, message);
        }
        for joint in root.children_named("joint") {
            let ends = ["parent", "child"].map(|tag| {
                let end = self.needed(joint, tag)?;
                let name = self.text(end, "link")?;
                let found = places.get(name).copied();
                if found.is_none() {
                    let near = self.expansion.diagnostics.nearest(name, places.keys().copied());
                    let hint = near.map(|near| format!("did you mean '{near}'?"));
                    self.error_with(end.loc, format!("no link is named '{name}'"), hint);
                }
                found
            });
            let [Some(parent), Some(child)] = ends else { continue };
            if links[child].above.is_some() {
                let name = links[child].name;
                self.error(joint.loc, format!("link '{name}' is the child of two joints"));
                continue;
            }
            links[child].above = Some((joint, parent));
            links[parent].children.push(child);
        }
        links
    }

    /// Adds all links to the world, parents before children.
    fn tree(&mut self, links: &[Link<'_>], robot: &mut Robot) {
        let mut bodies: Vec<Option<Body>> = links.iter().map(|link| self.link(link, robot)).collect();
        let mut world = std::mem::take(&mut self.spec.world);
        let mut reached = vec![false; links.len()];
        for top in (0..links.len()).filter(|&i| links[i].above.is_none()) {
            let found = self.subtree(top, links, &mut bodies, &mut reached, 0);
            world.bodies.extend(found);
        }
        if let Some(lost) = reached.iter().position(|reached| !reached) {
            let Link { name, element, .. } = links[lost];
            self.error(element.loc, format!("link '{name}' is its own ancestor: its joints go in a circle"));
        }
        if let Some(own) = links.iter().position(|link| link.name == WORLD)
            && let Some(fixed) = bodies[own].take()
        {
            world.geoms = fixed.geoms;
        }
        self.spec.world = world;
    }

    /// The bodies that `link` adds to its parent: itself with its children, or the children of the world.
    fn subtree(
        &mut self,
        link: usize,
        links: &[Link<'_>],
        bodies: &mut [Option<Body>],
        reached: &mut [bool],
        depth: usize,
    ) -> Vec<Body> {
        reached[link] = true;
        if depth > self.expansion.limits.depth {
            let most = self.expansion.limits.depth;
            self.error(links[link].element.loc, format!("links are nested more than {most} deep"));
            return Vec::new();
        }
        let mut children = Vec::new();
        for &child in &links[link].children {
            children.extend(self.subtree(child, links, bodies, reached, depth + 1));
        }
        if links[link].name == WORLD {
            return children;
        }
        let Some(mut body) = bodies[link].take() else { return children };
        body.bodies = children;
        vec![body]
    }
}
