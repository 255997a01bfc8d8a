//! Meshes of the MPL arm and its hand.

mod shapes;

use crate::shape::Shape;

pub(crate) const MESHES: &[Shape] = &[
    ("mount", shapes::mount),
    ("mount_dark", shapes::mount_dark),
    ("shoulder", shapes::shoulder),
    ("humerus_upper", shapes::humerus_upper),
    ("humerus_upper_dark", shapes::humerus_upper_dark),
    ("humerus_lower", shapes::humerus_lower),
    ("humerus_lower_dark", shapes::humerus_lower_dark),
    ("forearm", shapes::forearm),
    ("forearm_dark", shapes::forearm_dark),
    ("wrist_rot", shapes::wrist_rot),
    ("wrist_dev", shapes::wrist_dev),
    ("wrist_fe", shapes::wrist_fe),
    ("palm", shapes::palm),
    ("palm_dark", shapes::palm_dark),
    ("palm_pads", shapes::palm_pads),
    ("knuckle", shapes::knuckle),
    ("proximal", shapes::proximal),
    ("medial", shapes::medial),
    ("distal", shapes::distal),
    ("little_proximal", shapes::little_proximal),
    ("little_medial", shapes::little_medial),
    ("digit_joint", shapes::digit_joint),
    ("thumb_root", shapes::thumb_root),
    ("thumb_proximal", shapes::thumb_proximal),
    ("thumb_medial", shapes::thumb_medial),
    ("thumb_distal", shapes::thumb_distal),
    ("thumb_joint", shapes::thumb_joint),
];
