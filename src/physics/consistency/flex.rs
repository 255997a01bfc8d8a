//! Flexes: their parts lie in the arrays, and refer to each other.

use super::requirement::{Inconsistent, ranges, references, require, spans, within};
use super::tree::{Inner, nodes_of};
use crate::arrays::{Arrays, FlexSelf};
use crate::constants::flex_pattern::Patterns;
use crate::constants::{bending_factor, flex_pattern};

pub(super) fn check(m: &Arrays) -> Result<(), Inconsistent> {
    ranges! { m:
        flex_nodeadr flex_nodenum m.nflexnode;
        flex_vertadr flex_vertnum m.nflexvert;
        flex_edgeadr flex_edgenum m.nflexedge;
        flex_elemadr flex_elemnum m.nflexelem;
        flex_evpairadr flex_evpairnum m.nflexevpair;
        flex_bvhadr flex_bvhnum m.nbvh;
    }
    references! { m:
        flex_matid -1 m.nmat;
        flex_nodebodyid 0 m.nbody;
        flex_vertbodyid -1 m.nbody;
        flex_texcoordadr -1 m.nflextexcoord;
        flex_stiffnessadr -1 m.nflexstiffness;
        flex_bendingadr -1 m.nflexbending;
        efm0_dofid 0 m.nv;
    }
    for f in 0..m.nflex {
        let dim = m.flex_dim[f];
        require((1..=3).contains(&dim), "flex_dim", f, "1, 2 or 3")?;
        let known = FlexSelf::from_code(m.flex_selfcollide[f]).is_some();
        require(known, "flex_selfcollide", f, "a kind of self-collision")?;
        require(m.flex_radius[f] >= 0.0, "flex_radius", f, "zero or positive")?;
        require(m.flex_vertnum[f] > 0 && m.flex_elemnum[f] > 0, "flex_elemnum", f, "positive")?;
    }
    let corners = |f: usize| i64::from(m.flex_elemnum[f]) * i64::from(m.flex_dim[f] + 1);
    let sides = |f: usize| i64::from(m.flex_elemnum[f]) * [1, 3, 6][m.flex_dim[f] as usize - 1];
    let shell = |f: usize| i64::from(m.flex_shellnum[f]) * i64::from(m.flex_dim[f]);
    spans("flex_elemdataadr", &m.flex_elemdataadr, corners, m.nflexelemdata)?;
    spans("flex_elemedgeadr", &m.flex_elemedgeadr, sides, m.nflexelemedge)?;
    spans("flex_shelldataadr", &m.flex_shelldataadr, shell, m.nflexshelldata)?;
    (0..m.nflex).try_for_each(|f| parts(m, f))?;
    derived(m)
}

/// Vertices, edges and elements of one flex.
fn parts(m: &Arrays, f: usize) -> Result<(), Inconsistent> {
    let range = |first: i32, count: i64| first.max(0) as usize..first.max(0) as usize + count as usize;
    let inside = |values: &[i32], least: i32, end: i32| values.iter().all(|&x| (least..end).contains(&x));
    let (dim, vertices) = (m.flex_dim[f], m.flex_vertnum[f]);
    let elements = i64::from(m.flex_elemnum[f]);
    let corners = range(m.flex_elemdataadr[f], elements * i64::from(dim + 1));
    require(inside(&m.flex_elem[corners], 0, vertices), "flex_elem", f, "vertices of the flex")?;
    let of_elements = range(m.flex_elemedgeadr[f], elements * [1, 3, 6][dim as usize - 1]);
    let known = inside(&m.flex_elemedge[of_elements], 0, m.flex_edgenum[f]);
    require(known, "flex_elemedge", f, "edges of the flex")?;
    let shell = range(m.flex_shelldataadr[f], i64::from(m.flex_shellnum[f]) * i64::from(dim));
    require(inside(&m.flex_shell[shell], 0, vertices), "flex_shell", f, "vertices of the flex")?;
    let edges = range(m.flex_edgeadr[f], m.flex_edgenum[f].into());
    let ends = m.flex_edge[edges.clone()].as_flattened();
    require(inside(ends, 0, vertices), "flex_edge", f, "vertices of the flex")?;
    let flaps = m.flex_edgeflap[edges.clone()].as_flattened();
    require(inside(flaps, -1, vertices), "flex_edgeflap", f, "vertices of the flex")?;
    for &[element, vertex] in &m.flex_evpair[range(m.flex_evpairadr[f], m.flex_evpairnum[f].into())] {
        let known = inside(&[element], 0, m.flex_elemnum[f]) && inside(&[vertex], 0, vertices);
        require(known, "flex_evpair", f, "an element and a vertex of the flex")?;
    }
    if let Ok(first) = usize::try_from(m.flex_bvhadr[f]) {
        let nodes = m.flex_bvhnum[f] as usize;
        require(nodes > 0 && first >= m.nbvhstatic, "flex_bvhadr", f, "behind the boxes that stand still")?;
        nodes_of(m, first, nodes, m.flex_elemnum[f] as usize, Inner::NamesNothing)?;
    }
    bodies(m, f)?;
    numbers(m, f, edges.len())
}

