//! Meshes of the car and its trailer.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("body", shapes::body),
    ("glass", shapes::glass),
    ("trim", shapes::trim),
    ("lamps", shapes::lamps),
    ("tyre", shapes::tyre),
    ("rim", shapes::rim),
    ("trailer", shapes::trailer),
    ("drawbar", shapes::drawbar),
];
