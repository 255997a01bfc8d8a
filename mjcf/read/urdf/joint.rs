//! `joint`: what moves a link in its parent.

use physics::math::quat_to_mat;
use physics::model::JointType;

use super::super::reader::Reader;
use crate::spec::{Body, Joint, Limited, minimal_rotation};
use crate::xml::Element;

/// Types of joints; the planar one is two slides and a hinge.
const TYPES: [&str; 7] = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar", "spherical"];

impl Reader<'_> {
    /// Places the body of the child link, and gives it its joints.
    pub(super) fn place(&mut self, element: &Element, body: &mut Body) {
        let Some(kind) = self.text(element, "type") else { return };
        let Some(name) = self.text(element, "name") else { return };
        if !TYPES.contains(&kind) {
            let near = self.expansion.diagnostics.nearest(kind, TYPES.into_iter());
            let hint =
                near.map_or(format!("one of {}", TYPES.join(", ")), |n| format!("did you mean '{n}'?"));
            let loc = element.attribute("type").map_or(element.loc, |a| a.value_loc);
            return self.error_with(loc, format!("a joint cannot be '{kind}'"), Some(hint));
        }
        (body.pos, body.quat) = self.origin(element);
        let axis = self.only(element, "axis").and_then(|axis| self.exactly_given(axis, "xyz"));
        let mut joints = joints_of(kind, name, axis.unwrap_or([1.0, 0.0, 0.0]));
        joints.iter_mut().for_each(|joint| joint.loc = element.loc);
        if let Some(first) = joints.first_mut() {
            self.dynamics(element, first);
            self.limit(element, first);
        }
        // Every part has friction of its own; limits stand at the first part.
        if let [first, others @ ..] = &mut joints[..] {
            for other in others {
                other.damping = first.damping;
                other.frictionloss = first.frictionloss;
            }
        }
        if let Some(mimic) = element.children_named("mimic").next() {
            let message = "<mimic> is ignored, as MuJoCo does: convert the model to MJCF and add an equality constraint";
            self.warning(mimic.loc, message);
        }
        body.joints = joints;
    }

    fn dynamics(&mut self, element: &Element, joint: &mut Joint) {
        let Some(dynamics) = self.only(element, "dynamics") else { return };
        if let Some([damping]) = self.exact(dynamics, "damping") {
            joint.damping[0] = damping;
        }
        if let Some([friction]) = self.exact(dynamics, "friction") {
            joint.frictionloss = friction;
        }
    }

    /// A limit with one end, or with its ends exchanged, bounds nothing.
    fn limit(&mut self, element: &Element, joint: &mut Joint) {
        let Some(limit) = self.only(element, "limit") else { return };
        let (lower, upper) = (self.exact::<1>(limit, "lower"), self.exact::<1>(limit, "upper"));
        for (slot, end) in joint.range.iter_mut().zip([lower, upper]) {
            *slot = end.map_or(*slot, |[x]| x);
        }
        if lower.is_some() != upper.is_some() || joint.range[0] > joint.range[1] {
            joint.limited = Limited::False;
            self.warning(limit.loc, "the limit is ignored: it needs a 'lower' that is not above its 'upper'");
        }
        if let Some([effort]) = self.exact(limit, "effort").filter(|[effort]| *effort != 0.0) {
            joint.actfrcrange = [-effort.abs(), effort.abs()];
        }
    }
}

fn joints_of(kind: &str, name: &str, axis: [f64; 3]) -> Vec<Joint> {
    let joint =
        |kind, suffix: &str, axis| Joint { name: format!("{name}{suffix}"), kind, axis, ..Joint::default() };
    match kind {
        "fixed" => Vec::new(),
        "floating" => vec![joint(JointType::Free, "", Joint::default().axis)],
        "spherical" => vec![joint(JointType::Ball, "", axis)],
        "prismatic" => vec![joint(JointType::Slide, "", axis)],
        "planar" => {
            let m = quat_to_mat(minimal_rotation(axis));
            vec![
                joint(JointType::Slide, "_TX", [m[0], m[3], m[6]]),
                joint(JointType::Slide, "_TY", [m[1], m[4], m[7]]),
                joint(JointType::Hinge, "_RZ", axis),
            ]
        }
        _ => vec![joint(JointType::Hinge, "", axis)],
    }
}
