//! Constraint islands: trees that rows couple, found as the components of a graph whose vertices are kinematic
//! trees and whose edges are constraints (MuJoCo documentation, Computation, "Constraint islands").

use super::diagonal::is_flex_equality;
use crate::model::flex::Flex;
use crate::model::{ConstraintType, Disable, EqType, Model, ObjType};
use crate::stages::{Constraints, Contacts, Islands, State};

/// Memory of island discovery.
#[derive(Clone, Debug, Default)]
pub struct IslandScratch {
    /// Union-find parent of each tree; -1 for a tree without constraints.
    parent: Vec<i32>,
    /// One past the last row of each constraint, and a tree it touches.
    blocks: Vec<(usize, i32)>,
    /// Fill counts.
    filled: Vec<i32>,
}

/// Finds the islands of all rows and the orders of trees, degrees of freedom and rows sorted by island.
pub fn find_islands(
    m: &Model,
    state: &State,
    con: &Contacts,
    efc: &Constraints,
    island: &mut Islands,
    scratch: &mut IslandScratch,
) {
    (island.nisland, island.nidof) = (0, 0);
    if m.opt.disableflags.contains(Disable::ISLAND) || efc.nefc == 0 {
        return;
    }
    scratch.parent.clear();
    scratch.parent.resize(m.ntree, -1);
    scratch.blocks.clear();
    let mut i = 0;
    while i < efc.nefc {
        let tree = unite_row(m, con, efc, i, &mut scratch.parent);
        let constraint = (efc.efc_type[i], efc.efc_id[i]);
        let flex = is_flex_contact(con, efc, i);
        let alone = is_flex_equality(m, efc, i);
        i += 1;
        while !alone && i < efc.nefc && (efc.efc_type[i], efc.efc_id[i]) == constraint {
            // Friction may couple a tree that the normal of a contact does not; sparse rows of a constraint have the same
            // columns.
            if flex && !m.is_sparse() {
                let other = unite_moved(m, efc, i, &mut scratch.parent);
                unite(&mut scratch.parent, tree, other);
            }
            i += 1;
        }
        scratch.blocks.push((i, tree));
    }
    (0..m.nflex).for_each(|f| unite_flex(Flex { m, id: f }, state, &mut scratch.parent));
    number_islands(m, &mut scratch.parent, island);
    sort_trees(m, island, &mut scratch.filled);
    sort_dofs(m, island, &mut scratch.filled);
    sort_rows(efc, island, scratch);
}

/// Unites the trees that row `i` touches; returns one of them.
fn unite_row(m: &Model, con: &Contacts, efc: &Constraints, i: usize, parent: &mut [i32]) -> i32 {
    let id = efc.efc_id[i] as usize;
    let pair = |a: i32, b: i32, parent: &mut [i32]| {
        unite(parent, a, b);
        if a >= 0 { a } else { b }
    };
    match ConstraintType::from_code(efc.efc_type[i]) {
        Some(ConstraintType::FrictionDof) => pair(m.dof_treeid[id], -1, parent),
        Some(ConstraintType::LimitJoint) => pair(m.dof_treeid[m.jnt_dofadr[id] as usize], -1, parent),
        Some(
            ConstraintType::ContactFrictionless
            | ConstraintType::ContactPyramidal
            | ConstraintType::ContactElliptic,
        ) => {
            if is_flex_contact(con, efc, i) {
                return unite_columns(m, efc, i, parent);
            }
            let [a, b] = con.contact[id].geom.map(|g| m.body_treeid[m.geom_bodyid[g as usize] as usize]);
            pair(a, b, parent)
        }
        Some(ConstraintType::Equality)
            if matches!(EqType::from_code(m.eq_type[id]), Some(EqType::Connect | EqType::Weld)) =>
        {
            let site = m.eq_objtype[id] == ObjType::Site.code();
            let [a, b] = [m.eq_obj1id[id], m.eq_obj2id[id]]
                .map(|o| m.body_treeid[if site { m.site_bodyid[o as usize] } else { o } as usize]);
            pair(a, b, parent)
        }
        _ => unite_columns(m, efc, i, parent),
    }
}

/// Whether row `i` belongs to a contact with a flex. Contacts have the last rows.
fn is_flex_contact(con: &Contacts, efc: &Constraints, i: usize) -> bool {
    i >= efc.ne + efc.nf + efc.nl && con.contact[efc.efc_id[i] as usize].geom.iter().any(|&geom| geom < 0)
}

