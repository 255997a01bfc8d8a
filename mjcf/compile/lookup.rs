//! Names to ids, one map a kind of element.

use super::assets::Assets;
use super::log::{Log, title};
use super::nodes::Tree;
use crate::diagnostic::Loc;
use crate::schema::Space;
use crate::spec::Spec;
use physics::model::ObjType;
use std::collections::BTreeMap;

/// All names of the model.
pub(super) struct Lookup {
    /// `discardvisual` dropped the materials: references to them are empty.
    discard_materials: bool,
    maps: BTreeMap<ObjType, BTreeMap<String, usize>>,
}

impl Lookup {
    /// Collects the names; a repeated one is an error.
    pub(super) fn new(spec: &Spec, tree: &Tree, assets: &Assets, log: &mut Log) -> Self {
        let discard_materials = spec.compiler.discardvisual;
        let mut lookup = Lookup { maps: BTreeMap::new(), discard_materials };
        let bodies = &tree.bodies;
        lookup.add(ObjType::Body, bodies.iter().map(|b| (b.name(), b.spec.loc)), log);
        lookup.add(ObjType::Joint, tree.joints().map(|j| (&*j.spec.name, j.spec.loc)), log);
        lookup.add(ObjType::Geom, tree.geoms().map(|g| (&*g.spec.name, g.spec.loc)), log);
        lookup.add(ObjType::Site, tree.sites().map(|s| (&*s.spec.name, s.spec.loc)), log);
        lookup.add(ObjType::Camera, tree.cameras().map(|c| (&*c.spec.name, c.spec.loc)), log);
        lookup.add(ObjType::Light, tree.lights().map(|l| (&*l.spec.name, l.spec.loc)), log);
        lookup.add(ObjType::Mesh, assets.meshes.iter().map(|a| (&*a.name, a.loc)), log);
        lookup.add(ObjType::Skin, assets.skins.iter().map(|a| (&*a.name, a.loc)), log);
        lookup.add(ObjType::Hfield, assets.hfields.iter().map(|a| (&*a.name, a.loc)), log);
        lookup.add(ObjType::Texture, assets.textures.iter().map(|a| (&*a.name, a.loc)), log);
        lookup.add(ObjType::Material, assets.materials.iter().map(|a| (&*a.name, a.loc)), log);
        macro_rules! list {
            ($($kind:ident $field:ident)*) => {
                $(lookup.add(ObjType::$kind, spec.$field.iter().map(|e| (&*e.name, e.loc)), log);)*
            };
        }
        list!(Flex flexes Pair pairs Exclude excludes Equality equalities Tendon tendons Actuator actuators Sensor sensors
              Numeric numerics Text texts Tuple tuples Frame frames);
        lookup.add(ObjType::Key, super::keyframe::names(spec), log);
        lookup
    }

    fn add<'a>(&mut self, kind: ObjType, names: impl Iterator<Item = (&'a str, Loc)>, log: &mut Log) {
        let map = self.maps.entry(kind).or_default();
        for (id, (name, loc)) in names.enumerate() {
            if !name.is_empty() && map.insert(name.to_owned(), id).is_some() {
                log.error(loc, format!("repeated name: {}", title(label(kind), name)));
            }
        }
    }

    /// Id of the element called `name`.
    pub(super) fn find(&self, kind: ObjType, name: &str) -> Option<usize> {
        let kind = if kind == ObjType::Xbody { ObjType::Body } else { kind };
        self.maps.get(&kind)?.get(name).copied()
    }

    /// As `find`; a missing one is an error of the element `what` at `loc`.
    pub(super) fn require(
        &self,
        kind: ObjType,
        name: &str,
        loc: Loc,
        what: &str,
        log: &mut Log,
    ) -> Option<usize> {
        let found = self.find(kind, name);
        if found.is_none() {
            let own = if kind == ObjType::Xbody { ObjType::Body } else { kind };
            let names = self.maps.get(&own).into_iter().flat_map(|m| m.keys().map(String::as_str));
            let advice = log.diagnostics.nearest(name, names).map(|near| format!("did you mean '{near}'?"));
            log.error_with(loc, format!("{what}: there is no {} '{name}'", label(kind)), advice);
        }
        found
    }

    /// Id as arrays store it: -1 for an empty name or, with an error, for a missing one.
    pub(super) fn reference(&self, kind: ObjType, name: &str, loc: Loc, what: &str, log: &mut Log) -> i32 {
        if name.is_empty() || (kind == ObjType::Material && self.discard_materials) {
            return -1;
        }
        self.require(kind, name, loc, what, log).map_or(-1, |id| id as i32)
    }
}

/// What messages call a kind of element.
pub(super) fn label(kind: ObjType) -> &'static str {
    match kind {
        ObjType::Pair => "contact pair",
        ObjType::Equality => "equality constraint",
        ObjType::Key => "keyframe",
        _ => Space::of(kind).map_or("element", Space::word),
    }
}
