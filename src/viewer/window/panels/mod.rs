//! What stands beside the picture.

mod controls;
mod inspect;
mod options;
mod simulation;
mod visual;

pub use controls::{controls, equalities, joints};
pub use inspect::{Inspection, contacts, sensors, watched};
pub use options::options;
pub use simulation::simulation;
pub use visual::{groups, visual};
