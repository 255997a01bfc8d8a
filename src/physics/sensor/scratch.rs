//! Working memory of sensors.

use super::contact::Match;
use crate::collision::distance::DistanceScratch;

/// Working memory of sensors, reused from step to step.
#[derive(Clone, Debug, Default)]
pub struct SensorScratch {
    pub(super) distance: DistanceScratch,
    pub(super) matches: Vec<Match>,
    /// Geoms that a tactile sensor feels.
    pub(super) touched: Vec<usize>,
    pub(crate) momentum: Vec<f64>,
    /// Readings before any delay, where some sensor has a history.
    pub(crate) fresh: Vec<f64>,
}
