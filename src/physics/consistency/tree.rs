//! Bodies, joints, degrees of freedom and trees.

use super::{Inconsistent, ranges, references, require, spans, within};
use crate::model::{JointType, Model};

pub(super) fn check(m: &Model) -> Result<(), Inconsistent> {
    references! { m:
        body_rootid 0 m.nbody;
        body_weldid 0 m.nbody;
        body_mocapid -1 m.nmocap;
        body_treeid -1 m.ntree;
        dof_bodyid 0 m.nbody;
        dof_jntid 0 m.njnt;
        dof_treeid 0 m.ntree;
    }
    ranges! { m:
        body_jntadr body_jntnum m.njnt;
        body_dofadr body_dofnum m.nv;
        body_geomadr body_geomnum m.ngeom;
        body_bvhadr body_bvhnum m.nbvh;
        tree_bodyadr tree_bodynum m.nbody;
        tree_dofadr tree_dofnum m.nv;
    }
    bodies(m)?;
    joints(m)?;
    dofs(m)?;
    hierarchies(m)
}

/// Parents come before children; elements of a body say so too.
fn bodies(m: &Model) -> Result<(), Inconsistent> {
    for b in 0..m.nbody {
        let before = |id: i32| id >= 0 && (id as usize) < b.max(1);
        require(before(m.body_parentid[b]), "body_parentid", b, "an earlier body")?;
        let up_to = |id: i32| id as usize <= b;
        require(up_to(m.body_rootid[b]), "body_rootid", b, "the body or an earlier one")?;
        require(up_to(m.body_weldid[b]), "body_weldid", b, "the body or an earlier one")?;
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
fn joints(m: &Model) -> Result<(), Inconsistent> {
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

fn dofs(m: &Model) -> Result<(), Inconsistent> {
    for i in 0..m.nv {
        let parent = m.dof_parentid[i];
        require(parent >= -1 && parent < i as i32, "dof_parentid", i, "an earlier dof")?;
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

/// Children stand behind their parents and inside their tree; leaves of bodies name geoms.
fn hierarchies(m: &Model) -> Result<(), Inconsistent> {
    for b in (0..m.nbody).filter(|&b| m.body_bvhadr[b] >= 0) {
        let first = m.body_bvhadr[b] as usize;
        let nodes = m.body_bvhnum[b] as usize;
        require(nodes > 0, "body_bvhnum", b, "at least the root")?;
        nodes_of(m, first, nodes, m.ngeom)?;
    }
    Ok(())
}

/// Nodes of one hierarchy with leaves below `leaves`.
pub(super) fn nodes_of(m: &Model, first: usize, nodes: usize, leaves: usize) -> Result<(), Inconsistent> {
    for n in 0..nodes {
        let [a, b] = m.bvh_child[first + n];
        let behind = |c: i32| c == -1 || (c as usize > n && (c as usize) < nodes && c >= 0);
        require(behind(a) && behind(b), "bvh_child", 2 * (first + n), "a later node of the tree")?;
        let leaf = m.bvh_nodeid[first + n];
        let names = leaf >= 0 && (leaf as usize) < leaves;
        require(names || [a, b] != [-1, -1], "bvh_nodeid", first + n, "what a leaf bounds")?;
    }
    Ok(())
}
