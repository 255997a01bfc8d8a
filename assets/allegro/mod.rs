//! Meshes of the Allegro hand.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("palm", shapes::palm),
    ("palm_plates", shapes::palm_plates),
    ("palm_screws", shapes::palm_screws),
    ("base", shapes::base),
    ("base_horns", shapes::base_horns),
    ("proximal", shapes::proximal),
    ("medial", shapes::medial),
    ("distal", shapes::distal),
    ("link_horns", shapes::link_horns),
    ("tip", shapes::tip),
    ("thumb_base", shapes::thumb_base),
    ("thumb_medial", shapes::thumb_medial),
    ("thumb_distal", shapes::thumb_distal),
    ("thumb_tip", shapes::thumb_tip),
];
