//! `replicate`: numbered copies of a piece of the tree, and of everything that refers into it.
//!
//! Copy `i` stands in a frame turned by `i` times the Euler angles; its origin follows the previous copy's by
//! `offset` in that copy's axes. Names get the separator and the number, padded to the digits of the count.
//! An actuator, equality or tuple whose every reference leads into the piece is copied with it, and so is a
//! tendon, sensor, pair or exclusion with one reference that does; what refers to nothing is not (MuJoCo 3.12
//! multiplies clocks by accident).

use std::ops::Range;

use physics::math::{Vec3, quat_rotate};

use super::copy::{Affix, Names, Referring, Renaming, append, collect, elements, forget_keys};
use super::reader::Reader;
use super::tree::Place;
use crate::budget::{ADVICE, Budget, ELEMENT};
use crate::schema::Space;
use crate::schema::tree::{REPLICATE_ROWS, Replicate};
use crate::spec::resolve;
use crate::spec::{Body, Frame, Orientation, PluginInstance, Spec};
use crate::xml::Element;

impl Reader<'_> {
    pub(super) fn replicate(&mut self, element: &Element, place: Place) {
        let class = self.class_of(element, "childclass", place.class);
        let mut wanted = Replicate::default();
        self.rows(element, &REPLICATE_ROWS, &mut wanted);
        let Ok(count) = usize::try_from(wanted.count) else {
            return self.error(element.loc, "<replicate> cannot make a negative number of copies");
        };
        let first = self.spec.frames.len();
        self.spec.frames.push(Frame { loc: element.loc, parent: place.frame, ..Frame::default() });
        self.open.push(Body::default());
        self.inside(element, Place { frame: Some(first), class, body_class: class, world: place.world });
        let mut piece = self.open.pop().unwrap_or_default();
        if let Some(inertial) = &piece.inertial {
            self.error(inertial.loc, "<replicate> cannot hold <inertial>");
        }
        if let Some(plugin) = &piece.plugin {
            self.error(plugin.loc, "<replicate> cannot hold <plugin>: put it into a body");
        }
        let frames = first..self.spec.frames.len();
        let mut names = Names::new();
        collect(&piece, &mut names);
        self.copied = self.copied.saturating_add(elements(&piece).saturating_mul(count));
        let most = self.expansion.limits.copies;
        if self.copied > most {
            return self.error(element.loc, format!("<replicate> makes more than {most} elements"));
        }
        let bytes = elements(&piece).saturating_mul(count).saturating_mul(ELEMENT);
        if !self.charge(element.loc, &format!("{count} copies of <replicate>"), bytes) {
            return;
        }
        let suffixes = suffixes(&wanted);
        let poses = match poses(&wanted, &self.spec) {
            Ok(poses) => poses,
            Err(message) => return self.error(element.loc, message),
        };
        for (suffix, pose) in suffixes.iter().zip(poses) {
            let shift = self.copy_frames(&frames, pose, suffix);
            let affix = Affix { prefix: "", suffix };
            let renaming = Renaming { affix: &affix, targets: Some(&names), assets: false };
            let mut copy = piece.clone();
            renaming.contents(&mut copy, true, &mut |frame, _| frame.map(|f| f + shift));
            self.copy_composites(&mut copy, suffix);
            append(self.body_here(), copy);
            // The first copy takes the keyframes of attached models along.
            forget_keys(&mut piece);
        }
        for frame in &mut self.spec.frames[frames] {
            frame.name.clear();
        }
        if let Err(message) = copy_references(&mut self.spec, &names, &suffixes, self.expansion.budget) {
            self.error_with(element.loc, message, Some(ADVICE.into()));
        }
    }

    /// Gives the composites of a copy instances of their own: a cable has one.
    fn copy_composites(&mut self, copy: &mut Body, suffix: &str) {
        let mut pending = vec![copy];
        while let Some(body) = pending.pop() {
            if let Some(used) = &mut body.plugin {
                let known = |spec: &Spec, name: &str| spec.plugins.iter().position(|p| p.name == *name);
                let made = known(&self.spec, &used.instance).filter(|&i| self.spec.plugins[i].expanded);
                if let Some(original) = made {
                    Affix { prefix: "", suffix }.apply(&mut used.instance);
                    if known(&self.spec, &used.instance).is_none() {
                        let name = used.instance.clone();
                        let instance = PluginInstance { name, ..self.spec.plugins[original].clone() };
                        self.spec.plugins.push(instance);
                    }
                }
            }
            pending.extend(&mut body.bodies);
        }
    }

    /// Adds the frames of one copy and returns how far their indices are from the originals'.
    fn copy_frames(&mut self, frames: &Range<usize>, (pos, euler): (Vec3, Vec3), suffix: &str) -> usize {
        let shift = self.spec.frames.len() - frames.start;
        for i in frames.clone() {
            let mut frame = self.spec.frames[i].clone();
            Affix { prefix: "", suffix }.apply(&mut frame.name);
            match i == frames.start {
                true => (frame.pos, frame.alt) = (pos, Some(Orientation::Euler(euler))),
                false => frame.parent = frame.parent.map(|p| if p >= frames.start { p + shift } else { p }),
            }
            self.spec.frames.push(frame);
        }
        shift
    }
}

