//! Meshes of the Sawyer.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("base", shapes::base),
    ("link0", shapes::link0),
    ("link0_dark", shapes::link0_dark),
    ("head", shapes::head),
    ("screen", shapes::screen),
    ("eyes", shapes::eyes),
    ("link1", shapes::link1),
    ("link1_dark", shapes::link1_dark),
    ("link2", shapes::link2),
    ("link2_dark", shapes::link2_dark),
    ("link3", shapes::link3),
    ("link3_dark", shapes::link3_dark),
    ("link4", shapes::link4),
    ("link4_dark", shapes::link4_dark),
    ("link5", shapes::link5),
    ("link5_dark", shapes::link5_dark),
    ("link6", shapes::link6),
    ("gripper", shapes::gripper),
    ("gripper_dark", shapes::gripper_dark),
    ("finger", shapes::finger),
    ("pad", shapes::pad),
];
