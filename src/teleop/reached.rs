//! Whether the robot can follow a target.

/// Whether the target of a tick was accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// The robot follows, or rests.
    Yes,
    /// No joint positions within the ranges reach it.
    Nowhere,
    /// The joint positions are further away than the limit of a tick.
    Far,
    /// The robot is further from its leader than the distance that it may catch up.
    Apart,
}
