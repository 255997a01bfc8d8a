//! What the stages of a step write: one struct a stage, and what several of them read together.

mod budget;
mod configuration;
mod constraints;
mod declare;
mod outputs;
mod sensor_inputs;

pub use budget::{Demand, OverBudget, StepBudget};
pub(crate) use configuration::configuration_of;
pub use configuration::{Configuration, Poses};
pub use constraints::{Constraints, Contact, Contacts, Islands, SolverStat, SolverStatistics};
pub use outputs::{
    Acceleration, Actuation, Com, Flexes, Implicit, Inertia, Kinematics, Passive, Sensors, State, Tendons,
    Transmission, Velocity,
};
pub use sensor_inputs::{AccelerationInputs, PositionInputs, VelocityInputs};
