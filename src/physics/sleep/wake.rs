//! What wakes trees: the user, contacts, tendons at their limits, equality constraints.

use super::{MOVED, update};
use crate::model::flex::{Flex, representative};
use crate::model::{EqType, Model, ObjType};
use crate::stages::{Contacts, State, Tendons};

/// Wakes a sleeping tree and those that fell asleep with it; one that is awake gets the count `wakened`, if that is lower.
fn wake(state: &mut State, tree: usize, wakened: i32) {
    let asleep = &mut state.tree_asleep;
    if asleep[tree] < 0 {
        asleep[tree] = asleep[tree].min(wakened);
        return;
    }
    let mut next = tree;
    while let Ok(following) = usize::try_from(asleep[next]) {
        asleep[next] = wakened;
        next = following;
    }
}

/// The least tree of the island that a sleeping tree belongs to.
fn island_of(state: &State, tree: usize) -> usize {
    let mut least = tree;
    let mut at = tree;
    // Bounded: a cycle that the user wrote may never come back.
    for _ in &state.tree_asleep {
        match usize::try_from(state.tree_asleep[at]) {
            Ok(next) if next != tree => (least, at) = (least.min(next), next),
            _ => break,
        }
    }
    least
}

/// Wakes all; true when some slept.
pub(crate) fn all(m: &Model, state: &mut State) -> bool {
    let slept = state.ntree_awake < m.ntree;
    if slept {
        state.tree_asleep.fill(MOVED);
        update(m, state);
    }
    slept
}

/// Wakes the sleeping trees that the user has moved, which `tree_awake` marks, or pushes.
pub(crate) fn by_user(m: &Model, state: &mut State) {
    let mut woken = false;
    for tree in 0..m.ntree {
        if state.tree_asleep[tree] >= 0
            && (state.tree_awake[tree] != 0 || !super::rest::can_sleep(m, state, tree, 0.0))
        {
            wake(state, tree, MOVED);
            woken = true;
        }
    }
    if woken {
        update(m, state);
    }
}

/// Wakes what touches something awake; true when something woke.
pub(crate) fn by_contacts(m: &Model, con: &Contacts, state: &mut State) -> bool {
    let mut woken = false;
    for contact in &con.contact {
        let bodies = [0, 1].map(|side| representative(m, contact, side));
        woken |= match bodies.map(|b| usize::try_from(m.body_treeid[b]).ok()) {
            [Some(a), Some(b)] => couple(state, a, b),
            [Some(tree), None] => by_mocap(state, tree, bodies[1]),
            [None, Some(tree)] => by_mocap(state, tree, bodies[0]),
            [None, None] => false,
        };
    }
    if woken {
        update(m, state);
    }
    woken
}

/// Wakes a sleeping tree that a body which the user moves touches.
fn by_mocap(state: &mut State, tree: usize, body: usize) -> bool {
    let wakes = state.tree_awake[tree] == 0 && state.body_awake[body] == 1;
    if wakes {
        wake(state, tree, MOVED);
    }
    wakes
}

/// Wakes one of two trees when the other is awake, with the count of the other.
fn couple(state: &mut State, a: usize, b: usize) -> bool {
    let (awake, sleeping) = match [a, b].map(|tree| state.tree_awake[tree] != 0) {
        [true, false] => (a, b),
        [false, true] => (b, a),
        _ => return false,
    };
    wake(state, sleeping, state.tree_asleep[awake]);
    true
}

/// Wakes trees that a tendon at its limit couples to something awake; true when something woke.
pub(crate) fn by_tendons(m: &Model, ten: &Tendons, state: &mut State) -> bool {
    let mut woken = false;
    for t in 0..m.ntendon {
        let limited = |length: f64| {
            let ([lower, upper], margin) = (m.tendon_range[t], m.tendon_margin[t]);
            m.tendon_limited[t] && (length - lower < margin || upper - length < margin)
        };
        if m.tendon_treenum[t] == 2 && limited(ten.ten_length[t]) {
            let [a, b] = m.tendon_treeid[t].map(|tree| tree as usize);
            woken |= couple(state, a, b);
        }
    }
    if woken {
        update(m, state);
    }
    woken
}

/// Wakes trees that an equality constraint couples to something awake, or to another island.
pub(crate) fn by_equalities(m: &Model, state: &mut State) {
    let mut woken = false;
    for eq in 0..m.neq {
        if !state.eq_active[eq] {
            continue;
        }
        if let Some(f) = held_flex(m, eq) {
            woken |= by_flex(Flex { m, id: f }, state);
        } else if let Some(bodies) = coupled_bodies(m, eq) {
            woken |= by_equality(m, state, bodies);
        }
    }
    if woken {
        update(m, state);
    }
}

/// The flex that an equality constraint keeps in shape.
fn held_flex(m: &Model, eq: usize) -> Option<usize> {
    let holds = matches!(
        EqType::from_code(m.eq_type[eq]),
        Some(EqType::Flex | EqType::Flexvert | EqType::Flexstrain)
    );
    usize::try_from(m.eq_obj1id[eq]).ok().filter(|_| holds)
}

/// Wakes the sleeping part of a flex that is partly awake.
fn by_flex(flex: Flex, state: &mut State) -> bool {
    let trees = || flex.bodies().iter().filter_map(|&b| usize::try_from(flex.m.body_treeid[b as usize]).ok());
    let awake = trees().find(|&tree| state.tree_awake[tree] != 0);
    let sleeping = trees().find(|&tree| state.tree_awake[tree] == 0);
    let (Some(awake), Some(sleeping)) = (awake, sleeping) else { return false };
    wake(state, sleeping, state.tree_asleep[awake]);
    true
}

/// The bodies that an equality constraint couples; none where it has one.
fn coupled_bodies(m: &Model, eq: usize) -> Option<[usize; 2]> {
    let ids = [m.eq_obj1id[eq], m.eq_obj2id[eq]];
    let [a, b] = ids.map(|id| usize::try_from(id).ok());
    let (a, b) = (a?, b?);
    Some(match EqType::from_code(m.eq_type[eq])? {
        EqType::Connect | EqType::Weld if m.eq_objtype[eq] == ObjType::Site.code() => {
            [a, b].map(|site| m.site_bodyid[site] as usize)
        }
        EqType::Connect | EqType::Weld => [a, b],
        EqType::Joint => [a, b].map(|joint| m.jnt_bodyid[joint] as usize),
        _ => return None,
    })
}

fn by_equality(m: &Model, state: &mut State, bodies: [usize; 2]) -> bool {
    let trees = bodies.map(|b| usize::try_from(m.body_treeid[b]).ok());
    let activity = |k: usize| trees[k].map_or(state.body_awake[bodies[k]], |tree| state.tree_awake[tree]);
    let [a, b] = [activity(0), activity(1)];
    if trees[0] == trees[1] {
        return false;
    }
    match ([a, b], trees) {
        ([0, 0], [Some(first), Some(second)]) => {
            let apart = island_of_sleeping(state, first) != island_of_sleeping(state, second);
            if apart {
                wake(state, first, MOVED);
                wake(state, second, MOVED);
            }
            apart
        }
        ([0, 1], [Some(tree), _]) | ([1, 0], [_, Some(tree)]) => {
            wake(state, tree, MOVED);
            true
        }
        _ => false,
    }
}

/// The island of a tree that slept before this pass; one that has just been woken has none.
fn island_of_sleeping(state: &State, tree: usize) -> Option<usize> {
    (state.tree_asleep[tree] >= 0).then(|| island_of(state, tree))
}
