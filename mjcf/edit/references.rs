//! Names of elements, and everything that refers to them.

use crate::read::copy::{Names, Referring, collect, collect_objects};
use crate::schema::Space;
use crate::spec::{Body, Spec, asset_name};

impl Spec {
    /// All names, with their spaces.
    pub(super) fn all_names(&self) -> Names {
        let mut names = Names::from([(Space::Body, self.world.name.clone())]);
        collect(&self.world, &mut names);
        collect_objects(self, &mut names);
        let mut called = |space, name: &str, path: &str| {
            names.insert((space, asset_name(name, path)));
        };
        self.meshes.iter().for_each(|x| called(Space::Mesh, &x.name, &x.path));
        self.skins.iter().for_each(|x| called(Space::Skin, &x.name, &x.path));
        self.hfields.iter().for_each(|x| called(Space::Hfield, &x.name, &x.path));
        self.textures.iter().for_each(|x| called(Space::Texture, &x.name, &x.path));
        names.extend(self.kept_keys.iter().map(|x| (Space::Key, x.name.clone())));
        names.extend(self.frames.iter().map(|x| (Space::Frame, x.name.clone())));
        names.retain(|(_, name)| !name.is_empty());
        names
    }

    /// Calls `visit` for every reference by name.
    pub(super) fn each_reference(&mut self, visit: &mut dyn FnMut(Space, &mut String)) {
        in_body(&mut self.world, visit);
        self.meshes.iter_mut().for_each(|x| visit(Space::Material, &mut x.material));
        self.skins.iter_mut().for_each(|x| visit(Space::Material, &mut x.material));
        let used = self.meshes.iter_mut().filter_map(|x| x.plugin.as_mut());
        let used = used.chain(self.actuators.iter_mut().filter_map(|x| x.plugin.as_mut()));
        let used = used.chain(self.sensors.iter_mut().filter_map(|x| x.plugin.as_mut()));
        used.for_each(|used| visit(Space::Plugin, &mut used.instance));
        for material in &mut self.materials {
            material.textures.iter_mut().for_each(|name| visit(Space::Texture, name));
        }
        self.tendons.iter_mut().for_each(|x| visit(Space::Material, &mut x.material));
        self.flexes.iter_mut().for_each(|x| visit(Space::Material, &mut x.material));
        macro_rules! lists {
            ($($list:ident)*) => {
                $(for object in &mut self.$list {
                    for (space, name) in object.names().1 {
                        visit(space, name);
                    }
                })*
            };
        }
        lists!(skins flexes pairs excludes tendons equalities actuators sensors tuples);
    }
}

fn in_body(body: &mut Body, visit: &mut dyn FnMut(Space, &mut String)) {
    let used = body.plugin.iter_mut().chain(body.geoms.iter_mut().filter_map(|x| x.plugin.as_mut()));
    used.for_each(|used| visit(Space::Plugin, &mut used.instance));
    for geom in &mut body.geoms {
        visit(Space::Material, &mut geom.material);
        visit(Space::Hfield, &mut geom.hfieldname);
        visit(Space::Mesh, &mut geom.meshname);
    }
    body.sites.iter_mut().for_each(|x| visit(Space::Material, &mut x.material));
    body.cameras.iter_mut().for_each(|x| visit(Space::Body, &mut x.targetbody));
    for light in &mut body.lights {
        visit(Space::Body, &mut light.targetbody);
        visit(Space::Texture, &mut light.texture);
    }
    body.bodies.iter_mut().for_each(|child| in_body(child, visit));
}
