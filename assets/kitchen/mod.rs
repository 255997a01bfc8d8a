//! Meshes of the kitchen.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("bowls", shapes::bowls),
    ("micro_controls", shapes::micro_controls),
    ("micro_door", shapes::micro_door),
    ("micro_knobs", shapes::micro_knobs),
    ("micro_shell", shapes::micro_shell),
    ("slide_door", shapes::slide_door),
    ("slide_frame", shapes::slide_frame),
];
