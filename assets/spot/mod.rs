//! Meshes of the Spot-like quadruped.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("shell", shapes::shell),
    ("frame", shapes::frame),
    ("rails", shapes::rails),
    ("eyes", shapes::eyes),
    ("hip", shapes::hip),
    ("drum", shapes::drum),
    ("thigh", shapes::thigh),
    ("caps", shapes::caps),
    ("shin", shapes::shin),
    ("toe", shapes::toe),
];
