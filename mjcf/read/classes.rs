//! Default classes: a class starts as a copy of the enclosing one, and an element starts as a copy of its
//! class, so that an attribute with fewer numbers than its arity keeps the class's for the rest.

use std::collections::BTreeMap;

use crate::spec::{Actuator, Camera, Equality, Geom, Joint, Light, Material, Mesh, Pair, Site, Tendon};

/// Index of a class in [`Classes`]; the top-level class is 0.
pub(super) type ClassId = usize;

/// One element of each kind that has defaults.
#[derive(Debug, Clone, Default)]
pub(super) struct Class {
    pub joint: Joint,
    pub geom: Geom,
    pub site: Site,
    pub camera: Camera,
    pub light: Light,
    pub mesh: Mesh,
    pub material: Material,
    pub pair: Pair,
    pub equality: Equality,
    pub tendon: Tendon,
    pub actuator: Actuator,
}

/// All classes of a model.
#[derive(Debug)]
pub(super) struct Classes {
    pub list: Vec<Class>,
    pub names: BTreeMap<String, ClassId>,
}

impl Default for Classes {
    fn default() -> Self {
        Self { list: vec![Class::default()], names: BTreeMap::from([("main".into(), 0)]) }
    }
}

impl Classes {
    pub fn get(&self, id: ClassId) -> &Class {
        &self.list[id]
    }
}
