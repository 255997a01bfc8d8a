//! Elements taken out, with what refers to them.

use std::collections::BTreeSet;

use physics::model::{ObjType, TrackMode};

use super::find::{missing, word};
use super::refuse;
use super::rename::each_body;
use super::spaces::by_space;
use crate::diagnostic::Diagnostics;
use crate::read::copy::{Names, Referring, collect};
use crate::schema::Space;
use crate::spec::{Body, Spec, asset_name};

impl Spec {
    /// Removes the element called `name`; a body goes with all below it. What refers to a removed element goes too: pairs,
    /// skins, flexes, constraints, tendons, actuators, sensors, entries of tuples. Cameras and lights that follow a removed body stay where
    /// they are; a removed material or texture leaves what it covered without one. Keyframes keep the numbers of what remains.
    ///
    /// # Errors
    /// There is no such element; it is the world, a frame, or a mesh or height field that a geom shows.
    pub fn remove(&mut self, kind: ObjType, name: &str) -> Result<(), Diagnostics> {
        let Some(space) = Space::of(kind) else {
            return refuse(format!("elements of kind {kind:?} have no names"));
        };
        let names = self.all_names();
        if !names.contains(&(space, name.to_owned())) {
            let known = names.iter().filter(|(s, _)| *s == space).map(|(_, name)| name.as_str());
            return Err(missing(kind, name, known));
        }
        if space == Space::Body && name == self.world.name {
            return refuse("the world cannot be removed");
        }
        if space == Space::Frame {
            return refuse(format!(
                "frame '{name}' places its elements: remove these, and nothing is left of it"
            ));
        }
        if let Some(user) = self.geoms().find(|g| match space {
            Space::Mesh => g.meshname == name,
            Space::Hfield => g.hfieldname == name,
            _ => false,
        }) {
            let geom = &user.name;
            return refuse(format!(
                "the {} '{name}' is shown by the geom '{geom}': remove that first",
                word(kind)
            ));
        }
        if space == Space::Plugin {
            let mut uses = false;
            self.each_reference(&mut |of, used| uses |= of == Space::Plugin && used == name);
            if uses {
                return refuse(format!("the plugin instance '{name}' is in use: remove what uses it first"));
            }
        }
        if matches!(space, Space::Body | Space::Joint | Space::Actuator) {
            self.spread_keys()?;
        }
        let gone = self.take_out(space, name);
        self.drop_references(gone);
        self.drop_unused_plugins();
        Ok(())
    }

    /// Moves the numbers of keyframes to the elements they belong to.
    pub(super) fn spread_keys(&mut self) -> Result<(), Diagnostics> {
        let empty = (self.size.nkey.max(0) as usize).saturating_sub(self.keys.len());
        self.keys.extend(std::iter::repeat_n(Default::default(), empty));
        self.size.nkey = 0;
        self.distribute_keys().map_err(|(_, message)| Diagnostics::of_error(message))
    }

    /// Takes the element out of where it stands; returns the names that are gone.
    fn take_out(&mut self, space: Space, name: &str) -> Names {
        let mut gone = Names::from([(space, name.to_owned())]);
        macro_rules! list {
            ($list:ident) => {
                self.$list.retain(|x| x.name != name)
            };
        }
        macro_rules! asset {
            ($list:ident) => {
                self.$list.retain(|x| asset_name(&x.name, &x.path) != name)
            };
        }
        macro_rules! held {
            ($list:ident) => {
                each_body(&mut self.world, &mut |b| b.$list.retain(|x| x.name != name))
            };
        }
        by_space!(space, bodies held, assets asset, lists list, {
            Space::Body => {
                if let Some(body) = self.take_body(name) {
                    collect(&body, &mut gone);
                }
            }
            Space::Key => self.take_key(name),
            Space::Frame | Space::Class => unreachable!("neither is removed by name"),
        });
        gone
    }

    /// Takes the body called `name` out of the tree.
    pub(super) fn take_body(&mut self, name: &str) -> Option<Body> {
        fn below(body: &mut Body, name: &str) -> Option<Body> {
            if let Some(index) = body.bodies.iter().position(|child| child.name == name) {
                return Some(body.bodies.remove(index));
            }
            body.bodies.iter_mut().find_map(|child| below(child, name))
        }
        below(&mut self.world, name)
    }

    fn take_key(&mut self, name: &str) {
        self.keys.retain(|key| key.name != name);
        let Some(index) = self.kept_keys.iter().position(|key| key.name == name) else { return };
        self.kept_keys.remove(index);
        let renumber = |keyed: &mut Vec<crate::spec::Keyed>| {
            keyed.retain(|share| share.key != index);
            keyed.iter_mut().filter(|share| share.key > index).for_each(|share| share.key -= 1);
        };
        each_body(&mut self.world, &mut |body| {
            renumber(&mut body.keyed);
            body.joints.iter_mut().for_each(|joint| renumber(&mut joint.keyed));
        });
        self.actuators.iter_mut().for_each(|actuator| renumber(&mut actuator.keyed));
    }

    /// Removes instances of plugins that no element uses any more: most plugins refuse to be there for nothing.
    pub(super) fn drop_unused_plugins(&mut self) {
        let mut used = BTreeSet::new();
        self.each_reference(&mut |space, name| {
            if space == Space::Plugin {
                used.insert(name.clone());
            }
        });
        self.plugins.retain(|instance| used.contains(&instance.name));
    }

    /// Removes what refers to `gone`, and what refers to that.
    pub(super) fn drop_references(&mut self, mut gone: Names) {
        for tuple in &mut self.tuples {
            let mut probe = tuple.clone();
            let mut keep =
                probe.names().1.into_iter().map(|(space, name)| !gone.contains(&(space, name.clone())));
            tuple.entries.retain(|_| keep.next().unwrap_or(true));
        }
        drop_from(&mut self.skins, &mut gone, Space::Skin);
        drop_from(&mut self.flexes, &mut gone, Space::Flex);
        drop_from(&mut self.pairs, &mut gone, Space::Pair);
        drop_from(&mut self.excludes, &mut gone, Space::Exclude);
        drop_from(&mut self.tendons, &mut gone, Space::Tendon);
        drop_from(&mut self.equalities, &mut gone, Space::Equality);
        drop_from(&mut self.actuators, &mut gone, Space::Actuator);
        drop_from(&mut self.sensors, &mut gone, Space::Sensor);
        each_body(&mut self.world, &mut |body| {
            let lost = |target: &String| !target.is_empty() && gone.contains(&(Space::Body, target.clone()));
            for camera in body.cameras.iter_mut().filter(|camera| lost(&camera.targetbody)) {
                (camera.mode, camera.targetbody) = (TrackMode::Fixed, String::new());
            }
            for light in body.lights.iter_mut().filter(|light| lost(&light.targetbody)) {
                (light.mode, light.targetbody) = (TrackMode::Fixed, String::new());
            }
        });
        // What is left of references are looks: materials and textures.
        self.each_reference(&mut |space, name| {
            if matches!(space, Space::Material | Space::Texture) && gone.contains(&(space, name.clone())) {
                name.clear();
            }
        });
    }
}

fn drop_from<T: Referring>(list: &mut Vec<T>, gone: &mut Names, space: Space) {
    let mut lost = Vec::new();
    list.retain_mut(|object| {
        let (name, references) = object.names();
        let refers = references.iter().any(|(space, name)| gone.contains(&(*space, (*name).clone())));
        if refers && !name.is_empty() {
            lost.push((space, name.clone()));
        }
        !refers
    });
    gone.extend(lost);
}
