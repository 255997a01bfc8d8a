//! Meshes of the arm with six muscles.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("torso", shapes::torso),
    ("skull", shapes::skull),
    ("shoulder", shapes::shoulder),
    ("humerus", shapes::humerus),
    ("ulna", shapes::ulna),
    ("radius", shapes::radius),
    ("hand", shapes::hand),
    ("cuff", shapes::cuff),
];