/// Unites the trees of the columns of row `i` and returns the first. If all columns are zero, as in contacts of a body with
/// itself, it returns the tree of the first column.
fn unite_columns(m: &Model, efc: &Constraints, i: usize, parent: &mut [i32]) -> i32 {
    let first = unite_moved(m, efc, i, parent);
    if first >= 0 || efc.efc_J_rownnz[i] == 0 {
        return first;
    }
    let tree = m.dof_treeid[efc.efc_J_colind[efc.efc_J_rowadr[i] as usize] as usize];
    unite(parent, tree, tree);
    tree
}

/// Unites the trees of the columns of row `i`, of a dense row the non-zero ones; returns the first, -1 where there is none.
fn unite_moved(m: &Model, efc: &Constraints, i: usize, parent: &mut [i32]) -> i32 {
    let start = efc.efc_J_rowadr[i] as usize;
    let (mut first, mut previous) = (-1, -1);
    for k in start..start + efc.efc_J_rownnz[i] as usize {
        let tree = m.dof_treeid[efc.efc_J_colind[k] as usize];
        if tree == previous || !m.is_sparse() && efc.efc_J[k] == 0.0 {
            continue;
        }
        unite(parent, tree, previous);
        previous = tree;
        first = if first < 0 { tree } else { first };
    }
    first
}

/// Unites the trees of a flex whose elasticity couples them, as far as they are awake.
fn unite_flex(flex: Flex, state: &State, parent: &mut [i32]) {
    let m = flex.m;
    if m.flex_rigid[flex.id] || flex.dim() < 2 || flex.bending().is_none() && flex.stiffness().is_none() {
        return;
    }
    let awake = |tree: &i32| *tree >= 0 && state.tree_awake[*tree as usize] != 0;
    let mut trees = flex.bodies().iter().map(|&b| m.body_treeid[b as usize]).filter(awake);
    let Some(first) = trees.next() else { return };
    trees.filter(|&tree| tree != first).for_each(|tree| unite(parent, first, tree));
}

/// Puts two trees in one component, smaller root first; -1 stands for what does not move.
fn unite(parent: &mut [i32], a: i32, b: i32) {
    let (a, b) = (if a < 0 { b } else { a }, if b < 0 { a } else { b });
    let (Ok(a), Ok(b)) = (usize::try_from(a), usize::try_from(b)) else { return };
    for tree in [a, b] {
        if parent[tree] < 0 {
            parent[tree] = tree as i32;
        }
    }
    let (ra, rb) = (root(parent, a), root(parent, b));
    parent[ra.max(rb)] = ra.min(rb) as i32;
}

/// Root of a tree's component, halving the path on the way.
fn root(parent: &mut [i32], mut tree: usize) -> usize {
    while parent[tree] as usize != tree {
        parent[tree] = parent[parent[tree] as usize];
        tree = parent[tree] as usize;
    }
    tree
}

/// Numbers components by their smallest tree.
fn number_islands(m: &Model, parent: &mut [i32], island: &mut Islands) {
    island.tree_island.clear();
    for tree in 0..m.ntree {
        let id = if parent[tree] < 0 {
            -1
        } else {
            island.nidof += m.tree_dofnum[tree] as usize;
            match root(parent, tree) {
                r if r == tree => {
                    island.nisland += 1;
                    island.nisland as i32 - 1
                }
                r => island.tree_island[r],
            }
        };
        island.tree_island.push(id);
    }
}

/// Counts members of each island.
fn count(members: &[i32], n: usize, counts: &mut Vec<i32>) {
    counts.clear();
    counts.resize(n, 0);
    for &i in members {
        if i >= 0 {
            counts[i as usize] += 1;
        }
    }
}

/// Running sums: where each island starts.
fn starts(counts: &[i32], out: &mut Vec<i32>) {
    out.clear();
    let mut sum = 0;
    for n in counts {
        out.push(sum);
        sum += n;
    }
}

/// Members sorted by island, members of no island last; `place` is called with (member, sorted index).
fn sort_members(
    members: &[i32],
    starts: &[i32],
    free: i32,
    filled: &mut Vec<i32>,
    mut place: impl FnMut(usize, i32),
) {
    filled.clear();
    filled.extend_from_slice(starts);
    let mut last = free;
    for (i, &id) in members.iter().enumerate() {
        let next = usize::try_from(id).map_or(&mut last, |id| &mut filled[id]);
        place(i, *next);
        *next += 1;
    }
}

