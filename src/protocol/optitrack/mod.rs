//! OptiTrack: frames of NatNet, and the packet that RoboHive's own server sends.
//!
//! Source: NaturalPoint, "NatNet SDK" documentation and the sample client that documents the direct depacketisation;
//! bitstreams 3.0 and 4.1.

pub mod natnet;
pub mod robohive;

/// Pose of a rigid body in the tracker's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Body {
    /// Its number at the tracker.
    pub id: i32,
    /// Position \[m\].
    pub position: [f64; 3],
    /// Orientation, w-x-y-z.
    pub orientation: [f64; 4],
    /// Mean distance of its markers from where they should be \[m\].
    pub error: f64,
    /// Whether it was seen in this frame; if not, the pose is an old one.
    pub tracked: bool,
}
