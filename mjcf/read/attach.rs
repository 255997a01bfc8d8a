//! `attach`: a copy of a body, of a frame's contents or of a whole world, from this model or another, under
//! names with a prefix; with it come what refers into it and, from another model, assets, custom data, default
//! classes and keyframes (modeling chapter, "Attachment").
//!
//! Keyframes stay with the original of a part of this model. Elements keep the compiler settings of the text they stand in. An object is left out when a reference of
//! it leads nowhere.

use std::collections::{BTreeMap, BTreeSet};

use super::attached_frames::{FrameCopies, find_frame, holder, missing, within};
use super::copy::{Affix, Names, Referring, Renaming, append, collect, collect_objects, elements};
use super::reader::ModelFile;
use super::reader::Reader;
use super::tree::Place;
use crate::budget::{ADVICE, ELEMENT};
use crate::schema::Space;
use crate::schema::tree::{ATTACH_ROWS, Attach};
use crate::spec::asset_name;
use crate::spec::{Body, Frame, KeptKey, Keyed, Skin, Spec};
use crate::xml::Element;

/// Inline numbers of an asset that count as one element.
const NUMBERS_PER_ELEMENT: usize = 16;

impl Reader<'_> {
    pub(super) fn attach(&mut self, element: &Element, place: Place) {
        let mut wanted = Attach::default();
        self.rows(element, &ATTACH_ROWS, &mut wanted);
        let models = std::mem::take(&mut self.models);
        let result = match element.attribute("model") {
            None => self.attach_own(element, &wanted, place),
            Some(name) => match models.iter().find(|m| m.name == name.value) {
                Some(model) => self.attach_model(element, &wanted, place, model),
                None => Err(format!("no model asset is named '{}'", name.value)),
            },
        };
        self.models = models;
        if let Err(message) = result {
            self.error(element.loc, message);
        }
    }

    fn attach_own(&mut self, element: &Element, wanted: &Attach, place: Place) -> Result<(), String> {
        if wanted.body.is_empty() && wanted.frame.is_empty() {
            return Err("<attach> without 'model' needs the attribute 'body' or 'frame'".into());
        }
        if !self.spec.keys.is_empty() {
            return Err("parts of a model that has keyframes cannot be attached to itself".into());
        }
        self.check_free(wanted)?;
        let frames = self.spec.frames.clone();
        let source = if wanted.frame.is_empty() {
            let around = self.open.iter().any(|b| b.name == wanted.body);
            let found = self.open.iter().find_map(|b| find_body(b, &wanted.body)).filter(|_| !around);
            Source::Body(found.cloned().ok_or_else(|| missing("body", &wanted.body))?)
        } else {
            let top = find_frame(&frames, &wanted.frame)?;
            let encloses = |frame| within(frame, top, &frames);
            if encloses(place.frame) || self.open.iter().skip(1).any(|b| encloses(b.frame)) {
                return Err(format!("frame '{}' cannot be attached inside itself", wanted.frame));
            }
            Source::Frame(self.open.iter().find_map(|b| holder(b, top, &frames)).unwrap_or_default(), top)
        };
        let source = source.keyed(&[]);
        let affix = Affix { prefix: &wanted.prefix, suffix: "" };
        let names = self.graft(element, source, &frames, place, &affix, false)?;
        let objects = Spec {
            flexes: self.spec.flexes.clone(),
            pairs: self.spec.pairs.clone(),
            excludes: self.spec.excludes.clone(),
            tendons: self.spec.tendons.clone(),
            equalities: self.spec.equalities.clone(),
            actuators: self.spec.actuators.clone(),
            sensors: self.spec.sensors.clone(),
            tuples: self.spec.tuples.clone(),
            ..Spec::default()
        };
        self.copy_objects(&objects, &affix, names, None)
    }

    pub(crate) fn attach_model(
        &mut self,
        element: &Element,
        wanted: &Attach,
        place: Place,
        model: &ModelFile,
    ) -> Result<(), String> {
        self.check_free(wanted)?;
        let child = &model.spec;
        if !self.settle(child, &model.authored, element.loc) {
            return Ok(());
        }
        let source = if !wanted.frame.is_empty() {
            let top = find_frame(&child.frames, &wanted.frame)?;
            Source::Frame(holder(&child.world, top, &child.frames).unwrap_or_default(), top)
        } else if !wanted.body.is_empty() {
            let found = find_body(&child.world, &wanted.body);
            Source::Body(found.cloned().ok_or_else(|| missing("body", &wanted.body))?)
        } else {
            Source::World(child.world.clone())
        };
        let keys = self.keep_keys(model, &wanted.prefix);
        let affix = Affix { prefix: &wanted.prefix, suffix: "" };
        let mut names = self.graft(element, source.keyed(&keys), &child.frames, place, &affix, true)?;
        self.spec.attached.insert(model.first_file, child.compiler.clone());
        self.spec.attached.extend(child.attached.iter().map(|(k, v)| (*k, v.clone())));
        let offset = self.spec.classes.list.len();
        self.spec.classes.list.extend(model.spec.classes.list.iter().cloned());
        for (name, id) in &model.spec.classes.names {
            self.spec.classes.names.entry(format!("{}{name}", wanted.prefix)).or_insert(id + offset);
        }
        self.copy_assets(child, &affix, &mut names)?;
        self.copy_skins(child, &affix, &names);
        self.copy_objects(child, &affix, names, Some(&keys))
    }

    /// The name of the copy must be free.
    fn check_free(&self, wanted: &Attach) -> Result<(), String> {
        let body = format!("{}{}", wanted.prefix, wanted.body);
        let frame = format!("{}{}", wanted.prefix, wanted.frame);
        if !wanted.body.is_empty() && self.open.iter().any(|b| find_body(b, &body).is_some()) {
            return Err(format!("there is a body '{body}' already: another prefix is needed"));
        }
        if !wanted.frame.is_empty() && self.spec.frames.iter().any(|f| f.name == frame) {
            return Err(format!("there is a frame '{frame}' already: another prefix is needed"));
        }
        Ok(())
    }

    /// Adds the piece to the open body and returns the names in it.
    fn graft(
        &mut self,
        element: &Element,
        source: Source,
        frames: &[Frame],
        place: Place,
        affix: &Affix<'_>,
        assets: bool,
    ) -> Result<Names, String> {
        let onto = place.frame.unwrap_or_else(|| {
            self.spec.frames.push(Frame { loc: element.loc, ..Frame::default() });
            self.spec.frames.len() - 1
        });
        let mut copies =
            FrameCopies { from: frames, to: &mut self.spec.frames, copied: BTreeMap::new(), affix };
        let mut base = onto;
        let renaming = Renaming { affix, targets: None, assets };
        let mut piece = match source {
            Source::Body(body) => Body { bodies: vec![Body { frame: None, ..body }], ..Body::default() },
            Source::Frame(body, top) => {
                copies.add(top, Some(onto));
                body
            }
            Source::World(body) => {
                copies.to.push(Frame { loc: element.loc, parent: Some(onto), ..Frame::default() });
                base = copies.to.len() - 1;
                body
            }
        };
        renaming.contents(&mut piece, true, &mut |frame, top| copies.of(frame, top.then_some(base)));
        if place.world && !piece.joints.is_empty() {
            return Err("the world cannot have the joints of the attached part".into());
        }
        self.count(elements(&piece))?;
        let mut names = Names::new();
        collect(&piece, &mut names);
        append(self.body_here(), piece);
        Ok(names)
    }

    fn count(&mut self, copied: usize) -> Result<(), String> {
        self.copied = self.copied.saturating_add(copied);
        let most = self.expansion.limits.copies;
        if self.copied > most {
            return Err(format!("<attach> makes more than {most} elements"));
        }
        let bytes = copied.saturating_mul(ELEMENT);
        self.expansion.budget.take("copies of <attach>", bytes).map_err(|e| format!("{e}; {ADVICE}"))
    }

    /// Takes over the keyframes of a model; maps its indices to those here.
    fn keep_keys(&mut self, model: &ModelFile, prefix: &str) -> Vec<Option<usize>> {
        let first = !self.spec.attached.contains_key(&model.first_file);
        let mut places = Vec::with_capacity(model.spec.kept_keys.len());
        for key in &model.spec.kept_keys {
            // Keyframes that the model itself took over come once, under the name they have there.
            places.push((key.own || first).then_some(self.spec.kept_keys.len()));
            if key.own || first {
                let name = if key.own { format!("{prefix}{}", key.name) } else { key.name.clone() };
                self.spec.kept_keys.push(KeptKey { name, own: false, ..key.clone() });
            }
        }
        places
    }

    fn copy_assets(&mut self, child: &Spec, affix: &Affix<'_>, names: &mut Names) -> Result<(), String> {
        let inline = child.meshes.iter().map(|m| m.uservert.len() + m.userface.len()).sum::<usize>()
            + child.hfields.iter().map(|h| h.userdata.len()).sum::<usize>()
            + child.skins.iter().map(numbers_of_skin).sum::<usize>();
        self.count(
            inline / NUMBERS_PER_ELEMENT
                + child.meshes.len()
                + child.skins.len()
                + child.textures.len()
                + child.materials.len(),
        )?;
        let materials: BTreeSet<&String> = self.spec.materials.iter().map(|m| &m.name).collect();
        let mut meshes = child.meshes.clone();
        for mesh in &mut meshes {
            mesh.name = asset_name(&mesh.name, &mesh.path);
            affix.apply(&mut mesh.name);
            if !materials.contains(&mesh.material) {
                affix.apply(&mut mesh.material);
            }
        }
        meshes.iter_mut().filter_map(|m| m.plugin.as_mut()).for_each(|used| affix.apply(&mut used.instance));
        self.copy_plugins(child, affix);
        let mut hfields = child.hfields.clone();
        for hfield in &mut hfields {
            hfield.name = asset_name(&hfield.name, &hfield.path);
            affix.apply(&mut hfield.name);
        }
        let mut textures = child.textures.clone();
        for texture in &mut textures {
            texture.name = asset_name(&texture.name, &texture.path);
            affix.apply(&mut texture.name);
        }
        let mut materials = child.materials.clone();
        for material in &mut materials {
            affix.apply(&mut material.name);
            material.textures.iter_mut().for_each(|t| affix.apply(t));
        }
        let mut numerics = child.numerics.clone();
        numerics.iter_mut().for_each(|n| affix.apply(&mut n.name));
        let mut texts = child.texts.clone();
        texts.iter_mut().for_each(|t| affix.apply(&mut t.name));
        let copied = Spec { meshes, hfields, textures, materials, numerics, texts, ..Spec::default() };
        collect_objects(&copied, names);
        self.spec.meshes.extend(copied.meshes);
        self.spec.hfields.extend(copied.hfields);
        self.spec.textures.extend(copied.textures);
        self.spec.materials.extend(copied.materials);
        self.spec.numerics.extend(copied.numerics);
        self.spec.texts.extend(copied.texts);
        Ok(())
    }

    /// Copies the skins all of whose bones are copied. The bones of a file keep their names.
    fn copy_skins(&mut self, child: &Spec, affix: &Affix<'_>, inside: &Names) {
        let mut target = Target { reader: self, affix, inside: inside.clone(), outside: None };
        let mut skins = Vec::new();
        for original in &child.skins {
            let name = asset_name(&original.name, &original.path);
            let Some(mut skin) = target.copy(&Skin { name, ..original.clone() }) else { continue };
            let mut material = skin.material.clone();
            affix.apply(&mut material);
            if target.knows(Space::Material, &material) {
                skin.material = material;
            }
            skins.push(skin);
        }
        self.spec.skins.extend(skins);
    }

    /// Copies the instances of plugins that elements may refer to.
    fn copy_plugins(&mut self, child: &Spec, affix: &Affix<'_>) {
        for extension in &child.extensions {
            if self.spec.extensions.iter().all(|known| known.name != extension.name) {
                self.spec.extensions.push(extension.clone());
            }
        }
        for instance in &child.plugins {
            let mut copy = instance.clone();
            affix.apply(&mut copy.name);
            if self.spec.plugins.iter().all(|known| known.name != copy.name) {
                self.spec.plugins.push(copy);
            }
        }
    }

    /// Copies the objects whose references lead somewhere; `inside` are the names of the piece.
    fn copy_objects(
        &mut self,
        from: &Spec,
        affix: &Affix<'_>,
        inside: Names,
        keys: Option<&[Option<usize>]>,
    ) -> Result<(), String> {
        let mut target = Target { reader: self, affix, inside, outside: None };
        let mut flexes = target.copies(&from.flexes, Space::Flex);
        if keys.is_some() {
            // Assets of another model come under the prefix.
            flexes.iter_mut().for_each(|flex| affix.apply(&mut flex.material));
        }
        let pairs = target.copies(&from.pairs, Space::Pair);
        let excludes = target.copies(&from.excludes, Space::Exclude);
        let mut tendons = target.copies(&from.tendons, Space::Tendon);
        for tendon in &mut tendons {
            if !tendon.material.is_empty() && !target.knows(Space::Material, &tendon.material) {
                affix.apply(&mut tendon.material);
            }
        }
        let equalities = target.copies(&from.equalities, Space::Equality);
        let mut actuators = target.copies(&from.actuators, Space::Actuator);
        for actuator in &mut actuators {
            match keys {
                Some(keys) => renumber(&mut actuator.keyed, keys),
                None => actuator.keyed.clear(),
            }
        }
        let mut sensors = target.copies(&from.sensors, Space::Sensor);
        if keys.is_some() {
            let used = actuators.iter_mut().filter_map(|a| a.plugin.as_mut());
            let used = used.chain(sensors.iter_mut().filter_map(|s| s.plugin.as_mut()));
            used.for_each(|used| affix.apply(&mut used.instance));
        }
        let tuples = target.copies(&from.tuples, Space::Tuple);
        let copied = [
            flexes.iter().map(Referring::elements).sum(),
            pairs.len(),
            excludes.len(),
            tendons.len(),
            equalities.len(),
            actuators.len(),
            sensors.len(),
            tuples.len(),
        ];
        self.count(copied.iter().sum())?;
        self.spec.flexes.extend(flexes);
        self.spec.pairs.extend(pairs);
        self.spec.excludes.extend(excludes);
        self.spec.tendons.extend(tendons);
        self.spec.equalities.extend(equalities);
        self.spec.actuators.extend(actuators);
        self.spec.sensors.extend(sensors);
        self.spec.tuples.extend(tuples);
        Ok(())
    }
}

