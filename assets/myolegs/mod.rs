//! Meshes of the two legs with eighty muscles. The left leg has those of the right, mirrored by the model.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("trunk", shapes::trunk),
    ("skull", shapes::skull),
    ("pelvis", shapes::pelvis),
    ("femur", shapes::femur),
    ("patella", shapes::patella),
    ("tibia", shapes::tibia),
    ("fibula", shapes::fibula),
    ("talus", shapes::talus),
    ("foot", shapes::foot),
    ("toes", shapes::toes),
];
