//! Meshes of the Atlas-like humanoid.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("hips", shapes::hips),
    ("waist", shapes::waist),
    ("chest", shapes::chest),
    ("plates", shapes::plates),
    ("cage", shapes::cage),
    ("lamp", shapes::lamp),
    ("head", shapes::head),
    ("lidar", shapes::lidar),
    ("clav", shapes::clav),
    ("scap", shapes::scap),
    ("uarm", shapes::uarm),
    ("bands", shapes::bands),
    ("elbow", shapes::elbow),
    ("farm", shapes::farm),
    ("wrist", shapes::wrist),
    ("fist", shapes::fist),
    ("glut", shapes::glut),
    ("thigh", shapes::thigh),
    ("struts", shapes::struts),
    ("shin", shapes::shin),
    ("knee", shapes::knee),
    ("foot", shapes::foot),
    ("sole", shapes::sole),
];
