//! `worldbody` and everything below it.

use physics::model::{GeomType, JointType};

use super::Reader;
use super::defaults::ClassId;
use crate::schema::tree::{
    BODY_POSE, BODY_ROWS, CAMERA_ROWS, FRAME_ROWS, FREEJOINT_ROWS, GEOM_ROWS, INERTIAL_ROWS, JOINT_ROWS,
    LIGHT_ROWS, SITE_ROWS,
};
use crate::spec::{Body, Camera, Frame, Geom, Inertial, Joint, Light, Site};
use crate::xml::Element;

/// Where an element of the tree stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// The innermost frame of the body around the element.
    pub frame: Option<usize>,
    /// The default class in force.
    pub class: ClassId,
    /// The body is the world.
    pub world: bool,
}

impl Reader<'_> {
    pub(super) fn worldbody(&mut self, section: &Element) {
        for attribute in &section.attributes {
            self.error(attribute.loc, "<worldbody> takes no attributes");
        }
        let mut world = std::mem::take(&mut self.spec.world);
        self.inside(section, &mut world, Place { frame: None, class: 0, world: true });
        self.spec.world = world;
    }

    /// Adds the children of `parent` to `body`.
    pub(super) fn inside(&mut self, parent: &Element, body: &mut Body, place: Place) {
        for element in &parent.children {
            if place.world && matches!(element.name.as_str(), "joint" | "freejoint" | "inertial") {
                self.error(element.loc, format!("the world cannot have <{}>", element.name));
                continue;
            }
            match element.name.as_str() {
                "body" => {
                    let child = self.body(element, place);
                    body.bodies.push(child);
                }
                "frame" => self.frame(element, body, place),
                "replicate" => self.replicate(element, body, place),
                "inertial" => self.inertial(element, body),
                "joint" => {
                    let class = self.class_of(element, "class", place.class);
                    let inherited = self.classes.get(class).joint.clone();
                    let mut joint = Joint { loc: element.loc, frame: place.frame, ..inherited };
                    self.rows(element, &JOINT_ROWS, &mut joint);
                    body.joints.push(joint);
                }
                "freejoint" => {
                    let plain = Joint::default();
                    let mut joint =
                        Joint { loc: element.loc, frame: place.frame, kind: JointType::Free, ..plain };
                    self.rows(element, &FREEJOINT_ROWS, &mut joint);
                    body.joints.push(joint);
                }
                "geom" => self.geom(element, body, place),
                "site" => {
                    let class = self.class_of(element, "class", place.class);
                    let inherited = self.classes.get(class).site.clone();
                    let mut site = Site { loc: element.loc, frame: place.frame, ..inherited };
                    self.rows(element, &SITE_ROWS, &mut site);
                    body.sites.push(site);
                }
                "camera" => {
                    let class = self.class_of(element, "class", place.class);
                    let inherited = self.classes.get(class).camera.clone();
                    let mut camera = Camera { loc: element.loc, frame: place.frame, ..inherited };
                    self.rows(element, &CAMERA_ROWS, &mut camera);
                    body.cameras.push(camera);
                }
                "light" => {
                    let class = self.class_of(element, "class", place.class);
                    let inherited = self.classes.get(class).light.clone();
                    let mut light = Light { loc: element.loc, frame: place.frame, ..inherited };
                    self.rows(element, &LIGHT_ROWS, &mut light);
                    body.lights.push(light);
                }
                // Refused by the structural check.
                _ => {}
            }
        }
    }

    fn body(&mut self, element: &Element, place: Place) -> Body {
        let class = self.class_of(element, "childclass", place.class);
        let mut body = Body { loc: element.loc, frame: place.frame, ..Body::default() };
        self.rows(element, &BODY_ROWS, &mut body);
        self.rows(element, &BODY_POSE, &mut body);
        self.inside(element, &mut body, Place { frame: None, class, world: false });
        body
    }

    fn frame(&mut self, element: &Element, body: &mut Body, place: Place) {
        let class = self.class_of(element, "childclass", place.class);
        let mut frame = Frame { loc: element.loc, parent: place.frame, ..Frame::default() };
        self.rows(element, &FRAME_ROWS, &mut frame);
        self.spec.frames.push(frame);
        let frame = Some(self.spec.frames.len() - 1);
        self.inside(element, body, Place { frame, class, ..place });
    }

    fn inertial(&mut self, element: &Element, body: &mut Body) {
        let mut inertial = Inertial { loc: element.loc, ..Inertial::default() };
        self.rows(element, &INERTIAL_ROWS, &mut inertial);
        if body.inertial.replace(inertial).is_some() {
            self.error(element.loc, "the body has <inertial> twice");
        }
    }

    fn geom(&mut self, element: &Element, body: &mut Body, place: Place) {
        let class = self.class_of(element, "class", place.class);
        let inherited = self.classes.get(class).geom.clone();
        let mut geom = Geom { loc: element.loc, frame: place.frame, ..inherited };
        self.rows(element, &GEOM_ROWS, &mut geom);
        if geom.kind == GeomType::Sdf {
            self.unsupported(element.loc, "signed distance geoms");
        }
        body.geoms.push(geom);
    }
}
