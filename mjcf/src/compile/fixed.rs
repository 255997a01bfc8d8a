//! Arrays that follow from the others without a configuration: trees, subtree mass, who acts on what, sleep policy.

use super::tree::Tree;
use super::{Log, title};
use crate::diagnostic::Loc;
use physics::Model;
use physics::model::{SleepPolicy, TrnType, WrapType};

/// Fills them.
pub(super) fn fill(m: &mut Model, tree: &Tree, log: &mut Log) {
    trees(m);
    subtree_mass(m);
    features(m);
    acting(m);
    tendon_trees(m);
    demote_bodies_under_heavy_tendons(m);
    m.dof_simplenum = simple_runs(m);
    given_sleep_policies(m, tree, log);
    let result = sleep_policies(m);
    log.check(Loc::NONE, "sleep", result);
}

fn trees(m: &mut Model) {
    let mut tree = -1;
    m.dof_treeid.clear();
    for dof in 0..m.nv {
        tree += i32::from(m.dof_parentid[dof] < 0);
        m.dof_treeid.push(tree);
    }
    m.tree_bodyadr = vec![0; m.ntree];
    m.tree_bodynum = vec![0; m.ntree];
    m.tree_dofadr = vec![0; m.ntree];
    m.tree_dofnum = vec![0; m.ntree];
    let mut current = -1;
    for body in 0..m.nbody {
        let weld = m.body_weldid[body] as usize;
        let id = if m.body_dofnum[weld] > 0 { m.dof_treeid[m.body_dofadr[weld] as usize] } else { -1 };
        m.body_treeid.push(id);
        if id > current {
            current += 1;
            m.tree_bodyadr[current as usize] = body as i32;
        }
        if id >= 0 {
            m.tree_bodynum[current as usize] += 1;
        }
    }
    for dof in (0..m.nv).rev() {
        let tree = m.dof_treeid[dof] as usize;
        m.tree_dofadr[tree] = dof as i32;
        m.tree_dofnum[tree] += 1;
    }
}

fn subtree_mass(m: &mut Model) {
    m.body_subtreemass = m.body_mass.clone();
    for body in (1..m.nbody).rev() {
        m.body_subtreemass[m.body_parentid[body] as usize] += m.body_subtreemass[body];
    }
}

fn features(m: &mut Model) {
    m.ngravcomp = m.body_gravcomp.iter().filter(|&&g| g > 0.0).count();
    m.flg_gravcomp = m.ngravcomp > 0;
    m.flg_surfacevel = m.geom_surfacevel.iter().any(|v| *v != [0.0; 6]);
    m.flg_adhesion = m.geom_adhesion.iter().chain(&m.pair_adhesion).any(|&a| a != 0.0);
}

/// The actuator that adds damping or armature to a joint or tendon: -1 for none, -2 for several.
fn acting(m: &mut Model) {
    m.jnt_actuatorid = vec![-1; m.njnt];
    m.tendon_actuatorid = vec![-1; m.ntendon];
    for a in 0..m.nactuator {
        if m.actuator_damping[a] == 0.0
            && m.actuator_dampingpoly[a] == [0.0; 2]
            && m.actuator_armature[a] == 0.0
        {
            continue;
        }
        let target = m.actuator_trnid[a][0] as usize;
        let slot = match TrnType::from_code(m.actuator_trntype[a]) {
            Some(TrnType::Joint | TrnType::Jointinparent) => &mut m.jnt_actuatorid[target],
            Some(TrnType::Tendon) => &mut m.tendon_actuatorid[target],
            _ => continue,
        };
        *slot = if *slot == -1 { a as i32 } else { -2 };
    }
}

/// Body that a path element is fixed to, -1 for a pulley.
pub(super) fn wrap_body(m: &Model, wrap: usize) -> i32 {
    let id = m.wrap_objid[wrap] as usize;
    match WrapType::from_code(m.wrap_type[wrap]) {
        Some(WrapType::Joint) => m.jnt_bodyid[id],
        Some(WrapType::Site) => m.site_bodyid[id],
        Some(WrapType::Sphere | WrapType::Cylinder) => m.geom_bodyid[id],
        Some(WrapType::Pulley | WrapType::None) | None => -1,
    }
}

/// Path elements of a tendon.
pub(super) fn path(m: &Model, tendon: usize) -> std::ops::Range<usize> {
    let start = m.tendon_adr[tendon] as usize;
    start..start + m.tendon_num[tendon] as usize
}

