//! Default classes: a class starts as a copy of the enclosing one, and an element starts as a copy of its class, so that an
//! attribute with fewer numbers than its arity keeps the class's for the rest.

use std::collections::BTreeMap;

use super::actuator::Actuator;
use super::asset::{Material, Mesh};
use super::constraint::{Equality, Pair, Tendon};
use super::tree::{Camera, Geom, Joint, Light, Site};

/// Index of a class in [`Classes`]; the top-level class is 0.
pub(crate) type ClassId = usize;

/// The class that holds where nothing else is said.
pub const MAIN: &str = "main";

/// One element of each kind that has defaults.
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct Class {
    /// Joints.
    pub joint: Joint,
    /// Geoms.
    pub geom: Geom,
    /// Sites.
    pub site: Site,
    /// Cameras.
    pub camera: Camera,
    /// Lights.
    pub light: Light,
    /// Meshes.
    pub mesh: Mesh,
    /// Materials.
    pub material: Material,
    /// Contact pairs.
    pub pair: Pair,
    /// Equality constraints.
    pub equality: Equality,
    /// Tendons.
    pub tendon: Tendon,
    /// Actuators.
    pub actuator: Actuator,
}

/// All classes of a model. Elements took their class's values when they were read; an element that is added later takes the
/// values of the class that it names.
#[derive(Debug, Clone)]
pub struct Classes {
    pub(crate) list: Vec<Class>,
    pub(crate) names: BTreeMap<String, ClassId>,
}

impl Default for Classes {
    fn default() -> Self {
        Self { list: vec![Class::default()], names: BTreeMap::from([(MAIN.into(), 0)]) }
    }
}

impl Classes {
    /// The class called `name`.
    pub fn get(&self, name: &str) -> Option<&Class> {
        self.names.get(name).and_then(|&id| self.list.get(id))
    }

    /// The class called `name`, to change what elements added later start from.
    pub fn get_mut(&mut self, name: &str) -> Option<&mut Class> {
        self.names.get(name).and_then(|&id| self.list.get_mut(id))
    }

    /// The names of all classes, sorted.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.names.keys().map(String::as_str)
    }

    /// Adds a class that starts as a copy of `parent`; `None`, and nothing added, when there is no such parent, or one
    /// called `name` already.
    pub fn add(&mut self, name: &str, parent: &str) -> Option<&mut Class> {
        let copy = self.get(parent).filter(|_| !name.is_empty() && !self.names.contains_key(name))?.clone();
        self.list.push(copy);
        self.names.insert(name.to_owned(), self.list.len() - 1);
        self.list.last_mut()
    }

    pub(crate) fn of(&self, id: ClassId) -> &Class {
        &self.list[id]
    }
}
