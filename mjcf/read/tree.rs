//! `worldbody` and everything below it.

use physics::model::JointType;

use super::reader::Reader;
use crate::schema::tree::{
    BODY_POSE, BODY_ROWS, CAMERA_ROWS, FRAME_ROWS, FREEJOINT_ROWS, GEOM_ROWS, INERTIAL_ROWS, JOINT_ROWS,
    LIGHT_ROWS, SITE_ROWS,
};
use crate::spec::ClassId;
use crate::spec::{Body, Camera, Frame, Geom, Inertial, Joint, Light, Site};
use crate::xml::Element;

/// Where an element of the tree stands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    /// The innermost frame of the body around the element.
    pub frame: Option<usize>,
    /// The default class in force.
    pub class: ClassId,
    /// That of the body, whatever frames inside it say.
    pub body_class: ClassId,
    /// The body is the world.
    pub world: bool,
}

impl Reader<'_> {
    pub(super) fn worldbody(&mut self, section: &Element) {
        for attribute in &section.attributes {
            self.error(attribute.loc, "<worldbody> takes no attributes");
        }
        self.open = vec![std::mem::take(&mut self.spec.world)];
        self.inside(section, Place { frame: None, class: 0, body_class: 0, world: true });
        self.spec.world = self.open.pop().unwrap_or_default();
    }

    /// The body that elements are added to.
    pub(super) fn body_here(&mut self) -> &mut Body {
        if self.open.is_empty() {
            self.open.push(Body::default());
        }
        let last = self.open.len() - 1;
        &mut self.open[last]
    }

    /// Adds the children of `parent` to the open body.
    pub(crate) fn inside(&mut self, parent: &Element, place: Place) {
        for element in &parent.children {
            if place.world && matches!(element.name.as_str(), "joint" | "freejoint" | "inertial") {
                self.error(element.loc, format!("the world cannot have <{}>", element.name));
                continue;
            }
            match element.name.as_str() {
                "body" => {
                    let child = self.body(element, place);
                    self.body_here().bodies.push(child);
                }
                "frame" => self.frame(element, place),
                "replicate" => self.replicate(element, place),
                "attach" => self.attach(element, place),
                "inertial" => self.inertial(element),
                "joint" => {
                    let class = self.class_of(element, "class", place.class);
                    let inherited = self.spec.classes.of(class).joint.clone();
                    let mut joint = Joint { loc: element.loc, frame: place.frame, ..inherited };
                    self.rows(element, &JOINT_ROWS, &mut joint);
                    self.body_here().joints.push(joint);
                }
                "freejoint" => {
                    let plain = Joint::default();
                    let mut joint =
                        Joint { loc: element.loc, frame: place.frame, kind: JointType::Free, ..plain };
                    self.rows(element, &FREEJOINT_ROWS, &mut joint);
                    self.body_here().joints.push(joint);
                }
                "flexcomp" => self.flexcomp(element, place),
                "geom" => self.geom(element, place),
                "site" => {
                    let class = self.class_of(element, "class", place.class);
                    let inherited = self.spec.classes.of(class).site.clone();
                    let mut site = Site { loc: element.loc, frame: place.frame, ..inherited };
                    self.rows(element, &SITE_ROWS, &mut site);
                    self.body_here().sites.push(site);
                }
                "camera" => {
                    let class = self.class_of(element, "class", place.class);
                    let inherited = self.spec.classes.of(class).camera.clone();
                    let mut camera = Camera { loc: element.loc, frame: place.frame, ..inherited };
                    self.rows(element, &CAMERA_ROWS, &mut camera);
                    self.body_here().cameras.push(camera);
                }
                "light" => {
                    let class = self.class_of(element, "class", place.class);
                    let inherited = self.spec.classes.of(class).light.clone();
                    let mut light = Light { loc: element.loc, frame: place.frame, ..inherited };
                    self.rows(element, &LIGHT_ROWS, &mut light);
                    self.body_here().lights.push(light);
                }
                "plugin" => self.body_plugin(element),
                "composite" => self.composite(element, place),
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
        self.open.push(body);
        self.inside(element, Place { frame: None, class, body_class: class, world: false });
        self.open.pop().unwrap_or_default()
    }

    fn frame(&mut self, element: &Element, place: Place) {
        let class = self.class_of(element, "childclass", place.class);
        let holder = self.body_here().loc;
        let mut frame = Frame { loc: element.loc, parent: place.frame, holder, ..Frame::default() };
        self.rows(element, &FRAME_ROWS, &mut frame);
        self.spec.frames.push(frame);
        let frame = Some(self.spec.frames.len() - 1);
        self.inside(element, Place { frame, class, ..place });
    }

    fn inertial(&mut self, element: &Element) {
        let mut inertial = Inertial { loc: element.loc, ..Inertial::default() };
        self.rows(element, &INERTIAL_ROWS, &mut inertial);
        if self.body_here().inertial.replace(inertial).is_some() {
            self.error(element.loc, "the body has <inertial> twice");
        }
    }

    fn body_plugin(&mut self, element: &Element) {
        let used = self.plugin_use(element);
        if self.body_here().plugin.replace(used).is_some() {
            self.error(element.loc, "the body has <plugin> twice");
        }
    }

    fn geom(&mut self, element: &Element, place: Place) {
        let class = self.class_of(element, "class", place.class);
        let inherited = self.spec.classes.of(class).geom.clone();
        let mut geom = Geom { loc: element.loc, frame: place.frame, ..inherited };
        self.rows(element, &GEOM_ROWS, &mut geom);
        geom.plugin = self.child_plugin(element);
        self.body_here().geoms.push(geom);
    }
}
