//! Counts of bad values that a step reset.

/// Bad values that were reset, by where they were found, since the data were made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Warnings {
    /// Resets for a position.
    pub bad_qpos: usize,
    /// Resets for a velocity.
    pub bad_qvel: usize,
    /// Resets for an acceleration.
    pub bad_qacc: usize,
    /// Steps whose controls were all set to zero for a bad one.
    pub bad_ctrl: usize,
}

impl Warnings {
    /// Resets of the state, for whatever reason.
    pub fn resets(&self) -> usize {
        self.bad_qpos + self.bad_qvel + self.bad_qacc
    }
}
