//! Meshes of the SO-101.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("base", shapes::base),
    ("board", shapes::board),
    ("shoulder", shapes::shoulder),
    ("upper_arm", shapes::upper_arm),
    ("lower_arm", shapes::lower_arm),
    ("wrist", shapes::wrist),
    ("gripper", shapes::gripper),
    ("jaw", shapes::jaw),
    ("servo", shapes::servo),
    ("horns", shapes::horns),
];
