//! Working memory that stages reuse from step to step; its content means nothing between stages.

use crate::collision::CollisionScratch;
use crate::constraint::{ConstraintScratch, IslandScratch};
use crate::flex::FlexScratch;
use crate::integration::implicit::ImplicitScratch;
use crate::integration::integrate::IntegrateScratch;
use crate::pipeline::inverse::InverseScratch;
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
