//! Meshes of the Shadow hand.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("forearm", shapes::forearm),
    ("forearm_metal", shapes::forearm_metal),
    ("wrist", shapes::wrist),
    ("palm", shapes::palm),
    ("palm_metal", shapes::palm_metal),
    ("palm_pads", shapes::palm_pads),
    ("metacarpal", shapes::metacarpal),
    ("metacarpal_pad", shapes::metacarpal_pad),
    ("knuckle", shapes::knuckle),
    ("proximal", shapes::proximal),
    ("middle", shapes::middle),
    ("distal", shapes::distal),
    ("distal_pad", shapes::distal_pad),
    ("thumb_proximal", shapes::thumb_proximal),
    ("thumb_hub", shapes::thumb_hub),
    ("thumb_middle", shapes::thumb_middle),
    ("thumb_distal", shapes::thumb_distal),
    ("thumb_distal_pad", shapes::thumb_distal_pad),
];
