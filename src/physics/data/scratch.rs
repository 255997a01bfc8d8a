//! Working memory that stages reuse from step to step; its content means nothing between stages.

use crate::collision::CollisionScratch;
use crate::constraint::{ConstraintScratch, IslandScratch};
use crate::flex::FlexScratch;
use crate::integration::implicit::ImplicitScratch;
use crate::sensor::SensorScratch;
use crate::solver::SolverScratch;
use crate::velocity::bias::RneScratch;

/// Working memory of all stages.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    /// Flexes.
    pub flex: FlexScratch,
    /// Collision.
    pub collision: CollisionScratch,
    /// Constraint rows.
    pub constraint: ConstraintScratch,
    /// Constraint islands.
    pub island: IslandScratch,
    /// Recursive Newton-Euler passes.
    pub rne: RneScratch,
    /// Constraint solver.
    pub solver: SolverScratch,
    /// Sensors.
    pub sensor: SensorScratch,
    /// Integrators.
    pub integrate: IntegrateScratch,
    /// Implicit integration.
    pub implicit: ImplicitScratch,
    /// Inverse dynamics.
    pub inverse: InverseScratch,
}

/// Working memory of the integrators.
#[derive(Clone, Debug, Default)]
pub struct IntegrateScratch {
    pub qacc: Vec<f64>,
    pub force: Vec<f64>,
    pub start: Vec<f64>,
    pub qvel: Vec<f64>,
    pub act_dot: Vec<f64>,
    pub stages: [Rates; 4],
}

/// Rates of the state at one Runge-Kutta stage.
#[derive(Clone, Debug, Default)]
pub struct Rates {
    pub qvel: Vec<f64>,
    pub qacc: Vec<f64>,
    pub act_dot: Vec<f64>,
}

/// Working memory of inverse dynamics.
#[derive(Clone, Debug, Default)]
pub struct InverseScratch {
    pub given: Vec<f64>,
    pub force: Vec<f64>,
    pub forward_constraint: Vec<f64>,
    pub forward_rows: Vec<f64>,
}
