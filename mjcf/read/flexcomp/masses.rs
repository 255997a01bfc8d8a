//! The point masses that the points and nodes of a flexcomp are.

use crate::spec::{Body, Inertial, Joint, PluginUse};
use crate::xml::Element;
use physics::model::JointType;

/// Makes bodies like each other.
pub(super) struct Maker<'a> {
    /// What the default class of the parent body makes of joints.
    pub joint: Joint,
    pub element: &'a Element,
    /// What acts on the bodies.
    pub plugin: Option<&'a PluginUse>,
    /// Half length of the box whose inertia a body has.
    pub inertiabox: f64,
}

impl Maker<'_> {
    /// A point mass that slides along `axes`.
    pub fn body(&self, name: String, pos: [f64; 3], mass: f64, axes: &[[f64; 3]]) -> Body {
        let moment = mass * (2.0 * self.inertiabox * self.inertiabox) / 3.0;
        let loc = self.element.loc;
        let slide = |axis: &[f64; 3]| Joint {
            loc,
            kind: JointType::Slide,
            pos: [0.0; 3],
            axis: *axis,
            ..self.joint.clone()
        };
        Body {
            name,
            loc,
            pos,
            inertial: Some(Inertial { loc, mass, inertia: [moment; 3], ..Inertial::default() }),
            joints: axes.iter().map(slide).collect(),
            plugin: self.plugin.cloned(),
            ..Body::default()
        }
    }
}

/// Axes of a point that moves freely.
pub(super) const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
