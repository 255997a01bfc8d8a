//! Elements added as MJCF says them.

use physics::model::ObjType;

use super::find::missing;
use super::{reading, refuse};
use crate::budget::Budget;
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::read::Place;
use crate::schema::check::check_piece;
use crate::schema::root::MUJOCO;
use crate::schema::tree::{BODY, WORLDBODY};
use crate::spec::{Body, Spec};
use crate::xml::{self, Attribute, Element, Limits};

/// What findings call the text of an edit.
const LABEL: &str = "<edit>";

impl Spec {
    /// Adds elements to the body called `onto`: `piece` is MJCF as it stands inside a body, for example
    /// `<geom type="box" size=".1 .1 .1"/>` or a body with all in it. It may name the classes of the model, `class="main"` if none
    /// is named.
    ///
    /// # Errors
    /// There is no such body; the piece is no MJCF, with line and column; a name is taken.
    pub fn add(&mut self, onto: &str, piece: &str) -> Result<(), Diagnostics> {
        let (root, sources) = parsed(piece)?;
        self.add_elements(onto, root.children, sources)
    }

    /// Adds one element to the body called `onto`: its tag, and attributes by name.
    ///
    /// # Errors
    /// As [`Spec::add`].
    pub fn add_element(
        &mut self,
        onto: &str,
        tag: &str,
        attributes: &[(&str, &str)],
    ) -> Result<(), Diagnostics> {
        self.add_elements(onto, vec![element(tag, attributes)], Sources::default())
    }

    /// Adds to the sections of the model: `sections` is MJCF as it stands in `<mujoco>`, for example
    /// `<actuator><motor joint="hinge"/></actuator>` or `<option timestep="0.001"/>`. What is added to `<worldbody>` goes to
    /// the world.
    ///
    /// # Errors
    /// The text is no MJCF, with line and column; a name is taken.
    pub fn extend(&mut self, sections: &str) -> Result<(), Diagnostics> {
        let (root, sources) = parsed(sections)?;
        self.add_sections(root, sources)
    }

    /// Adds one element to a section: `("actuator", "motor", &[("joint", "hinge")])`.
    ///
    /// # Errors
    /// As [`Spec::extend`].
    pub fn extend_element(
        &mut self,
        section: &str,
        tag: &str,
        attributes: &[(&str, &str)],
    ) -> Result<(), Diagnostics> {
        let child = element(tag, attributes);
        let section = Element { children: vec![child], ..element(section, &[]) };
        let root = Element { children: vec![section], ..element("mujoco", &[]) };
        self.add_sections(root, Sources::default())
    }

    fn add_elements(
        &mut self,
        onto: &str,
        children: Vec<Element>,
        sources: Sources,
    ) -> Result<(), Diagnostics> {
        if self.body(onto).is_none() {
            return Err(missing(ObjType::Body, onto, self.bodies().map(|body| body.name.as_str())));
        }
        let world = onto == self.world.name;
        let kind = if world { &WORLDBODY } else { &BODY };
        let holder = Element { children, ..element(kind.tag, &[]) };
        let (piece, read) = reading(self.settings(), sources, |reader| {
            reader.open = vec![Body::default()];
            let expansion = &mut reader.expansion;
            check_piece(&holder, kind, expansion.sources, expansion.diagnostics);
            if !expansion.diagnostics.has_errors() {
                reader.inside(&holder, Place { frame: None, class: 0, body_class: 0, world });
            }
            reader.open.swap_remove(0)
        })?;
        let has_inertial = self.body(onto).is_some_and(|body| body.inertial.is_some());
        if has_inertial && piece.inertial.is_some() {
            return refuse(format!("the body '{onto}' has <inertial> already"));
        }
        self.merge(onto, Spec { world: piece, ..read })
    }

    fn add_sections(&mut self, root: Element, sources: Sources) -> Result<(), Diagnostics> {
        let (_, mut read) = reading(self.settings(), sources, |reader| {
            let expansion = &mut reader.expansion;
            check_piece(&root, &MUJOCO, expansion.sources, expansion.diagnostics);
            if !expansion.diagnostics.has_errors() {
                reader.sections(&root);
            }
        })?;
        if root.children_named("asset").any(|section| section.children_named("model").next().is_some()) {
            return refuse("<model> cannot be added: parse the model, and attach it with `attach`");
        }
        read.world.name.clear();
        let world = self.world.name.clone();
        let settings = Spec {
            compiler: read.compiler.clone(),
            option: read.option.clone(),
            visual: read.visual.clone(),
            stat: read.stat.clone(),
            size: read.size.clone(),
            classes: read.classes.clone(),
            ..Spec::default()
        };
        self.merge(&world, read)?;
        self.compiler = settings.compiler;
        self.option = settings.option;
        self.visual = settings.visual;
        self.stat = settings.stat;
        self.size = settings.size;
        self.classes = settings.classes;
        Ok(())
    }

