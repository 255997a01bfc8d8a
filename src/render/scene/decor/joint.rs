//! Joints.

use crate::scene::item::Shape;
use crate::scene::options::{LabelChoice, is_visible};
use crate::scene::sink::{Form, Items, Source, element};
use physics::math::add_scaled;
use physics::model::{ConstraintType, JointType, ObjType};

impl Source<'_> {
    /// The mark of a joint: an arrow along the axis of a slide or hinge, a ball or box of half size `knob` at others \[m\].
    pub(super) fn joint_mark(&self, joint: usize, width: f64, length: f64, knob: f64) -> Option<Form> {
        let (m, kin) = (self.m, &self.d.kin);
        let (pos, mat) = (kin.xanchor[joint], &kin.xmat[m.jnt_bodyid[joint] as usize]);
        let arrow = |shape| Form::connector(shape, width, pos, add_scaled(pos, kin.xaxis[joint], length));
        Some(match JointType::from_code(m.jnt_type[joint])? {
            JointType::Free => Form { shape: Shape::Box, size: [knob; 3], pos, mat: *mat },
            JointType::Ball => Form::ball(knob, pos, mat),
            JointType::Slide => arrow(Shape::Arrow),
            JointType::Hinge => arrow(Shape::ThinArrow),
        })
    }
}

/// Adds the visible joints, red as far as their limits resist.
pub(super) fn joints(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, options, .. } = from;
    if !options.show.joints {
        return;
    }
    let (width, length) = (from.size(m.vis.scale.jointwidth), from.size(m.vis.scale.jointlength));
    for i in (0..m.njnt).filter(|&i| is_visible(&options.groups.joints, m.jnt_group[i])) {
        let Some(form) = from.joint_mark(i, width, length, 0.3 * length) else { continue };
        let [r, g, b, _] = from.strained(m.vis.rgba.joint, ConstraintType::LimitJoint, i);
        let item = items.decor(&form, [r, g, b, 1.0], element(ObjType::Joint, i));
        if options.label == LabelChoice::Joint {
            item.label = from.label(ObjType::Joint, i);
        }
    }
}
