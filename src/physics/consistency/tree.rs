//! Bodies, joints, degrees of freedom and trees.

use super::requirement::{Inconsistent, ranges, references, require, spans, within};
use crate::arrays::{Arrays, JointType};
use crate::constants::set_const::Trees;
use crate::geometry::hierarchy::MAX_LEVELS;
use crate::position::chain::last_dof;

pub(super) fn check(m: &Arrays) -> Result<(), Inconsistent> {
    references! { m:
        body_mocapid -1 m.nmocap;
        dof_bodyid 0 m.nbody;
        dof_jntid 0 m.njnt;
    }
    ranges! { m:
        body_jntadr body_jntnum m.njnt;
        body_dofadr body_dofnum m.nv;
        body_geomadr body_geomnum m.ngeom;
        body_bvhadr body_bvhnum m.nbvh;
    }
    bodies(m)?;
    joints(m)?;
    dofs(m)?;
    trees(m)?;
    hierarchies(m)
}

/// A body is followed by its descendants, then by its siblings; elements of a body say so too.
fn bodies(m: &Arrays) -> Result<(), Inconsistent> {
    for b in 0..m.nbody {
        let before = |id: i32| id >= 0 && (id as usize) < b.max(1);
        require(before(m.body_parentid[b]), "body_parentid", b, "an earlier body")?;
        let parent = m.body_parentid[b] as usize;
        let mut above = b.saturating_sub(1);
        while above > parent {
            above = m.body_parentid[above] as usize;
        }
        require(above == parent, "body_parentid", b, "the body before or one above it")?;
        let root = if parent == 0 { b as i32 } else { m.body_rootid[parent] };
        require(m.body_rootid[b] == root, "body_rootid", b, "what follows from the parents")?;
        let moves = b == 0 || m.body_jntnum[b] > 0 || m.body_mocapid[b] >= 0;
        let weld = if moves { b as i32 } else { m.body_weldid[parent] };
        require(m.body_weldid[b] == weld, "body_weldid", b, "what follows from the joints")?;
        let own = |adr: i32, num: i32| adr.max(0) as usize..(adr + num).max(0) as usize;
        for g in own(m.body_geomadr[b], m.body_geomnum[b]) {
            require(m.geom_bodyid[g] as usize == b, "geom_bodyid", g, "the body that lists the geom")?;
        }
        for j in own(m.body_jntadr[b], m.body_jntnum[b]) {
            require(m.jnt_bodyid[j] as usize == b, "jnt_bodyid", j, "the body that lists the joint")?;
        }
        for dof in own(m.body_dofadr[b], m.body_dofnum[b]) {
            require(m.dof_bodyid[dof] as usize == b, "dof_bodyid", dof, "the body that lists the dof")?;
        }
    }
    for (array, counts, total) in [
        ("body_geomnum", &m.body_geomnum, m.ngeom),
        ("body_jntnum", &m.body_jntnum, m.njnt),
        ("body_dofnum", &m.body_dofnum, m.nv),
    ] {
        let sum: i64 = counts.iter().map(|&n| i64::from(n)).sum();
        require(sum == total as i64, array, 0, "a part of all of them")?;
    }
    let mocaps = m.body_mocapid.iter().filter(|&&id| id >= 0);
    require(mocaps.clone().count() == m.nmocap, "nmocap", 0, "the number of mocap bodies")
}

/// Joints follow each other in positions and degrees of freedom and fill both.
fn joints(m: &Arrays) -> Result<(), Inconsistent> {
    within("jnt_bodyid", &m.jnt_bodyid, 0, m.nbody)?;
    let (mut q, mut v) = (0, 0);
    for j in 0..m.njnt {
        let at = (m.jnt_qposadr[j], m.jnt_dofadr[j]);
        require(at == (q, v), "jnt_qposadr", j, "behind the joint before")?;
        let (nq, nv) = match JointType::from_code(m.jnt_type[j]) {
            Some(JointType::Free) => (7, 6),
            Some(JointType::Ball) => (4, 3),
            Some(JointType::Slide | JointType::Hinge) => (1, 1),
            None => return require(false, "jnt_type", j, "a type of joint"),
        };
        let (body, fits) = (m.jnt_bodyid[j], (v as usize + nv as usize) <= m.nv);
        require(fits, "jnt_dofadr", j, "a range of degrees of freedom")?;
        for dof in v as usize..(v + nv) as usize {
            let belongs = m.dof_jntid[dof] as usize == j && m.dof_bodyid[dof] == body;
            require(belongs, "dof_jntid", dof, "the joint that the dof belongs to")?;
        }
        (q, v) = (q + nq, v + nv);
    }
    require(q as usize == m.nq && v as usize == m.nv, "nq", 0, "what the joints add up to")
}

