//! Meshes of the arm with 63 muscles. Torso and skull are those of `myoelbow`, all below the middle of the upper arm is `myohand`'s.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] =
    &[("clavicle", shapes::clavicle), ("scapula", shapes::scapula), ("humerus", shapes::humerus)];
