//! What became of where a person wanted the robot.

/// Whether the target of a tick was taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// The robot follows, or rests.
    Yes,
    /// No joints within their ranges bring the hand there.
    Nowhere,
    /// They would be further away than a tick may ask for.
    Far,
    /// The robot is further from what leads it than that lets it go by itself.
    Apart,
}
