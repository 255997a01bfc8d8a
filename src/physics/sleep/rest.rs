//! How trees fall asleep.

use super::{MOVED, READY, is_on};
use crate::model::{Model, SleepPolicy};
use crate::stages::{Islands, State};
use std::ops::Range;

/// Degrees of freedom of a tree.
fn dofs(m: &Model, tree: usize) -> Range<usize> {
    let first = m.tree_dofadr[tree] as usize;
    first..first + m.tree_dofnum[tree] as usize
}

/// Whether a tree may sleep: nobody pushes it, and it is slower than `tolerance`; for zero, it stands still.
pub(crate) fn can_sleep(m: &Model, state: &State, tree: usize, tolerance: f64) -> bool {
    let policy = SleepPolicy::from_code(m.tree_sleep_policy[tree]);
    if matches!(policy, Some(SleepPolicy::Never | SleepPolicy::AutoNever)) {
        return false;
    }
    let first = m.tree_bodyadr[tree] as usize;
    let bodies = first..first + m.tree_bodynum[tree] as usize;
    // A negative zero counts as a push, as it does where bytes are compared.
    let none = |x: &f64| x.to_bits() == 0;
    let untouched = state.xfrc_applied[bodies].as_flattened().iter().all(none)
        && state.qfrc_applied[dofs(m, tree)].iter().all(none);
    let velocity = &state.qvel[dofs(m, tree)];
    untouched
        && if tolerance == 0.0 {
            velocity.iter().all(none)
        } else {
            let speeds = velocity.iter().zip(&m.dof_length[dofs(m, tree)]);
            speeds.map(|(v, length)| length * v.abs()).all(|speed| speed < tolerance)
        }
}

/// Puts trees to sleep that have been slow for long enough, whole islands at a time: they stop. How many.
pub(crate) fn fall_asleep(
    m: &Model,
    island: &Islands,
    nefc: usize,
    state: &mut State,
    qacc: &mut [f64],
) -> usize {
    if !is_on(m) || (nefc > 0 && island.nisland == 0) {
        return 0;
    }
    for tree in 0..m.ntree {
        if state.tree_asleep[tree] < 0 {
            state.tree_asleep[tree] = if can_sleep(m, state, tree, m.opt.sleep_tolerance) {
                (state.tree_asleep[tree] + 1).min(READY)
            } else {
                MOVED
            };
        }
    }
    let mut slept = 0;
    let mut put = |state: &mut State, trees: &[i32]| {
        if trees.iter().all(|&tree| state.tree_asleep[tree as usize] == READY) {
            stop(m, state, qacc, trees);
            slept += trees.len();
        }
    };
    let mut alone = 0;
    for k in 0..island.nisland {
        let first = island.island_itreeadr[k] as usize;
        alone = first + island.island_ntree[k] as usize;
        put(state, &island.map_itree2tree[first..alone]);
    }
    for k in alone..m.ntree {
        let tree = if island.nisland > 0 { island.map_itree2tree[k] } else { k as i32 };
        put(state, &[tree]);
    }
    slept
}

/// Stops trees, which sleep from now on, one pointing to the next.
fn stop(m: &Model, state: &mut State, qacc: &mut [f64], trees: &[i32]) {
    for (k, &tree) in trees.iter().enumerate() {
        let tree = tree as usize;
        state.tree_asleep[tree] = trees[(k + 1) % trees.len()];
        state.qvel[dofs(m, tree)].fill(0.0);
        qacc[dofs(m, tree)].fill(0.0);
    }
}
