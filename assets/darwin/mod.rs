//! Meshes of the Darwin-OP-like humanoid.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("chest", shapes::chest),
    ("trunk", shapes::trunk),
    ("badge", shapes::badge),
    ("helmet", shapes::helmet),
    ("visor", shapes::visor),
    ("eyes", shapes::eyes),
    ("servo", shapes::servo),
    ("yoke", shapes::yoke),
    ("pauldron", shapes::pauldron),
    ("forearm", shapes::forearm),
    ("hand", shapes::hand),
    ("thigh", shapes::thigh),
    ("shin", shapes::shin),
    ("straps", shapes::straps),
    ("foot", shapes::foot),
    ("sole", shapes::sole),
];