/// Numbers that a skin holds in place.
fn numbers_of_skin(skin: &Skin) -> usize {
    skin.vert.len() + skin.face.len() + skin.bones.iter().map(|bone| bone.vertid.len()).sum::<usize>()
}

/// What is attached.
enum Source {
    /// A body; its pose in frames around it is left behind.
    Body(Body),
    /// The contents of a frame, in a body that holds nothing else.
    Frame(Body, usize),
    /// All that a world holds.
    World(Body),
}

impl Source {
    /// The same with keyframes renumbered.
    fn keyed(mut self, keys: &[Option<usize>]) -> Self {
        let (Source::Body(body) | Source::Frame(body, _) | Source::World(body)) = &mut self;
        let mut pending = vec![body];
        while let Some(body) = pending.pop() {
            renumber(&mut body.keyed, keys);
            body.joints.iter_mut().for_each(|j| renumber(&mut j.keyed, keys));
            pending.extend(&mut body.bodies);
        }
        self
    }
}

fn renumber(keyed: &mut Vec<Keyed>, keys: &[Option<usize>]) {
    keyed.retain_mut(|share| match keys.get(share.key).copied().flatten() {
        Some(key) => {
            share.key = key;
            true
        }
        None => false,
    });
}

/// The model that objects are copied to.
struct Target<'r, 's, 'a> {
    reader: &'r Reader<'s>,
    affix: &'a Affix<'a>,
    inside: Names,
    outside: Option<Names>,
}

