//! Meshes of the Adroit hand, and of what its tasks handle.

mod shapes;
mod things;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("forearm", shapes::forearm),
    ("forearm_dark", shapes::forearm_dark),
    ("wrist", shapes::wrist),
    ("palm", shapes::palm),
    ("palm_back", shapes::palm_back),
    ("palm_pads", shapes::palm_pads),
    ("metacarpal", shapes::metacarpal),
    ("metacarpal_pad", shapes::metacarpal_pad),
    ("knuckle", shapes::knuckle),
    ("proximal", shapes::proximal),
    ("proximal_pad", shapes::proximal_pad),
    ("middle", shapes::middle),
    ("middle_pad", shapes::middle_pad),
    ("distal", shapes::distal),
    ("distal_pad", shapes::distal_pad),
    ("thumb_proximal", shapes::thumb_proximal),
    ("thumb_proximal_pad", shapes::thumb_proximal_pad),
    ("thumb_hub", shapes::thumb_hub),
    ("thumb_middle", shapes::thumb_middle),
    ("thumb_middle_pad", shapes::thumb_middle_pad),
    ("thumb_distal", shapes::thumb_distal),
    ("thumb_distal_pad", shapes::thumb_distal_pad),
    ("pen_barrel", things::pen_barrel),
    ("pen_cap", things::pen_cap),
    ("hammer_handle", things::hammer_handle),
    ("hammer_head", things::hammer_head),
    ("nail", things::nail),
    ("door_leaf", things::door_leaf),
    ("door_panels", things::door_panels),
    ("door_post", things::door_post),
    ("door_latch", things::door_latch),
];