fn suffixes(wanted: &Replicate) -> Vec<String> {
    let digits = wanted.count.to_string().len();
    (0..wanted.count).map(|i| format!("{}{i:0digits$}", wanted.sep)).collect()
}

/// Origin and Euler angles of every copy.
fn poses(wanted: &Replicate, spec: &Spec) -> Result<Vec<(Vec3, Vec3)>, String> {
    let mut origin = [0.0; 3];
    let mut poses = Vec::with_capacity(wanted.count as usize);
    for i in 0..wanted.count {
        let euler = wanted.euler.map(|angle| f64::from(i) * angle);
        poses.push((origin, euler));
        let quat = resolve([1.0, 0.0, 0.0, 0.0], Some(Orientation::Euler(euler)), &spec.compiler)?;
        let step = quat_rotate(quat, wanted.offset);
        origin = std::array::from_fn(|k| origin[k] + step[k]);
    }
    Ok(poses)
}

fn copy_references(
    spec: &mut Spec,
    names: &Names,
    suffixes: &[String],
    budget: &mut Budget,
) -> Result<(), String> {
    let flexes = copy_list(&mut spec.flexes, names, suffixes, budget)?;
    copy_list(&mut spec.pairs, names, suffixes, budget)?;
    copy_list(&mut spec.excludes, names, suffixes, budget)?;
    // Tendons come before what may refer to them, and pass on their own copies' names.
    let tendons = copy_list(&mut spec.tendons, names, suffixes, budget)?;
    let mut names = names.clone();
    names.extend(tendons.into_iter().map(|name| (Space::Tendon, name)));
    names.extend(flexes.into_iter().map(|name| (Space::Flex, name)));
    copy_list(&mut spec.equalities, &names, suffixes, budget)?;
    let fixed = spec.actuators.len();
    let actuators = copy_list(&mut spec.actuators, &names, suffixes, budget)?;
    spec.actuators.iter_mut().skip(fixed).for_each(|a| a.keyed.clear());
    names.extend(actuators.into_iter().map(|name| (Space::Actuator, name)));
    copy_list(&mut spec.sensors, &names, suffixes, budget)?;
    copy_list(&mut spec.tuples, &names, suffixes, budget)?;
    Ok(())
}

/// Replaces the objects that refer into the piece by one copy for each suffix, at the end of the list;
/// returns the names of the objects replaced.
///
/// # Errors
/// The copies need more memory than is left.
fn copy_list<T: Referring>(
    list: &mut Vec<T>,
    names: &Names,
    suffixes: &[String],
    budget: &mut Budget,
) -> Result<Vec<String>, String> {
    let inside = |object: &mut T| {
        let (_, references) = object.names();
        let known =
            references.iter().filter(|(space, name)| names.contains(&(*space, (*name).clone()))).count();
        known > 0 && (T::MIXED || known == references.len())
    };
    let (originals, kept): (Vec<T>, Vec<T>) =
        std::mem::take(list).into_iter().partition(|o| inside(&mut o.clone()));
    *list = kept;
    let copies = originals.len().saturating_mul(suffixes.len());
    let elements = originals.iter().map(T::elements).sum::<usize>().saturating_mul(suffixes.len());
    budget.take(
        &format!("{copies} copies of what refers into <replicate>"),
        elements.saturating_mul(ELEMENT),
    )?;
    for suffix in suffixes {
        list.extend(originals.iter().cloned().map(|mut object| {
            let (name, references) = object.names();
            let affix = Affix { prefix: "", suffix };
            affix.apply(name);
            for (space, reference) in references {
                if names.contains(&(space, reference.clone())) {
                    affix.apply(reference);
                }
            }
            object
        }));
    }
    let names = originals.into_iter().map(|mut o| std::mem::take(o.names().0));
    Ok(names.filter(|n| !n.is_empty()).collect())
}
