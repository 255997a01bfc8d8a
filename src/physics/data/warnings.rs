//! Counts of bad values that a step reset.

/// How often bad values of one array were reset, and where the last one stood.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Warning {
    /// Times since the data were made.
    pub count: usize,
    /// Index in the array of the last bad value; zero before the first.
    pub last: usize,
}

impl Warning {
    pub(crate) fn note(&mut self, index: usize) {
        *self = Warning { count: self.count + 1, last: index };
    }
}

/// Bad values that were reset, by where they were found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Warnings {
    /// Resets for a position.
    pub bad_qpos: Warning,
    /// Resets for a velocity.
    pub bad_qvel: Warning,
    /// Resets for an acceleration.
    pub bad_qacc: Warning,
    /// Evaluations that took all controls as zero for a bad one: four in a step of Runge-Kutta's method, else one.
    pub bad_ctrl: Warning,
}

impl Warnings {
    /// Resets of the state, for whatever reason.
    pub fn resets(&self) -> usize {
        self.bad_qpos.count + self.bad_qvel.count + self.bad_qacc.count
    }
}
