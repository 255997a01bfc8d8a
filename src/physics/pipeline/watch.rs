//! Stages of a step, told to an observer as they end. Physics has no clock: who wants durations brings one.
//!
//! ```
//! use robohive_physics::pipeline::watch::{Stage, Watch};
//! use robohive_physics::{Data, step_watched};
//!
//! struct Order(Vec<Stage>);
//!
//! impl Watch for Order {
//!     fn ended(&mut self, stage: Stage) {
//!         self.0.push(stage);
//!     }
//! }
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut order = Order(Vec::new());
//! step_watched(&model, &mut Data::new(&model), &mut order)?;
//! assert_eq!((order.0.first(), order.0.last()), (Some(&Stage::Checks), Some(&Stage::Integration)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

/// A part of the step. Every instant of a step belongs to one part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Checks of state, inputs and accelerations.
    Checks,
    /// Poses, centres of mass, motion axes, cameras.
    Kinematics,
    /// Tendon paths and Jacobian.
    Tendons,
    /// Joint-space inertia and its factor.
    Inertia,
    /// Contacts.
    Collision,
    /// Constraint rows and their impedance.
    Constraint,
    /// Islands.
    Islands,
    /// Actuator lengths and moments.
    Transmission,
    /// Velocities, passive forces, reference accelerations, bias forces.
    Velocity,
    /// Actuator forces.
    Actuation,
    /// Acceleration without constraints.
    Acceleration,
    /// Constraint solver.
    Solver,
    /// Sensors and energy.
    Sensors,
    /// Integration.
    Integration,
}

impl Stage {
    /// All parts, in the order of a step.
    pub const ALL: [Stage; 14] = [
        Stage::Checks,
        Stage::Kinematics,
        Stage::Tendons,
        Stage::Inertia,
        Stage::Collision,
        Stage::Constraint,
        Stage::Islands,
        Stage::Transmission,
        Stage::Velocity,
        Stage::Actuation,
        Stage::Acceleration,
        Stage::Solver,
        Stage::Sensors,
        Stage::Integration,
    ];
}

/// An observer of a step. The unit type observes nothing and costs nothing.
pub trait Watch {
    /// All since the last call, or since the step began, belongs to `stage`.
    fn ended(&mut self, stage: Stage);
}

impl Watch for () {
    #[inline(always)]
    fn ended(&mut self, _: Stage) {}
}
