//! Meshes of the Robotiq 2F-85.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("mount", shapes::mount),
    ("base", shapes::base),
    ("base_grey", shapes::base_grey),
    ("driver", shapes::driver),
    ("coupler", shapes::coupler),
    ("follower", shapes::follower),
    ("pad", shapes::pad),
    ("spring_link", shapes::spring_link),
];
