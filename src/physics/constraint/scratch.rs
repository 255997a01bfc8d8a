//! Memory that constraint stages reuse.

use super::half_jacobian::HalfJacobian;
use crate::flex::difference::Difference;
use crate::flex::modes::StrainScratch;

/// Memory that constraint stages reuse from step to step.
#[derive(Clone, Debug, Default)]
pub struct ConstraintScratch {
    pub(super) chain: Difference,
    /// Bodies that share a contact, with weights.
    pub(super) bodies: Vec<(usize, f64)>,
    /// Degrees of freedom that move two points, and which of them.
    pub(super) movers: Vec<(usize, [bool; 2])>,
    pub(super) columns: Vec<i32>,
    pub(super) values: Vec<f64>,
    pub(super) half: HalfJacobian,
    /// Strains of flexes.
    pub(super) strain: StrainScratch,
}
