//! Meshes of the Mini-Cheetah-like quadruped.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("trunk", shapes::trunk),
    ("plates", shapes::plates),
    ("trim", shapes::trim),
    ("motor", shapes::motor),
    ("flange", shapes::flange),
    ("yoke", shapes::yoke),
    ("thigh", shapes::thigh),
    ("caps", shapes::caps),
    ("shin", shapes::shin),
    ("toe", shapes::toe),
];
