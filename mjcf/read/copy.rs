//! Copies of a piece of the tree under other names, and of the objects outside the tree that refer into it.

use std::collections::BTreeSet;

use physics::model::{ObjType, TrnType};

use crate::schema::Space;
use crate::spec::{
    Actuator, Body, Equality, Exclude, Flex, Pair, PluginUse, Sensor, Skin, Spec, Tendon, Tuple, Wrap,
    WrapKind,
};

/// Names with their spaces.
pub(crate) type Names = BTreeSet<(Space, String)>;

/// What is put around the names of a copy.
pub(super) struct Affix<'a> {
    pub prefix: &'a str,
    pub suffix: &'a str,
}

impl Affix<'_> {
    /// The name of the copy; what has no name stays without.
    pub fn apply(&self, name: &mut String) {
        if !name.is_empty() {
            *name = format!("{}{name}{}", self.prefix, self.suffix);
        }
    }
}

/// The number of elements in `body`, itself included.
pub(crate) fn elements(body: &Body) -> usize {
    let fixed =
        body.joints.len() + body.geoms.len() + body.sites.len() + body.cameras.len() + body.lights.len();
    1 + fixed + body.bodies.iter().map(elements).sum::<usize>()
}

/// Takes the keyframes of attached models from all that `body` holds.
pub(super) fn forget_keys(body: &mut Body) {
    body.keyed.clear();
    body.joints.iter_mut().for_each(|j| j.keyed.clear());
    body.bodies.iter_mut().for_each(forget_keys);
}

/// Adds the names of all that `body` holds.
pub(crate) fn collect(body: &Body, names: &mut Names) {
    let mut add = |space, name: &String| {
        if !name.is_empty() {
            names.insert((space, name.clone()));
        }
    };
    body.joints.iter().for_each(|j| add(Space::Joint, &j.name));
    body.geoms.iter().for_each(|g| add(Space::Geom, &g.name));
    body.sites.iter().for_each(|s| add(Space::Site, &s.name));
    body.cameras.iter().for_each(|c| add(Space::Camera, &c.name));
    body.lights.iter().for_each(|l| add(Space::Light, &l.name));
    body.bodies.iter().for_each(|b| add(Space::Body, &b.name));
    body.bodies.iter().for_each(|b| collect(b, names));
}

/// Adds the names of all objects outside the tree.
pub(crate) fn collect_objects(spec: &Spec, names: &mut Names) {
    macro_rules! lists {
        ($($space:ident $field:ident)*) => {
            $(for object in spec.$field.iter().filter(|o| !o.name.is_empty()) {
                names.insert((Space::$space, object.name.clone()));
            })*
        };
    }
    lists!(Mesh meshes Skin skins Hfield hfields Texture textures Material materials Pair pairs Exclude excludes Flex flexes
           Equality equalities Tendon tendons Actuator actuators Sensor sensors Numeric numerics Text texts
           Tuple tuples Key keys Plugin plugins);
}

/// How what a body holds is renamed.
pub(super) struct Renaming<'a> {
    pub affix: &'a Affix<'a>,
    /// Bodies that targets are renamed to; all when `None`.
    pub targets: Option<&'a Names>,
    /// Assets are copied too, so that references to them are renamed.
    pub assets: bool,
}

impl Renaming<'_> {
    /// Renames all that `body` holds; `frame` gives the new frame of an old one, which is at the top when the
    /// flag says so.
    pub fn contents(
        &self,
        body: &mut Body,
        top: bool,
        frame: &mut dyn FnMut(Option<usize>, bool) -> Option<usize>,
    ) {
        for joint in &mut body.joints {
            self.affix.apply(&mut joint.name);
            joint.frame = frame(joint.frame, top);
        }
        for geom in &mut body.geoms {
            self.affix.apply(&mut geom.name);
            geom.frame = frame(geom.frame, top);
            self.asset([&mut geom.material, &mut geom.hfieldname, &mut geom.meshname]);
            self.plugin(&mut geom.plugin);
        }
        for site in &mut body.sites {
            self.affix.apply(&mut site.name);
            site.frame = frame(site.frame, top);
            self.asset([&mut site.material]);
        }
        for camera in &mut body.cameras {
            self.affix.apply(&mut camera.name);
            camera.frame = frame(camera.frame, top);
            self.target(&mut camera.targetbody);
        }
        for light in &mut body.lights {
            self.affix.apply(&mut light.name);
            light.frame = frame(light.frame, top);
            self.target(&mut light.targetbody);
            self.asset([&mut light.texture]);
        }
        for child in &mut body.bodies {
            self.affix.apply(&mut child.name);
            self.plugin(&mut child.plugin);
            child.frame = frame(child.frame, top);
            self.contents(child, false, frame);
        }
    }

    fn target(&self, name: &mut String) {
        if self.targets.is_none_or(|names| names.contains(&(Space::Body, name.clone()))) {
            self.affix.apply(name);
        }
    }

    /// Instances of plugins go along with assets.
    fn plugin(&self, used: &mut Option<PluginUse>) {
        if let Some(used) = used {
            self.asset([&mut used.instance]);
        }
    }

    fn asset<const N: usize>(&self, names: [&mut String; N]) {
        if self.assets {
            names.into_iter().for_each(|name| self.affix.apply(name));
        }
    }
}

