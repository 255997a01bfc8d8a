//! What sensors read, by the stage in which they are read.

use super::{
    Actuation, Com, Configuration, Constraints, Contacts, Flexes, Inertia, Kinematics, State, Tendons,
    Transmission, Velocity,
};

/// What position sensors read.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)]
pub struct PositionInputs<'a> {
    pub state: &'a State,
    pub kin: &'a Kinematics,
    pub com: &'a Com,
    pub flex: &'a Flexes,
    pub ten: &'a Tendons,
    pub trn: &'a Transmission,
    pub inertia: &'a Inertia,
    pub efc: &'a Constraints,
}

impl<'a> PositionInputs<'a> {
    /// The part of them that most stages read.
    pub(crate) fn configuration(&self) -> Configuration<'a> {
        let PositionInputs { state, kin, com, flex, ten, .. } = *self;
        Configuration { state, kin, com, flex, ten }
    }
}

/// What velocity sensors read.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)]
pub struct VelocityInputs<'a> {
    pub state: &'a State,
    pub kin: &'a Kinematics,
    pub com: &'a Com,
    pub trn: &'a Transmission,
    pub vel: &'a Velocity,
    pub efc: &'a Constraints,
}

/// What acceleration sensors read.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)]
pub struct AccelerationInputs<'a> {
    pub state: &'a State,
    pub kin: &'a Kinematics,
    pub com: &'a Com,
    pub con: &'a Contacts,
    pub efc: &'a Constraints,
    pub vel: &'a Velocity,
    pub actuation: &'a Actuation,
}
