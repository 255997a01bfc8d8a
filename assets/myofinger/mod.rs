//! Meshes of the finger with five muscles, and of the hand that it is on.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("hand", shapes::hand),
    ("proximal", shapes::proximal),
    ("middle", shapes::middle),
    ("distal", shapes::distal),
];
