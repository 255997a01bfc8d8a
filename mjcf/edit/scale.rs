//! Bodies made larger or smaller.

use std::collections::{BTreeMap, BTreeSet};

use physics::model::{JointType, ObjType};

use super::attach::{at, path_to};
use super::find::missing;
use super::refuse;
use super::rename::each_body;
use crate::diagnostic::Diagnostics;
use crate::schema::Space;
use crate::spec::{Body, Skin, Spec, asset_name};

impl Spec {
    /// Scales the body called `name`, and all below it, about its origin: lengths by `factor`, given masses by its cube and
    /// given inertias by its fifth power; densities stay. Meshes and height fields that others show too are copied. Skins given in
    /// place are scaled when all their bones are. What
    /// acts on the body (stiffness, gains, forces, tendons, keyframes) stays as it is.
    ///
    /// # Errors
    /// There is no such body; the factor is not positive and finite.
    pub fn scale(&mut self, name: &str, factor: f64) -> Result<(), Diagnostics> {
        if !(factor.is_finite() && factor > 0.0) {
            return refuse(format!("a body is scaled by a positive number, not by {factor}"));
        }
        let Some(path) = path_to(&self.world, name) else {
            return Err(missing(ObjType::Body, name, self.bodies().map(|body| body.name.as_str())));
        };
        let mut scaled = std::mem::take(at(&mut self.world, &path));
        let renamed = self.scale_assets(&scaled, factor);
        self.scale_frames(&scaled, factor);
        scale_body(&mut scaled, factor, &renamed);
        for child in &mut scaled.bodies {
            each_body(child, &mut |body| {
                body.pos = body.pos.map(|x| x * factor);
                scale_body(body, factor, &renamed);
            });
        }
        *at(&mut self.world, &path) = scaled;
        self.scale_skins(&path, factor);
        Ok(())
    }

    /// Scales the skins that only the body at `path` and those below it move.
    fn scale_skins(&mut self, path: &[usize], factor: f64) {
        let mut moved = BTreeSet::new();
        each_body(at(&mut self.world, path), &mut |body| {
            moved.insert(body.name.clone());
        });
        let by = |x: &mut f32| *x = (f64::from(*x) * factor) as f32;
        let inside = |skin: &&mut Skin| {
            !skin.bones.is_empty() && skin.bones.iter().all(|bone| moved.contains(&bone.body))
        };
        for skin in self.skins.iter_mut().filter(inside) {
            skin.vert.iter_mut().for_each(by);
            skin.bones.iter_mut().flat_map(|bone| &mut bone.bindpos).for_each(by);
            by(&mut skin.inflate);
        }
    }

    /// Scales meshes and height fields that `body` shows, or copies that it is to show where the rest of the model does too.
    fn scale_assets(&mut self, body: &Body, factor: f64) -> BTreeMap<(Space, String), String> {
        let (inside, outside) = (shown(body), shown(&self.world));
        let mut renamed = BTreeMap::new();
        macro_rules! scale {
            ($space:ident $list:ident |$asset:ident| $scale:expr) => {
                let taken: BTreeSet<String> =
                    self.$list.iter().map(|x| asset_name(&x.name, &x.path)).collect();
                for index in 0..self.$list.len() {
                    let name = asset_name(&self.$list[index].name, &self.$list[index].path);
                    let key = (Space::$space, name.clone());
                    if !inside.contains(&key) {
                        continue;
                    }
                    if !outside.contains(&key) {
                        let $asset = &mut self.$list[index];
                        $scale;
                        continue;
                    }
                    let mut fresh = format!("{name} x{factor}");
                    while taken.contains(&fresh) {
                        fresh.push('\'');
                    }
                    let mut copy = self.$list[index].clone();
                    copy.name.clone_from(&fresh);
                    let $asset = &mut copy;
                    $scale;
                    self.$list.push(copy);
                    renamed.insert(key, fresh);
                }
            };
        }
        scale!(Mesh meshes |mesh| mesh.scale = mesh.scale.map(|x| x * factor));
        scale!(Hfield hfields |hfield| hfield.size = hfield.size.map(|x| x * factor));
        renamed
    }

    /// Scales the frames that elements of `body` and of those below it stand in.
    fn scale_frames(&mut self, body: &Body, factor: f64) {
        let mut inside = BTreeSet::new();
        let mut pending = vec![body];
        while let Some(body) = pending.pop() {
            inside.extend(body.joints.iter().filter_map(|x| x.frame));
            inside.extend(body.geoms.iter().filter_map(|x| x.frame));
            inside.extend(body.sites.iter().filter_map(|x| x.frame));
            inside.extend(body.cameras.iter().filter_map(|x| x.frame));
            inside.extend(body.lights.iter().filter_map(|x| x.frame));
            inside.extend(body.bodies.iter().filter_map(|x| x.frame));
            pending.extend(&body.bodies);
        }
        let mut next: Vec<usize> = inside.iter().copied().collect();
        while let Some(parent) = next.pop().and_then(|f| self.frames.get(f)).and_then(|f| f.parent) {
            if inside.insert(parent) {
                next.push(parent);
            }
        }
        for frame in inside {
            if let Some(frame) = self.frames.get_mut(frame) {
                frame.pos = frame.pos.map(|x| x * factor);
            }
        }
    }
}

/// Meshes and height fields in `body` and below.
fn shown(body: &Body) -> BTreeSet<(Space, String)> {
    let mut names = BTreeSet::new();
    let mut pending = vec![body];
    while let Some(body) = pending.pop() {
        for geom in &body.geoms {
            names.insert((Space::Mesh, geom.meshname.clone()));
            names.insert((Space::Hfield, geom.hfieldname.clone()));
        }
        pending.extend(&body.bodies);
    }
    names
}

/// Scales what stands in `body` itself.
fn scale_body(body: &mut Body, factor: f64, renamed: &BTreeMap<(Space, String), String>) {
    let by = |x: f64| x * factor;
    if let Some(inertial) = &mut body.inertial {
        inertial.pos = inertial.pos.map(by);
        inertial.mass *= factor.powi(3);
        inertial.inertia = inertial.inertia.map(|x| x * factor.powi(5));
        inertial.fullinertia = inertial.fullinertia.map(|full| full.map(|x| x * factor.powi(5)));
    }
    for joint in &mut body.joints {
        joint.pos = joint.pos.map(by);
        if joint.kind == JointType::Slide {
            joint.range = joint.range.map(by);
            (joint.ref_, joint.springref, joint.margin) =
                (by(joint.ref_), by(joint.springref), by(joint.margin));
        }
    }
    for geom in &mut body.geoms {
        geom.pos = geom.pos.map(by);
        geom.size = geom.size.map(by);
        geom.fromto = geom.fromto.map(|ends| ends.map(by));
        (geom.margin, geom.gap) = (by(geom.margin), by(geom.gap));
        geom.mass = geom.mass.map(|mass| mass * factor.powi(3));
        for (space, name) in [(Space::Mesh, &mut geom.meshname), (Space::Hfield, &mut geom.hfieldname)] {
            if let Some(copy) = renamed.get(&(space, name.clone())) {
                name.clone_from(copy);
            }
        }
    }
    for site in &mut body.sites {
        site.pos = site.pos.map(by);
        site.size = site.size.map(by);
        site.fromto = site.fromto.map(|ends| ends.map(by));
    }
    body.cameras.iter_mut().for_each(|camera| camera.pos = camera.pos.map(by));
    body.lights.iter_mut().for_each(|light| light.pos = light.pos.map(by));
}
