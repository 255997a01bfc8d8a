//! `link`: a body with its inertia and shapes.

use super::super::reader::Reader;
use super::{Link, Robot, WORLD};
use crate::spec::{Body, Inertial, Orientation, UNIT, resolve};
use crate::vector::normalize;
use crate::xml::Element;

impl Reader<'_> {
    /// The body of a link where its joint places it.
    pub(super) fn link(&mut self, link: &Link<'_>, robot: &mut Robot) -> Option<Body> {
        let element = link.element;
        let mut body = Body { name: link.name.to_owned(), loc: element.loc, ..Body::default() };
        if let Some(inertial) = self.only(element, "inertial").filter(|_| link.name != WORLD) {
            body.inertial = self.inertia(inertial);
        }
        self.shapes(element, &mut body, robot);
        match link.above {
            Some((joint, _)) if link.name == WORLD && joint.value("type") == Some("fixed") => {
                self.warning(joint.loc, "link 'world' is fixed already: its joint is ignored");
            }
            Some((joint, _)) if link.name == WORLD => {
                self.error(joint.loc, "link 'world' is fixed, and no joint moves it: give it another name");
            }
            Some((joint, _)) => self.place(joint, &mut body),
            None => {}
        }
        Some(body)
    }

    /// Position and orientation of `origin`; none means the parent's frame.
    pub(super) fn origin(&mut self, parent: &Element) -> ([f64; 3], [f64; 4]) {
        let Some(origin) = self.only(parent, "origin") else { return ([0.0; 3], UNIT) };
        let pos = self.exact(origin, "xyz").unwrap_or([0.0; 3]);
        let Some(rpy) = self.exact(origin, "rpy") else { return (pos, UNIT) };
        // Roll, pitch and yaw turn about the fixed axes of the parent.
        let mut settings = self.spec.compiler.clone();
        settings.eulerseq = *b"XYZ";
        (pos, resolve(UNIT, Some(Orientation::Euler(rpy)), &settings).unwrap_or(UNIT))
    }

    /// Mass and inertia. As in MuJoCo, the principal axes of the six moments give the orientation, and `rpy` counts only when
    /// all six are zero.
    fn inertia(&mut self, element: &Element) -> Option<Inertial> {
        let (pos, quat) = self.origin(element);
        let turned = quat != UNIT;
        let mass = self.needed(element, "mass").and_then(|mass| self.exactly_given::<1>(mass, "value"));
        let moments = self.needed(element, "inertia")?;
        let mut full = [0.0; 6];
        for (slot, name) in full.iter_mut().zip(["ixx", "iyy", "izz", "ixy", "ixz", "iyz"]) {
            *slot = self.exactly_given::<1>(moments, name)?[0];
        }
        let [mass] = mass?;
        let mut inertial = Inertial { loc: element.loc, mass, pos, quat, ..Inertial::default() };
        normalize(&mut inertial.quat);
        if full != [0.0; 6] {
            inertial.fullinertia = Some(full);
            inertial.quat = UNIT;
            if turned {
                let origin = self.only(element, "origin").map_or(element.loc, |origin| origin.loc);
                self.warning(
                    origin,
                    "attribute 'rpy' of an inertial's <origin> is ignored, as MuJoCo does: turn the moments",
                );
            }
        }
        Some(inertial)
    }
}
