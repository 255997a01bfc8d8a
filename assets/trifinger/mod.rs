//! Meshes of TriFinger.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("hub", shapes::hub),
    ("upper", shapes::upper),
    ("upper_dark", shapes::upper_dark),
    ("middle", shapes::middle),
    ("middle_dark", shapes::middle_dark),
    ("lower", shapes::lower),
    ("lower_dark", shapes::lower_dark),
    ("tip", shapes::tip),
];