/// Trees a tendon touches, each once, in the order of its path.
fn trees_of_tendon(m: &Model, tendon: usize) -> Vec<i32> {
    let mut trees = Vec::new();
    for wrap in path(m, tendon) {
        let body = wrap_body(m, wrap);
        let tree = if body < 0 { -1 } else { m.body_treeid[body as usize] };
        if tree >= 0 && !trees.contains(&tree) {
            trees.push(tree);
        }
    }
    trees
}

fn tendon_trees(m: &mut Model) {
    for tendon in 0..m.ntendon {
        let trees = trees_of_tendon(m, tendon);
        m.tendon_treenum.push(trees.len() as i32);
        m.tendon_treeid.push(std::array::from_fn(|k| trees.get(k).copied().unwrap_or(-1)));
    }
}

/// A tendon with armature couples the bodies it touches, which then are not simple.
fn demote_bodies_under_heavy_tendons(m: &mut Model) {
    for tendon in (0..m.ntendon).filter(|&t| m.tendon_armature[t] != 0.0).collect::<Vec<_>>() {
        for wrap in path(m, tendon) {
            if m.wrap_type[wrap] != WrapType::Joint.code() && wrap_body(m, wrap) >= 0 {
                let body = wrap_body(m, wrap) as usize;
                m.body_simple[body] = 0;
            }
        }
    }
}

/// For each degree of freedom the number of simple ones from it on.
fn simple_runs(m: &Model) -> Vec<i32> {
    let mut runs = vec![0; m.nv];
    let mut count = 0;
    for dof in (0..m.nv).rev() {
        count = if m.body_simple[m.dof_bodyid[dof] as usize] != 0 { count + 1 } else { 0 };
        runs[dof] = count;
    }
    runs
}

/// Sleep policies that the file gives, to root bodies only.
fn given_sleep_policies(m: &mut Model, tree: &Tree, log: &mut Log) {
    m.tree_sleep_policy = vec![SleepPolicy::Auto.code(); m.ntree];
    for (id, node) in tree.bodies.iter().enumerate().filter(|(_, b)| b.spec.sleep != SleepPolicy::Auto) {
        let tree = m.body_treeid[id];
        if tree >= 0 && m.tree_bodyadr[tree as usize] == id as i32 {
            m.tree_sleep_policy[tree as usize] = node.spec.sleep.code();
        } else {
            let what = title("body", node.name());
            log.error(node.spec.loc, format!("{what}: sleep is only for the moving root body of a tree"));
        }
    }
}

/// Trees left to the compiler sleep unless something outside their own joints drives them.
fn sleep_policies(m: &mut Model) -> Result<(), String> {
    let mut awake = Vec::new();
    for a in 0..m.nactuator {
        let [target, reference] = m.actuator_trnid[a];
        let id = target as usize;
        let body = match TrnType::from_code(m.actuator_trntype[a]) {
            Some(TrnType::Joint | TrnType::Jointinparent) => m.jnt_bodyid[id],
            Some(TrnType::So3) if reference < 0 => m.jnt_bodyid[id],
            Some(TrnType::So3 | TrnType::Site | TrnType::Slidercrank) => m.site_bodyid[id],
            Some(TrnType::Body) => target,
            Some(TrnType::Tendon) => {
                awake.extend(trees_of_tendon(m, id));
                continue;
            }
            Some(TrnType::Undefined) | None => continue,
        };
        awake.push(m.body_treeid[body as usize]);
    }
    for tendon in 0..m.ntendon {
        let trees = trees_of_tendon(m, tendon);
        let passive = m.tendon_stiffness[tendon] == 0.0
            && m.tendon_stiffnesspoly[tendon] == [0.0; 2]
            && m.tendon_damping[tendon] == 0.0
            && m.tendon_dampingpoly[tendon] == [0.0; 2]
            && m.tendon_actuatorid[tendon] == -1;
        if trees.len() < 2 || (trees.len() == 2 && passive) {
            continue;
        }
        for &tree in &trees {
            let policy = m.tree_sleep_policy[tree as usize];
            if policy == SleepPolicy::Allowed.code() || policy == SleepPolicy::Init.code() {
                return Err(format!("tendon {tendon} couples tree {tree} to others, which must not sleep"));
            }
        }
        awake.extend(trees);
    }
    for tree in awake.into_iter().filter(|&t| t >= 0) {
        let policy = &mut m.tree_sleep_policy[tree as usize];
        if *policy == SleepPolicy::Auto.code() {
            *policy = SleepPolicy::AutoNever.code();
        }
    }
    for policy in m.tree_sleep_policy.iter_mut().filter(|p| **p == SleepPolicy::Auto.code()) {
        *policy = SleepPolicy::AutoAllowed.code();
    }
    Ok(())
}
