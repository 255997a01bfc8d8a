//! Meshes of the hand with 39 muscles.

mod shapes;

use crate::shape::Shape;
use shapes::fingers;

pub(crate) const MESHES: &[Shape] = &[
    ("humerus", shapes::humerus),
    ("ulna", shapes::ulna),
    ("radius", shapes::radius),
    ("wrist", shapes::wrist),
    ("thumb_metacarpal", shapes::thumb_metacarpal),
    ("thumb_proximal", shapes::thumb_proximal),
    ("thumb_distal", shapes::thumb_distal),
    ("metacarpal2", fingers::metacarpal2),
    ("proximal2", fingers::proximal2),
    ("middle2", fingers::middle2),
    ("distal2", fingers::distal2),
    ("metacarpal3", fingers::metacarpal3),
    ("proximal3", fingers::proximal3),
    ("middle3", fingers::middle3),
    ("distal3", fingers::distal3),
    ("metacarpal4", fingers::metacarpal4),
    ("proximal4", fingers::proximal4),
    ("middle4", fingers::middle4),
    ("distal4", fingers::distal4),
    ("metacarpal5", fingers::metacarpal5),
    ("proximal5", fingers::proximal5),
    ("middle5", fingers::middle5),
    ("distal5", fingers::distal5),
];
