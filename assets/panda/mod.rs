//! Meshes of the Panda.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("base", shapes::base),
    ("base_dark", shapes::base_dark),
    ("link1", shapes::link1),
    ("link2", shapes::link2),
    ("link3", shapes::link3),
    ("link3_dark", shapes::link3_dark),
    ("link4", shapes::link4),
    ("link4_dark", shapes::link4_dark),
    ("link5", shapes::link5),
    ("link5_dark", shapes::link5_dark),
    ("link6", shapes::link6),
    ("link6_dark", shapes::link6_dark),
    ("link7", shapes::link7),
    ("link7_dark", shapes::link7_dark),
    ("hand", shapes::hand),
    ("hand_dark", shapes::hand_dark),
    ("finger", shapes::finger),
    ("fingertip", shapes::fingertip),
];