fn sort_trees(m: &Model, island: &mut Islands, filled: &mut Vec<i32>) {
    count(&island.tree_island, island.nisland, &mut island.island_ntree);
    starts(&island.island_ntree, &mut island.island_itreeadr);
    let constrained = island.island_ntree.iter().sum();
    island.map_itree2tree.clear();
    island.map_itree2tree.resize(m.ntree, 0);
    let order = &mut island.map_itree2tree;
    sort_members(&island.tree_island, &island.island_itreeadr, constrained, filled, |tree, at| {
        order[at as usize] = tree as i32;
    });
}

fn sort_dofs(m: &Model, island: &mut Islands, filled: &mut Vec<i32>) {
    island.dof_island.clear();
    island.dof_island.extend(m.dof_treeid.iter().map(|&t| island.tree_island[t as usize]));
    count(&island.dof_island, island.nisland, &mut island.island_nv);
    starts(&island.island_nv, &mut island.island_idofadr);
    for map in [&mut island.map_dof2idof, &mut island.map_idof2dof] {
        map.clear();
        map.resize(m.nv, 0);
    }
    let (forward, backward) = (&mut island.map_dof2idof, &mut island.map_idof2dof);
    sort_members(&island.dof_island, &island.island_idofadr, island.nidof as i32, filled, |dof, at| {
        forward[dof] = at;
        backward[at as usize] = dof as i32;
    });
    island.island_dofadr.clear();
    island.island_dofadr.extend(island.island_idofadr.iter().map(|&at| island.map_idof2dof[at as usize]));
}

fn sort_rows(efc: &Constraints, island: &mut Islands, scratch: &mut IslandScratch) {
    for counts in [&mut island.island_nefc, &mut island.island_ne, &mut island.island_nf] {
        counts.clear();
        counts.resize(island.nisland, 0);
    }
    for map in [&mut island.efc_island, &mut island.map_efc2iefc, &mut island.map_iefc2efc] {
        map.clear();
        map.resize(efc.nefc, 0);
    }
    let mut first = 0;
    for &(end, tree) in &scratch.blocks {
        let id = island.tree_island[tree as usize];
        let (k, length) = (id as usize, (end - first) as i32);
        island.island_nefc[k] += length;
        if first < efc.ne {
            island.island_ne[k] += length;
        } else if first < efc.ne + efc.nf {
            island.island_nf[k] += length;
        }
        for row in &mut island.efc_island[first..end] {
            *row = id;
        }
        first = end;
    }
    starts(&island.island_nefc, &mut island.island_iefcadr);
    scratch.filled.clone_from(&island.island_iefcadr);
    for (row, &id) in island.efc_island.iter().enumerate() {
        let next = &mut scratch.filled[id as usize];
        island.map_efc2iefc[row] = *next;
        island.map_iefc2efc[*next as usize] = row as i32;
        *next += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::rows::{RowKind, push};
    use crate::model::Arrays;

    /// Four trees of one degree of freedom; joints 3 and 1 are coupled, joint 0 has friction loss, joint 2 is free.
    #[test]
    fn coupled_trees_make_one_island() {
        let m = Model::unchecked(Arrays {
            nv: 4,
            ntree: 4,
            neq: 1,
            eq_type: vec![EqType::Joint.code()].into(),
            dof_treeid: vec![0, 1, 2, 3].into(),
            tree_dofnum: vec![1; 4].into(),
            ..Arrays::default()
        });
        let mut efc = Constraints::default();
        let row = |kind| RowKind { kind, id: 0, margin: 0.0, frictionloss: 0.0 };
        push(&mut efc, row(ConstraintType::Equality), 0.0, &[1, 3], &[-0.5, 1.0]);
        push(&mut efc, row(ConstraintType::FrictionDof), 0.0, &[0], &[1.0]);
        let mut island = Islands::default();
        let state = State::new(&m);
        find_islands(&m, &state, &Contacts::default(), &efc, &mut island, &mut IslandScratch::default());
        assert_eq!((island.nisland, island.nidof), (2, 3));
        assert_eq!(island.tree_island, [0, 1, -1, 1]);
        assert_eq!(island.map_idof2dof, [0, 1, 3, 2]);
        assert_eq!(island.map_dof2idof, [0, 1, 3, 2]);
        assert_eq!(island.efc_island, [1, 0]);
        assert_eq!(island.map_iefc2efc, [1, 0]);
        assert_eq!((&island.island_ne[..], &island.island_nf[..]), (&[0, 1][..], &[1, 0][..]));
        assert_eq!(island.island_dofadr, [0, 1]);
    }
}
