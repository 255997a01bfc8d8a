//! Meshes of the D'Kitty.

mod shapes;

use crate::dynamixel;
use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("plate", shapes::plate),
    ("spine", shapes::spine),
    ("head", shapes::head),
    ("eyes", shapes::eyes),
    ("board", shapes::board),
    ("servo", dynamixel::servo),
    ("horns", dynamixel::horns),
    ("bracket", shapes::bracket),
    ("clamp", dynamixel::clamp),
    ("tip", dynamixel::tip),
    ("rubber", dynamixel::rubber),
];
