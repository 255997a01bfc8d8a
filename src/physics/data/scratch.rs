//! Working memory that stages reuse from step to step; its content means nothing between stages.

use crate::bias::RneScratch;
use crate::collision::CollisionScratch;
use crate::constraint::{ConstraintScratch, IslandScratch};
use crate::derivative::ImplicitScratch;
use crate::integrate::IntegrateScratch;
use crate::sensor::SensorScratch;
use crate::solver::SolverScratch;

/// Working memory of all stages.
#[derive(Clone, Debug, Default)]
#[allow(missing_docs)]
pub struct Scratch {
    pub collision: CollisionScratch,
    pub constraint: ConstraintScratch,
    pub island: IslandScratch,
    pub rne: RneScratch,
    pub solver: SolverScratch,
    pub sensor: SensorScratch,
    pub integrate: IntegrateScratch,
    pub implicit: ImplicitScratch,
}
