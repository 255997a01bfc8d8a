//! Meshes of D'Manus.

mod shapes;

use crate::dynamixel;
use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("mount", shapes::mount),
    ("palm", shapes::palm),
    ("core", shapes::core),
    ("servo", dynamixel::servo),
    ("horns", dynamixel::horns),
    ("knuckle", shapes::knuckle),
    ("bracket", shapes::bracket),
    ("tip", shapes::tip),
    ("rubber", shapes::rubber),
];