    /// A model of the same settings and classes that holds no element.
    fn settings(&self) -> Spec {
        Spec {
            compiler: self.compiler.clone(),
            option: self.option.clone(),
            visual: self.visual.clone(),
            stat: self.stat.clone(),
            size: self.size.clone(),
            classes: self.classes.clone(),
            ..Spec::default()
        }
    }

    /// Adds the elements of `added`; what its world holds goes to the body called `onto`.
    fn merge(&mut self, onto: &str, mut added: Spec) -> Result<(), Diagnostics> {
        let names = self.all_names();
        if let Some((space, name)) = added.all_names().intersection(&names).next() {
            return refuse(format!("there is a {} '{name}' already", space.word()));
        }
        if !self.keys.is_empty() || !self.kept_keys.is_empty() {
            // New elements take their place among the old ones, and keyframes keep to the elements.
            self.spread_keys()?;
        }
        added.map_places(&mut |_| Loc::NONE);
        let shift = self.frames.len();
        super::rename::each_body(&mut added.world, &mut |body| shift_frames(body, shift));
        for frame in &mut added.frames {
            frame.parent = frame.parent.map(|parent| parent + shift);
        }
        self.frames.append(&mut added.frames);
        let target = self.body_mut(onto)?;
        target.inertial = target.inertial.take().or(added.world.inertial.take());
        crate::read::copy::append(target, added.world);
        macro_rules! lists {
            ($($list:ident)*) => { $(self.$list.append(&mut added.$list);)* };
        }
        lists!(meshes skins hfields textures materials pairs excludes flexes equalities tendons actuators sensors numerics texts
               tuples keys);
        Ok(())
    }
}

fn shift_frames(body: &mut Body, shift: usize) {
    let moved = |frame: &mut Option<usize>| *frame = frame.map(|f| f + shift);
    body.joints.iter_mut().for_each(|x| moved(&mut x.frame));
    body.geoms.iter_mut().for_each(|x| moved(&mut x.frame));
    body.sites.iter_mut().for_each(|x| moved(&mut x.frame));
    body.cameras.iter_mut().for_each(|x| moved(&mut x.frame));
    body.lights.iter_mut().for_each(|x| moved(&mut x.frame));
    body.bodies.iter_mut().for_each(|x| moved(&mut x.frame));
}

/// An element that no text holds.
pub(super) fn element(tag: &str, attributes: &[(&str, &str)]) -> Element {
    let attributes = attributes
        .iter()
        .map(|(name, value)| Attribute {
            name: (*name).to_owned(),
            value: (*value).to_owned(),
            ..Attribute::default()
        })
        .collect();
    Element { name: tag.to_owned(), attributes, ..Element::default() }
}

/// What stands around pieces, so that they are one document.
const AROUND: [&str; 2] = ["<mujoco>", "</mujoco>"];

/// Pieces of MJCF in one element around them; places count in the pieces alone.
fn parsed(pieces: &str) -> Result<(Element, Sources), Diagnostics> {
    let (limits, mut diagnostics) = (Limits::default(), Diagnostics::default());
    let (mut sources, mut budget) = (Sources::default(), Budget::new(limits.memory));
    let [before, after] = AROUND;
    let text = format!("{before}{pieces}{after}");
    let root = xml::parse(LABEL, text.as_bytes(), None, &limits, &mut budget, &mut sources, &mut diagnostics);
    let Some(mut root) = root else {
        let first_line =
            diagnostics.list.iter_mut().filter_map(|d| d.position.as_mut()).filter(|p| p.line == 1);
        first_line.for_each(|p| p.column = p.column.saturating_sub(before.len()).max(1));
        return Err(diagnostics);
    };
    move_back(&mut root, before.len() as u32);
    let mut sources = Sources::default();
    sources.add(LABEL, pieces.into(), None);
    Ok((root, sources))
}

fn move_back(element: &mut Element, bytes: u32) {
    let moved = |loc: &mut Loc| loc.offset = loc.offset.saturating_sub(bytes);
    moved(&mut element.loc);
    for attribute in &mut element.attributes {
        moved(&mut attribute.loc);
        moved(&mut attribute.value_loc);
    }
    element.children.iter_mut().for_each(|child| move_back(child, bytes));
}