/// A degree of freedom hangs on the one before it of the same body, the first on the last that moves the parent.
fn dofs(m: &Arrays) -> Result<(), Inconsistent> {
    require(m.body_jntnum[0] == 0, "body_jntnum", 0, "0 for the world")?;
    for i in 0..m.nv {
        let body = m.dof_bodyid[i] as usize;
        let first = m.body_dofadr[body] as usize == i;
        let parent = if first { last_dof(m, m.body_parentid[body] as usize) } else { i as i32 - 1 };
        let earlier = parent < i as i32 && m.dof_parentid[i] == parent;
        require(earlier, "dof_parentid", i, "what follows from the bodies")?;
        let simple = m.dof_simplenum[i];
        require(
            simple >= 0 && simple as usize <= m.nv - i,
            "dof_simplenum",
            i,
            "a number of dofs from here",
        )?;
    }
    Ok(())
}

/// A degree of freedom without one above it starts a tree.
fn trees(m: &Arrays) -> Result<(), Inconsistent> {
    let mut tree = -1;
    for i in 0..m.nv {
        let above = usize::try_from(m.dof_parentid[i]).ok();
        tree += i32::from(above.is_none());
        let same = above.is_none_or(|dof| m.dof_treeid[dof] == tree);
        require(same && m.dof_treeid[i] == tree, "dof_treeid", i, "what follows from the dofs")?;
    }
    require(m.ntree as i64 == i64::from(tree) + 1, "ntree", 0, "what follows from the dofs")?;
    let trees = Trees::of(m);
    let arrays: [(_, &[i32], _); 5] = [
        ("body_treeid", &m.body_treeid, &trees.body),
        ("tree_bodyadr", &m.tree_bodyadr, &trees.bodies.0),
        ("tree_bodynum", &m.tree_bodynum, &trees.bodies.1),
        ("tree_dofadr", &m.tree_dofadr, &trees.dofs.0),
        ("tree_dofnum", &m.tree_dofnum, &trees.dofs.1),
    ];
    for (array, is, expected) in arrays {
        require(is == expected, array, 0, "what follows from the dofs")?;
    }
    Ok(())
}

/// Leaves of the hierarchies of bodies name geoms.
fn hierarchies(m: &Arrays) -> Result<(), Inconsistent> {
    for b in (0..m.nbody).filter(|&b| m.body_bvhadr[b] >= 0) {
        let first = m.body_bvhadr[b] as usize;
        let nodes = m.body_bvhnum[b] as usize;
        require(nodes > 0, "body_bvhnum", b, "at least the root")?;
        nodes_of(m, first, nodes, m.ngeom, Inner::MayNameFormerLeaf)?;
    }
    Ok(())
}

/// What `bvh_nodeid` has for inner nodes.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Inner {
    /// -1 always.
    NamesNothing,
    /// -1, or a leaf that stood there before `fusestatic` fused bodies.
    MayNameFormerLeaf,
}

/// Nodes of one hierarchy with leaves below `leaves`: an inner node, all nodes of its left child, all of its right one.
pub(super) fn nodes_of(
    m: &Arrays,
    first: usize,
    nodes: usize,
    leaves: usize,
    inner: Inner,
) -> Result<(), Inconsistent> {
    let mut right = Vec::new();
    let mut next = Some(0);
    for n in 0..nodes {
        let ([a, b], id) = (m.bvh_child[first + n], m.bvh_nodeid[first + n]);
        require(next == Some(n as i32), "bvh_child", 2 * (first + n), "the root of a tree")?;
        let named = id >= 0 && (id as usize) < leaves;
        if [a, b] == [-1, -1] {
            require(named, "bvh_nodeid", first + n, "what a leaf bounds")?;
            next = right.pop();
        } else {
            let later = a == n as i32 + 1 && right.len() + 2 < MAX_LEVELS;
            require(later, "bvh_child", 2 * (first + n), "a later node of the tree")?;
            let may_be = id == -1 || named && inner == Inner::MayNameFormerLeaf;
            require(may_be, "bvh_nodeid", first + n, "-1, since the node has children")?;
            right.push(b);
            next = Some(a);
        }
    }
    require(next.is_none(), "bvh_child", 2 * first, "a tree as large as said")
}
