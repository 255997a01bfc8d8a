//! Saved states of a simulation.

use super::{Data, State};
use crate::arrays::Arrays;
use std::fmt;

/// All that decides the next step of a simulation: time, positions, velocities, activations, delay buffers, the start
/// of the constraint solver, and every input. Taking and restoring one allocates nothing after the first time.
///
/// ```
/// use robohive_physics::{Data, Snapshot, step};
///
/// let text = "<mujoco><worldbody><body><joint axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody></mujoco>";
/// let model = robohive_mjcf::load_str(text)?.model;
/// let mut data = Data::new(&model);
/// let mut snapshot = Snapshot::default();
/// data.save(&mut snapshot);
/// (0..10).try_for_each(|_| step(&model, &mut data))?;
/// let there = data.state.qpos.clone();
/// data.restore(&snapshot)?;
/// assert_eq!((data.time(), data.state.qpos[0]), (0.0, 0.0));
/// (0..10).try_for_each(|_| step(&model, &mut data))?;
/// assert_eq!(data.state.qpos, there);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    state: State,
}

/// A snapshot of another model, or one that was never taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignSnapshot;

impl fmt::Display for ForeignSnapshot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the snapshot was not taken of this model: its arrays have other lengths")
    }
}

impl std::error::Error for ForeignSnapshot {}

impl Snapshot {
    /// Bytes of a snapshot of a model of these sizes.
    pub fn bytes(m: &Arrays) -> usize {
        State::bytes(m)
    }

    /// Simulation time at which it was taken \[s\].
    pub fn time(&self) -> f64 {
        self.state.time
    }
}

impl Data {
    /// Writes all that decides the next step into `snapshot`.
    pub fn save(&self, snapshot: &mut Snapshot) {
        snapshot.state.clone_from(&self.state);
    }

    /// Returns to a saved state. Derived quantities follow with the next [`forward`](crate::forward) or
    /// [`step`](crate::step).
    ///
    /// # Errors
    /// The snapshot does not fit; the data stay as they were.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), ForeignSnapshot> {
        if !self.state.same_lengths(&snapshot.state) {
            return Err(ForeignSnapshot);
        }
        self.state.clone_from(&snapshot.state);
        self.unsettled = self.state.ntree_awake < self.state.tree_asleep.len();
        Ok(())
    }
}