/// Appends all that `piece` holds to `body`.
pub(crate) fn append(body: &mut Body, mut piece: Body) {
    body.joints.append(&mut piece.joints);
    body.geoms.append(&mut piece.geoms);
    body.sites.append(&mut piece.sites);
    body.cameras.append(&mut piece.cameras);
    body.lights.append(&mut piece.lights);
    body.bodies.append(&mut piece.bodies);
}

/// An object outside the tree that may refer into it.
pub(crate) trait Referring: Clone {
    /// One reference into the piece is enough; the others may lead elsewhere.
    const MIXED: bool = false;

    /// How many elements the object counts as.
    fn elements(&self) -> usize {
        1
    }

    /// The object's own name and all its references.
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>);
}

/// The space of what a reference of this kind names.
fn space(kind: ObjType) -> Space {
    // Nothing else has a name.
    Space::of(kind).unwrap_or(Space::Class)
}

fn given(list: Vec<(Space, &mut String)>) -> Vec<(Space, &mut String)> {
    list.into_iter().filter(|(_, name)| !name.is_empty()).collect()
}

impl Referring for Pair {
    const MIXED: bool = true;

    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        (&mut self.name, vec![(Space::Geom, &mut self.geomname1), (Space::Geom, &mut self.geomname2)])
    }
}

impl Referring for Exclude {
    const MIXED: bool = true;

    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        (&mut self.name, vec![(Space::Body, &mut self.bodyname1), (Space::Body, &mut self.bodyname2)])
    }
}

impl Referring for Skin {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        (&mut self.name, self.bones.iter_mut().map(|bone| (Space::Body, &mut bone.body)).collect())
    }
}

impl Referring for Flex {
    fn elements(&self) -> usize {
        1 + (self.vert.len() + self.elem.len() + self.texcoord.len()) / 16
            + self.vertbody.len()
            + self.nodebody.len()
    }

    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        let bodies = self.vertbody.iter_mut().chain(&mut self.nodebody);
        (&mut self.name, bodies.map(|name| (Space::Body, name)).collect())
    }
}

impl Referring for Equality {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        let kind = space(self.objtype);
        (&mut self.name, given(vec![(kind, &mut self.name1), (kind, &mut self.name2)]))
    }
}

impl Referring for Tendon {
    const MIXED: bool = true;

    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        (&mut self.name, given(self.path.iter_mut().flat_map(wrap_names).collect()))
    }
}

fn wrap_names(wrap: &mut Wrap) -> Vec<(Space, &mut String)> {
    match &mut wrap.kind {
        WrapKind::Site { site } => vec![(Space::Site, site)],
        WrapKind::Geom { geom, sidesite } => vec![(Space::Geom, geom), (Space::Site, sidesite)],
        WrapKind::Joint { joint, .. } => vec![(Space::Joint, joint)],
        WrapKind::Pulley { .. } => vec![],
    }
}

impl Referring for Actuator {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        let target = match self.trntype {
            TrnType::Joint | TrnType::Jointinparent => Space::Joint,
            TrnType::Tendon => Space::Tendon,
            TrnType::Body => Space::Body,
            // A slider-crank names its crank's site.
            _ => Space::Site,
        };
        let sites = [(Space::Site, &mut self.refsite), (Space::Site, &mut self.slidersite)];
        (&mut self.name, given([(target, &mut self.target)].into_iter().chain(sites).collect()))
    }
}

impl Referring for Sensor {
    const MIXED: bool = true;

    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        let (object, reference) = (space(self.objtype), space(self.reftype));
        (&mut self.name, given(vec![(object, &mut self.objname), (reference, &mut self.refname)]))
    }
}

impl Referring for Tuple {
    fn names(&mut self) -> (&mut String, Vec<(Space, &mut String)>) {
        (&mut self.name, self.entries.iter_mut().map(|e| (space(e.objtype), &mut e.objname)).collect())
    }
}
