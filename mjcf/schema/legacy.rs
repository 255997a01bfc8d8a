//! Attributes that MuJoCo has dropped and models still carry. They are accepted with a warning when ignoring
//! them cannot change the motion, and refused with advice when it can.

/// What becomes of a dropped attribute.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// Ignored, whatever its value.
    Ignored(&'static str),
    /// Ignored when it has this value, refused otherwise.
    IgnoredIf(&'static str, &'static str),
}

/// Element, attribute, fate.
pub const DROPPED: &[(&str, &str, Fate)] = &[
    ("option", "apirate", Fate::Ignored("it set the rate of a removed communication layer")),
    ("option", "collision", Fate::IgnoredIf("all", "pairs and excludes now decide alone")),
    ("option", "mpr_iterations", Fate::Ignored("use ccd_iterations")),
    ("option", "mpr_tolerance", Fate::Ignored("use ccd_tolerance")),
    ("flag", "passive", Fate::IgnoredIf("enable", "use spring and damper")),
    ("flag", "sensornoise", Fate::IgnoredIf("disable", "noise is the user's to add")),
    ("replicate", "prefix", Fate::Ignored("copies only have a number")),
    ("compiler", "convexhull", Fate::IgnoredIf("true", "hulls are always computed")),
    ("compiler", "exactmeshinertia", Fate::IgnoredIf("false", "use the attribute inertia of <mesh>")),
];

/// The fate of `attribute` on `element`, if it was dropped.
pub fn fate(element: &str, attribute: &str) -> Option<Fate> {
    DROPPED.iter().find(|(e, a, _)| *e == element && *a == attribute).map(|(_, _, fate)| *fate)
}
