//! Trees that fall asleep at the end of a step, and simulations that begin with trees asleep.

use crate::data::Data;
use crate::model::{Model, SleepPolicy};
use crate::pipeline::error::StepError;
use crate::pipeline::forward::{after_position, forward};
use crate::sleep::rest::fall_asleep;
use crate::sleep::{MOVED, READY, is_on, update};

/// At the end of a step: puts trees to sleep, and computes what depends on their velocities, which are zero now.
pub(crate) fn end_step(m: &Model, d: &mut Data) {
    if fall_asleep(m, &d.island, d.efc.nefc, &mut d.state, &mut d.acc.qacc) > 0 {
        after_position(m, d);
        update(m, &mut d.state);
    }
}

/// Puts the trees to sleep that begin so; the first of them that cannot.
///
/// # Errors
/// As [`forward`].
pub(crate) fn begin(m: &Model, d: &mut Data) -> Result<Option<usize>, StepError> {
    let begins = |tree: &usize| m.tree_sleep_policy[*tree] == SleepPolicy::Init.code();
    if !is_on(m) || !(0..m.ntree).any(|tree| begins(&tree)) {
        return Ok(None);
    }
    forward(m, d)?;
    for tree in 0..m.ntree {
        d.state.tree_asleep[tree] = if begins(&tree) { READY } else { MOVED };
    }
    fall_asleep(m, &d.island, d.efc.nefc, &mut d.state, &mut d.acc.qacc);
    update(m, &mut d.state);
    // As in MuJoCo, a tree that has never been awake starts from no acceleration when it wakes.
    d.acc.qacc_smooth.fill(0.0);
    d.acc.qfrc_smooth.fill(0.0);
    Ok((0..m.ntree).filter(begins).find(|&tree| d.state.tree_asleep[tree] < 0))
}
