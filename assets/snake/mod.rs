//! Meshes of the snake.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("head", shapes::head),
    ("eyes", shapes::eyes),
    ("link", shapes::link),
    ("band", shapes::band),
    ("bellows", shapes::bellows),
    ("tail", shapes::tail),
];
