//! Where elements stand in texts: a model made of several has places of its own for each.

use super::rename::each_body;
use crate::diagnostic::Loc;
use crate::spec::Spec;

impl Spec {
    /// Replaces the place of every element.
    pub(super) fn map_places(&mut self, place: &mut dyn FnMut(Loc) -> Loc) {
        each_body(&mut self.world, &mut |body| {
            body.loc = place(body.loc);
            body.plugin.iter_mut().for_each(|x| x.loc = place(x.loc));
            body.inertial.iter_mut().for_each(|x| x.loc = place(x.loc));
            body.joints.iter_mut().for_each(|x| x.loc = place(x.loc));
            body.geoms.iter_mut().for_each(|x| x.loc = place(x.loc));
            body.geoms.iter_mut().flat_map(|x| &mut x.plugin).for_each(|x| x.loc = place(x.loc));
            body.sites.iter_mut().for_each(|x| x.loc = place(x.loc));
            body.cameras.iter_mut().for_each(|x| x.loc = place(x.loc));
            body.lights.iter_mut().for_each(|x| x.loc = place(x.loc));
        });
        self.tendons.iter_mut().flat_map(|t| &mut t.path).for_each(|x| x.loc = place(x.loc));
        self.skins.iter_mut().flat_map(|s| &mut s.bones).for_each(|x| x.loc = place(x.loc));
        self.meshes.iter_mut().flat_map(|x| &mut x.plugin).for_each(|x| x.loc = place(x.loc));
        self.actuators.iter_mut().flat_map(|x| &mut x.plugin).for_each(|x| x.loc = place(x.loc));
        self.sensors.iter_mut().flat_map(|x| &mut x.plugin).for_each(|x| x.loc = place(x.loc));
        self.size.loc = place(self.size.loc);
        self.frames.iter_mut().for_each(|x| x.holder = place(x.holder));
        macro_rules! lists {
            ($($list:ident)*) => { $(self.$list.iter_mut().for_each(|x| x.loc = place(x.loc));)* };
        }
        lists!(extensions plugins frames meshes skins hfields textures materials pairs excludes flexes equalities tendons actuators sensors numerics
               texts tuples keys kept_keys);
    }
}
