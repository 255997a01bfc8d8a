//! Trees and simple bodies: what the sparsity patterns need to know before `set_const` runs.

use super::log::{Log, title};
use super::nodes::Tree;
use physics::model::{Arrays, SleepPolicy, WrapType};

/// Numbers the trees, takes simplicity back where tendons couple bodies, sets the sleep policies of the file.
pub(super) fn fill(m: &mut Arrays, tree: &Tree, log: &mut Log) {
    number_trees(m);
    demote_bodies_under_heavy_tendons(m);
    m.dof_simplenum = simple_runs(m).into();
    given_sleep_policies(m, tree, log);
}

/// A degree of freedom without one above it starts a tree.
fn number_trees(m: &mut Arrays) {
    let mut tree = -1;
    let numbers = m.dof_parentid.iter().map(|&above| {
        tree += i32::from(above < 0);
        tree
    });
    m.dof_treeid = numbers.collect();
}

/// A tendon with armature couples the bodies it touches, which then are not simple.
fn demote_bodies_under_heavy_tendons(m: &mut Arrays) {
    for tendon in 0..m.ntendon {
        if m.tendon_armature[tendon] == 0.0 {
            continue;
        }
        let start = m.tendon_adr[tendon] as usize;
        for wrap in start..start + m.tendon_num[tendon] as usize {
            let id = m.wrap_objid[wrap] as usize;
            let body = match WrapType::from_code(m.wrap_type[wrap]) {
                Some(WrapType::Site) => m.site_bodyid[id],
                Some(WrapType::Sphere | WrapType::Cylinder) => m.geom_bodyid[id],
                Some(WrapType::Joint | WrapType::Pulley | WrapType::None) | None => continue,
            };
            m.body_simple[body as usize] = 0;
        }
    }
}

/// For each degree of freedom the number of simple ones from it on.
fn simple_runs(m: &Arrays) -> Vec<i32> {
    let mut runs = vec![0; m.nv];
    let mut count = 0;
    for dof in (0..m.nv).rev() {
        count = if m.body_simple[m.dof_bodyid[dof] as usize] != 0 { count + 1 } else { 0 };
        runs[dof] = count;
    }
    runs
}

/// Sleep policies that the file gives, to the first body of a tree only.
fn given_sleep_policies(m: &mut Arrays, tree: &Tree, log: &mut Log) {
    m.tree_sleep_policy = vec![SleepPolicy::Auto.code(); m.ntree].into();
    for (id, node) in tree.bodies.iter().enumerate() {
        if node.spec.sleep == SleepPolicy::Auto {
            continue;
        }
        let above = m.body_weldid[m.body_parentid[id] as usize] as usize;
        let is_root = m.body_weldid[id] == id as i32 && m.body_dofnum[id] > 0 && m.body_dofnum[above] == 0;
        if is_root {
            let tree = m.dof_treeid[m.body_dofadr[id] as usize] as usize;
            m.tree_sleep_policy[tree] = node.spec.sleep.code();
        } else {
            let what = title("body", node.name());
            log.error(node.spec.loc, format!("{what}: sleep is only for the moving root body of a tree"));
        }
    }
}
