//! A keyframe that there is not.

use std::fmt;

/// A keyframe that a model does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoKeyframe {
    /// Keyframe asked for.
    pub key: usize,
    /// Keyframes of the model.
    pub keyframes: usize,
}

impl fmt::Display for NoKeyframe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.keyframes {
            0 => write!(f, "keyframe {} does not exist: the model has none", self.key),
            n => write!(f, "keyframe {} does not exist: the model has {n}, numbered from 0", self.key),
        }
    }
}

impl std::error::Error for NoKeyframe {}
