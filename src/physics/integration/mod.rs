//! The time step itself: from accelerations to the next state.

pub mod implicit;
pub mod integrate;