/// Vertices are fixed to bodies, or nodes are.
fn bodies(m: &Arrays, f: usize) -> Result<(), Inconsistent> {
    let first = m.flex_vertadr[f] as usize;
    let vertices = &m.flex_vertbodyid[first..first + m.flex_vertnum[f] as usize];
    let order = i64::from(m.flex_interp[f]).abs();
    if order == 0 {
        return require(vertices.iter().all(|&b| b >= 0), "flex_vertbodyid", f, "a body");
    }
    let cells = m.flex_cellnum[f];
    let positive = order <= 2 && cells.iter().all(|&c| c > 0);
    require(positive, "flex_cellnum", f, "positive, of order 1 or 2")?;
    let nodes = cells.iter().try_fold(1_i64, |n, &c| n.checked_mul(i64::from(c) * order + 1));
    require(nodes == Some(m.flex_nodenum[f].into()), "flex_nodenum", f, "the nodes of its cells")
}

/// Stiffness and bending are as long as what they belong to.
fn numbers(m: &Arrays, f: usize, edges: usize) -> Result<(), Inconsistent> {
    let order = m.flex_interp[f].unsigned_abs() as usize;
    let [cx, cy, cz] = m.flex_cellnum[f].map(|c| c.max(0) as usize);
    let stiffness = match m.flex_interp[f] {
        0 => 21 * m.flex_elemnum[f] as usize,
        1.. => (cx * cy * cz).saturating_mul((3 * (order + 1).pow(3)).pow(2)),
        _ => (2 * (cy * cz + cx * cz + cx * cy)).saturating_mul((3 * (order + 1).pow(2)).pow(2)),
    };
    if let Ok(first) = usize::try_from(m.flex_stiffnessadr[f]) {
        let fits = stiffness <= m.nflexstiffness.saturating_sub(first);
        require(fits, "flex_stiffnessadr", f, "the address of a stiffness")?;
    }
    if let Ok(first) = usize::try_from(m.flex_bendingadr[f]) {
        let pairs = m.flex_bending.get(first).copied().unwrap_or(0.0);
        let length = if order == 0 {
            17 * edges
        } else {
            (pairs.max(0.0) as usize).saturating_mul(10).saturating_add(1)
        };
        let fits = length <= m.nflexbending.saturating_sub(first);
        require(fits, "flex_bendingadr", f, "the address of a bending stiffness")?;
    }
    Ok(())
}

/// What `set_const` computes from the rest.
fn derived(m: &Arrays) -> Result<(), Inconsistent> {
    let mut sized = m.clone();
    flex_pattern::set_sizes(&mut sized);
    require(sized.nJfe == m.nJfe, "nJfe", 0, "what follows from the edges")?;
    require(sized.nJfv == m.nJfv, "nJfv", 0, "what follows from the edges")?;
    bending_factor::set_sizes(&mut sized);
    require(sized.nefm0dof == m.nefm0dof, "nefm0dof", 0, "what follows from the bending stiffness")?;
    require(sized.nefm0L == m.nefm0L, "nefm0L", 0, "what follows from the bending stiffness")?;
    if m.nflex == 0 {
        return Ok(());
    }
    require(bending_factor::is_laid_out(m), "efm0_L_colind", 0, "what follows from the bending stiffness")?;
    require(Patterns::of(m).is_in(m), "flexedge_J_rowadr", 0, "what follows from the edges")
}
