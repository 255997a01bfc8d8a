//! Keyword lists shared by several elements.

use super::Words;
use crate::spec::Limited;

/// Three-valued switches.
pub const FALSE_TRUE_AUTO: Words = &[("false", 0), ("true", 1), ("auto", 2)];

/// The switch with this code.
pub const fn limited(code: i32) -> Limited {
    match code {
        0 => Limited::False,
        1 => Limited::True,
        _ => Limited::Auto,
    }
}

/// Shapes of geoms and sites.
pub const GEOM_TYPES: Words = &[
    ("plane", 0),
    ("hfield", 1),
    ("sphere", 2),
    ("capsule", 3),
    ("ellipsoid", 4),
    ("cylinder", 5),
    ("box", 6),
    ("mesh", 7),
    ("sdf", 8),
];

/// Tracking modes of cameras and lights.
pub const TRACK_MODES: Words =
    &[("fixed", 0), ("track", 1), ("trackcom", 2), ("targetbody", 3), ("targetbodycom", 4)];

/// Interpolation of delayed signals.
pub const INTERPOLATIONS: Words = &[("zoh", 0), ("linear", 1), ("cubic", 2)];

/// Words for object kinds, in the order of their codes from one.
pub const OBJECT_TYPES: [&str; 25] = [
    "body", "xbody", "joint", "dof", "geom", "site", "camera", "light", "flex", "mesh", "skin", "hfield",
    "texture", "material", "pair", "exclude", "equality", "tendon", "actuator", "sensor", "numeric", "text",
    "tuple", "key", "plugin",
];