impl Target<'_, '_, '_> {
    fn knows(&mut self, space: Space, name: &str) -> bool {
        let key = (space, name.to_string());
        self.inside.contains(&key)
            || self.outside.get_or_insert_with(|| all_names(self.reader)).contains(&key)
    }

    fn copies<T: Referring>(&mut self, list: &[T], space: Space) -> Vec<T> {
        let mut copies: Vec<T> = list.iter().filter_map(|object| self.copy(object)).collect();
        self.inside.extend(copies.iter_mut().map(|object| (space, object.names().0.clone())));
        copies
    }

    /// The object with its references in the copied names where they are known; `None` when one leads nowhere
    /// or none into the piece.
    fn copy<T: Referring>(&mut self, original: &T) -> Option<T> {
        let mut object = original.clone();
        let (name, references) = object.names();
        self.affix.apply(name);
        let (total, mut found) = (references.len(), 0);
        for (space, reference) in references {
            let mut renamed = reference.clone();
            self.affix.apply(&mut renamed);
            if self.knows(space, &renamed) {
                *reference = renamed;
                found += 1;
            } else if !T::MIXED || !self.knows(space, reference) {
                return None;
            }
        }
        (total == 0 || found > 0).then_some(object)
    }
}

fn all_names(reader: &Reader<'_>) -> Names {
    let mut names = Names::from([(Space::Body, "world".to_string())]);
    for body in &reader.open {
        names.insert((Space::Body, body.name.clone()));
        collect(body, &mut names);
    }
    collect_objects(&reader.spec, &mut names);
    names
}

fn find_body<'b>(body: &'b Body, name: &str) -> Option<&'b Body> {
    if body.name == name { Some(body) } else { body.bodies.iter().find_map(|b| find_body(b, name)) }
}
