//! The state with what follows from positions, as most later stages read them.

use super::{Com, Flexes, Kinematics, State, Tendons};

/// State, poses, centres of mass, vertices of flexes and tendon paths of one configuration.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// State and inputs.
    pub state: &'a State,
    /// Global poses.
    pub kin: &'a Kinematics,
    /// Centres of mass, motion axes, inertias about them.
    pub com: &'a Com,
    /// Vertices, edges and boxes of flexes.
    pub flex: &'a Flexes,
    /// Tendon paths.
    pub ten: &'a Tendons,
}

/// Where bodies are.
#[derive(Clone, Copy, Debug)]
pub struct Poses<'a> {
    /// Global poses.
    pub kin: &'a Kinematics,
    /// Centres of mass and motion axes.
    pub com: &'a Com,
}

/// The configuration in `$d`. The caller may borrow other parts of `$d` at the same time.
macro_rules! configuration_of {
    ($d:expr) => {
        $crate::stages::Configuration {
            state: &$d.state,
            kin: &$d.kin,
            com: &$d.com,
            flex: &$d.flex,
            ten: &$d.ten,
        }
    };
}
pub(crate) use configuration_of;
