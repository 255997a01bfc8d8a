//! Models attached to others, and parts taken out of them.

use std::collections::BTreeSet;

use physics::model::ObjType;

use super::find::missing;
use super::{reading, refuse};
use crate::diagnostic::{Diagnostics, Loc, Sources};
use crate::read::copy::{Names, Referring, collect};
use crate::read::{Authored, ModelFile, Place};
use crate::schema::Space;
use crate::schema::tree::Attach;
use crate::spec::{Body, Spec, asset_name};
use crate::xml::Element;

/// Texts of attached models are numbered from here, beyond the numbers of files.
const FIRST: u32 = 1 << 24;

impl Spec {
    /// Attaches to the body called `onto` the body `part` of `child`, or all that its world holds, under names with a prefix,
    /// as `<attach>` does: with it come what refers to it, assets, classes, custom data and keyframes. Elements keep the
    /// compiler settings of `child`.
    ///
    /// # Errors
    /// There is no such body in either; a name is taken; settings conflict where `compiler.conflict` makes that an error.
    pub fn attach(
        &mut self,
        onto: &str,
        child: &Spec,
        part: Option<&str>,
        prefix: &str,
    ) -> Result<(), Diagnostics> {
        // A body is lent to the reader; an index path leads back to its place.
        let Some(path) = path_to(&self.world, onto) else {
            return Err(missing(ObjType::Body, onto, self.bodies().map(|body| body.name.as_str())));
        };
        let mut parent = self.clone();
        parent.spread_keys()?;
        let mut child = child.clone();
        child.distribute_keys().map_err(|(_, message)| Diagnostics::of_error(message))?;
        let first_file = parent.renumber_places(&mut child);
        let model = ModelFile {
            name: child.modelname.clone(),
            first_file,
            spec: child,
            authored: Authored::default(),
        };
        let wanted = Attach {
            body: part.unwrap_or_default().to_owned(),
            prefix: prefix.to_owned(),
            ..Attach::default()
        };
        let world = onto == parent.world.name;
        let (result, mut spec) = reading(parent, Sources::default(), |reader| {
            let mut root = std::mem::take(&mut reader.spec.world);
            let target = (!world).then(|| std::mem::take(at(&mut root, &path)));
            reader.open = vec![root];
            reader.open.extend(target);
            let place = Place { frame: None, class: 0, body_class: 0, world };
            let result = reader.attach_model(&Element::default(), &wanted, place, &model);
            reader.spec.world = reader.open.remove(0);
            result.map(|()| reader.open.pop())
        })?;
        let target = result.map_err(Diagnostics::of_error)?;
        if let Some(target) = target {
            *at(&mut spec.world, &path) = target;
        }
        *self = spec;
        Ok(())
    }

    /// Gives the elements of `child` places in texts numbered beyond this model's; returns the first number.
    fn renumber_places(&mut self, child: &mut Spec) -> u32 {
        let mut first = FIRST;
        let mut see = |file: u32| {
            if file != u32::MAX {
                first = first.max(file.saturating_add(1));
            }
        };
        self.attached.keys().for_each(|&file| see(file));
        self.map_places(&mut |loc| {
            see(loc.file);
            loc
        });
        child.map_places(&mut |loc| match loc {
            Loc::NONE => Loc { file: first, offset: 0 },
            Loc { file, offset } => Loc { file: file.saturating_add(first), offset },
        });
        child.attached = std::mem::take(&mut child.attached)
            .into_iter()
            .map(|(file, compiler)| (file.saturating_add(first), compiler))
            .collect();
        first
    }

    /// Takes the body called `name` out of this model, with all below it, and makes a model of it: what refers to nothing
    /// else comes along, with the assets in use; what refers to both is lost. This model's settings and classes hold.
    ///
    /// # Errors
    /// There is no such body, or it is the world.
    pub fn detach(&mut self, name: &str) -> Result<Spec, Diagnostics> {
        if self.body(name).is_none() {
            return Err(missing(ObjType::Body, name, self.bodies().map(|body| body.name.as_str())));
        }
        if name == self.world.name {
            return refuse("the world cannot be detached");
        }
        self.spread_keys()?;
        let mut part = self.clone();
        let Some(body) = part.take_body(name) else { return refuse(format!("there is no body '{name}'")) };
        let mut outside = Names::new();
        collect(&part.world, &mut outside);
        part.world = Body { name: part.world.name.clone(), bodies: vec![body], ..Body::default() };
        part.drop_references(outside);
        part.sensors.retain_mut(|sensor| !sensor.names().1.is_empty());
        part.tuples.retain(|tuple| !tuple.entries.is_empty());
        part.numerics.clear();
        part.texts.clear();
        part.drop_unused_assets();
        part.drop_unused_plugins();
        name.clone_into(&mut part.modelname);
        self.remove(ObjType::Body, name)?;
        Ok(part)
    }

    /// Keeps the assets that an element refers to.
    fn drop_unused_assets(&mut self) {
        let mut shapes = BTreeSet::new();
        self.each_reference(&mut |space, name| {
            if matches!(space, Space::Mesh | Space::Hfield) {
                shapes.insert((space, name.clone()));
            }
        });
        self.meshes.retain(|x| shapes.contains(&(Space::Mesh, asset_name(&x.name, &x.path))));
        self.hfields.retain(|x| shapes.contains(&(Space::Hfield, asset_name(&x.name, &x.path))));
        let used = |spec: &mut Spec, of: Space| {
            let mut names = BTreeSet::new();
            spec.each_reference(&mut |space, name| {
                if space == of {
                    names.insert(name.clone());
                }
            });
            names
        };
        let materials = used(self, Space::Material);
        self.materials.retain(|x| materials.contains(&x.name));
        let textures = used(self, Space::Texture);
        self.textures.retain(|x| textures.contains(&asset_name(&x.name, &x.path)));
    }
}

/// Which child leads to the body called `name`, level by level.
pub(super) fn path_to(body: &Body, name: &str) -> Option<Vec<usize>> {
    if body.name == name {
        return Some(Vec::new());
    }
    body.bodies.iter().enumerate().find_map(|(index, child)| {
        let mut path = path_to(child, name)?;
        path.insert(0, index);
        Some(path)
    })
}

/// The body at the end of a path.
pub(super) fn at<'b>(body: &'b mut Body, path: &[usize]) -> &'b mut Body {
    path.iter().fold(body, |body, &index| &mut body.bodies[index])
}
