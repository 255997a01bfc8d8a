//! Bodies and what is fixed to them. Elements of one kind keep their order; a frame is opened where the next element stands
//! in it, and once more, without its name, where elements outside it come between.

use std::collections::BTreeSet;

use physics::model::JointType;

use super::plugin;
use super::rows::{put_rows, put_some};
use super::text::element;
use crate::schema::tree::{
    BODY_POSE, BODY_ROWS, CAMERA_ROWS, FRAME_ROWS, FREEJOINT_ROWS, GEOM_ROWS, INERTIAL_ROWS, JOINT_ROWS,
    LIGHT_ROWS, SITE_ROWS,
};
use crate::spec::{Body, Camera, Frame, Geom, Inertial, Joint, Light, Site};
use crate::xml::Element;

/// The world with everything in it.
pub(super) fn world(world: &Body, frames: &[Frame]) -> Element {
    let mut out = element("worldbody");
    Tree { frames, named: BTreeSet::new() }.contents(world, &mut out);
    out
}

/// Writes bodies, and remembers which frames have given their names.
struct Tree<'a> {
    frames: &'a [Frame],
    named: BTreeSet<usize>,
}

/// One element of a body.
#[derive(Clone, Copy)]
enum Item<'a> {
    Joint(&'a Joint),
    Geom(&'a Geom),
    Site(&'a Site),
    Camera(&'a Camera),
    Light(&'a Light),
    Body(&'a Body),
}

impl Item<'_> {
    fn frame(self) -> Option<usize> {
        match self {
            Item::Joint(x) => x.frame,
            Item::Geom(x) => x.frame,
            Item::Site(x) => x.frame,
            Item::Camera(x) => x.frame,
            Item::Light(x) => x.frame,
            Item::Body(x) => x.frame,
        }
    }
}

/// What is still to be written of a body, by kind, last element first.
type Pending<'a> = [Vec<Item<'a>>; 6];

fn pending(body: &Body) -> Pending<'_> {
    [
        body.joints.iter().rev().map(Item::Joint).collect(),
        body.geoms.iter().rev().map(Item::Geom).collect(),
        body.sites.iter().rev().map(Item::Site).collect(),
        body.cameras.iter().rev().map(Item::Camera).collect(),
        body.lights.iter().rev().map(Item::Light).collect(),
        body.bodies.iter().rev().map(Item::Body).collect(),
    ]
}

impl Tree<'_> {
    fn contents(&mut self, body: &Body, out: &mut Element) {
        out.children.extend(plugin::child(body.plugin.as_ref()));
        self.scope(&mut pending(body), None, out);
    }

    /// Writes what comes next of each kind as far as it stands in `frame` or inside it.
    fn scope(&mut self, pending: &mut Pending<'_>, frame: Option<usize>, out: &mut Element) {
        loop {
            for kind in 0..pending.len() {
                while let Some(item) = pending[kind].pop_if(|item| item.frame() == frame) {
                    out.children.push(self.item(item));
                }
            }
            let inner = pending.iter().find_map(|kind| self.step(frame, kind.last()?.frame()));
            let Some(inner) = inner else { return };
            let mut nested = element("frame");
            let first = self.named.insert(inner);
            put_some(&mut nested, &FRAME_ROWS, &self.frames[inner], &Frame::default(), &|name| {
                first || name != "name"
            });
            self.scope(pending, Some(inner), &mut nested);
            out.children.push(nested);
        }
    }

    /// The frame directly inside `from` on the way to `to`.
    fn step(&self, from: Option<usize>, to: Option<usize>) -> Option<usize> {
        let mut at = to?;
        loop {
            let parent = self.frames.get(at)?.parent;
            if parent == from {
                return Some(at);
            }
            at = parent.filter(|p| *p < at)?;
        }
    }

    fn item(&mut self, item: Item<'_>) -> Element {
        match item {
            Item::Joint(one) => joint(one),
            Item::Geom(one) => geom(one),
            Item::Site(one) => site(one),
            Item::Camera(one) => camera(one),
            Item::Light(one) => light(one),
            Item::Body(body) => {
                let mut out = of_rows("body", &BODY_ROWS, body);
                put_rows(&mut out, &BODY_POSE, body, &Body::default());
                out.children.extend(
                    body.inertial.as_ref().map(|i| of_rows::<Inertial>("inertial", &INERTIAL_ROWS, i)),
                );
                self.contents(body, &mut out);
                out
            }
        }
    }
}

fn of_rows<T: Clone + PartialEq + Default>(tag: &str, rows: &[crate::schema::Row<T>], value: &T) -> Element {
    let mut out = element(tag);
    put_rows(&mut out, rows, value, &T::default());
    out
}

/// Only `freejoint` knows alignment, and only `joint` the rest.
pub(super) fn joint(joint: &Joint) -> Element {
    let plain = Joint { kind: JointType::Free, ..Joint::default() };
    let mut free = element("freejoint");
    put_rows(&mut free, &FREEJOINT_ROWS, joint, &plain);
    let rest = Joint {
        name: joint.name.clone(),
        group: joint.group,
        align: joint.align,
        loc: joint.loc,
        frame: joint.frame,
        keyed: joint.keyed.clone(),
        ..plain
    };
    if *joint == rest { free } else { of_rows("joint", &JOINT_ROWS, joint) }
}

/// A camera with a sensor has no field of view of its own.
pub(super) fn camera(camera: &Camera) -> Element {
    let mut out = of_rows("camera", &CAMERA_ROWS, camera);
    if out.has("sensorsize") {
        out.attributes.retain(|a| a.name != "fovy");
    }
    out
}

pub(super) fn geom(geom: &Geom) -> Element {
    let mut out = of_rows("geom", &GEOM_ROWS, geom);
    out.children.extend(plugin::child(geom.plugin.as_ref()));
    out
}

pub(super) fn site(site: &Site) -> Element {
    of_rows("site", &SITE_ROWS, site)
}

/// `directional` is the older spelling of `type`.
pub(super) fn light(light: &Light) -> Element {
    let mut out = element("light");
    put_some(&mut out, &LIGHT_ROWS, light, &Light::default(), &|name| name != "directional");
    out
}
