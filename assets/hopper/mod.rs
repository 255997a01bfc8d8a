//! Meshes of the hopper.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("torso", shapes::torso),
    ("torso_dark", shapes::torso_dark),
    ("thigh", shapes::thigh),
    ("motor", shapes::motor),
    ("shin", shapes::shin),
    ("foot", shapes::foot),
    ("sole", shapes::sole),
];
