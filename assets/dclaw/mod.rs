//! Meshes of the D'Claw and of its valve.

mod shapes;

use crate::dynamixel;
use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("plate", shapes::plate),
    ("servo", dynamixel::servo),
    ("horns", dynamixel::horns),
    ("bracket", shapes::bracket),
    ("clamp", shapes::clamp),
    ("tip", shapes::tip),
    ("rubber", shapes::rubber),
    ("profile", shapes::profile),
    ("knob", shapes::knob),
    ("foot", shapes::foot),
];
