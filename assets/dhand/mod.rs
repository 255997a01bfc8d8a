//! Meshes of the D'Hand.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("plate", shapes::plate),
    ("servo", shapes::servo),
    ("horns", shapes::horns),
    ("bracket", shapes::bracket),
    ("tip", shapes::tip),
    ("rubber", shapes::rubber),
];
