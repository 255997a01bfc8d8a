//! Meshes of the Fetch.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("base", shapes::base),
    ("base_dark", shapes::base_dark),
    ("torso", shapes::torso),
    ("torso_dark", shapes::torso_dark),
    ("head_pan", shapes::head_pan),
    ("head_tilt", shapes::head_tilt),
    ("face", shapes::face),
    ("shoulder_pan", shapes::shoulder_pan),
    ("shoulder_lift", shapes::shoulder_lift),
    ("upperarm_roll", shapes::upperarm_roll),
    ("elbow_flex", shapes::elbow_flex),
    ("forearm_roll", shapes::forearm_roll),
    ("wrist_flex", shapes::wrist_flex),
    ("wrist_roll", shapes::wrist_roll),
    ("gripper", shapes::gripper),
    ("gripper_dark", shapes::gripper_dark),
    ("finger", shapes::finger),
    ("pad", shapes::pad),
];
