//! The arrays of flexes.

use super::super::log::{Log, title};
use super::super::lookup::Lookup;
use super::super::nodes::Tree;
use super::node::FlexNode;
use crate::spec::{Elastic2d, Spec};
use physics::model::{Arrays, EqType, ObjType, Rows};

/// Appends the rows of all flexes; their hierarchies stand behind those of bodies and meshes.
pub(crate) fn fill(
    m: &mut Rows,
    flexes: &[FlexNode<'_>],
    tree: &Tree,
    spec: &Spec,
    lookup: &Lookup,
    log: &mut Log,
) {
    for node in flexes {
        let what = title("flex", &node.spec.name);
        m.flex_matid.push(lookup.reference(
            ObjType::Material,
            &node.spec.material,
            node.spec.loc,
            &what,
            log,
        ));
        m.flex_edgeequality.push(held(spec, &node.spec.name));
        contact(m, node);
        counts(m, node);
        vertices(m, node);
        edges(m, node, tree);
        elements(m, node);
        elasticity(m, node);
        hierarchy(m, node);
        warn_if_slack(m, node, log);
    }
}

/// What constraints hold: the first one that names the flex decides.
fn held(spec: &Spec, name: &str) -> i32 {
    let kind = spec.equalities.iter().filter(|e| e.name1 == name).find_map(|e| match e.kind {
        EqType::Flex => Some(1),
        EqType::Flexvert => Some(2),
        EqType::Flexstrain => Some(3),
        _ => None,
    });
    kind.unwrap_or(0)
}

fn warn_if_slack(m: &Rows, node: &FlexNode<'_>, log: &mut Log) {
    let flex = node.spec;
    let forces = [flex.edgestiffness, flex.edgedamping, flex.damping].iter().any(|&x| x != 0.0);
    if !(node.rigid || forces || m.flex_edgeequality.last() != Some(&0)) && node.bending.is_empty() {
        let what = title("flex", &flex.name);
        let message = format!("{what}: nothing holds it together, neither constraints nor passive forces");
        log.diagnostics.warning(log.sources, flex.loc, message);
    }
}

fn contact(m: &mut Rows, node: &FlexNode<'_>) {
    let flex = node.spec;
    m.flex_contype.push(flex.contype);
    m.flex_conaffinity.push(flex.conaffinity);
    m.flex_condim.push(flex.condim);
    m.flex_priority.push(flex.priority);
    m.flex_solmix.push(flex.solmix);
    m.flex_solref.push(flex.solref);
    m.flex_solimp.push(flex.solimp);
    m.flex_friction.push(flex.friction);
    m.flex_margin.push(flex.margin);
    m.flex_gap.push(flex.gap);
    m.flex_internal.push(flex.internal);
    m.flex_selfcollide.push(flex.selfcollide.code());
    m.flex_activelayers.push(flex.activelayers);
    m.flex_passive.push(flex.passive.into());
    m.flex_radius.push(flex.radius);
    m.flex_size.push(node.size);
    m.flex_group.push(flex.group);
    m.flex_rgba.push(flex.rgba);
    m.flex_flatskin.push(flex.flatskin);
}

/// The address of what is about to be appended, -1 where that is nothing.
fn address(appended: usize, so_far: usize) -> i32 {
    if appended == 0 { -1 } else { so_far as i32 }
}

fn counts(m: &mut Rows, node: &FlexNode<'_>) {
    let flex = node.spec;
    let dim = flex.dim as usize;
    m.flex_dim.push(flex.dim);
    m.flex_interp.push(if flex.elastic2d == Elastic2d::None { flex.order } else { -flex.order });
    m.flex_cellnum.push(flex.cellcount);
    m.flex_nodeadr.push(m.flex_nodebodyid.len() as i32);
    m.flex_nodenum.push(node.nodebody.len() as i32);
    m.flex_vertadr.push(m.flex_vertbodyid.len() as i32);
    m.flex_vertnum.push(node.vertices as i32);
    m.flex_edgeadr.push(m.flex_edge.len() as i32);
    m.flex_edgenum.push(node.edges.ends.len() as i32);
    m.flex_elemadr.push(m.flex_elemlayer.len() as i32);
    m.flex_elemnum.push(node.shell.layer.len() as i32);
    m.flex_elemdataadr.push(m.flex_elem.len() as i32);
    m.flex_elemedgeadr.push(m.flex_elemedge.len() as i32);
    m.flex_shellnum.push((node.shell.fragments.len() / dim) as i32);
    m.flex_shelldataadr.push(address(node.shell.fragments.len(), m.flex_shell.len()));
    m.flex_evpairadr.push(address(node.shell.pairs.len(), m.flex_evpair.len()));
    m.flex_evpairnum.push(node.shell.pairs.len() as i32);
    m.flex_rigid.push(node.rigid);
    m.flex_centered.push(node.centered);
}

fn vertices(m: &mut Rows, node: &FlexNode<'_>) {
    let flex = node.spec;
    let interpolated = !node.nodebody.is_empty();
    let place = |points: &[f64], i: usize| points.as_chunks::<3>().0.get(i).copied().unwrap_or([0.0; 3]);
    for i in 0..node.vertices {
        m.flex_vertbodyid.push(if node.rigid { node.vertbody[0] } else { node.vertbody[i] });
        m.flex_vert.push(if node.centered && !interpolated { [0.0; 3] } else { place(&flex.vert, i) });
    }
    m.flex_vert0.extend(&node.vert0);
    for (i, &body) in node.nodebody.iter().enumerate() {
        m.flex_nodebodyid.push(body);
        m.flex_node.push(if node.centered { [0.0; 3] } else { place(&flex.node, i) });
    }
    m.flex_node0.extend(&node.node0);
}

fn edges(m: &mut Rows, node: &FlexNode<'_>, tree: &Tree) {
    let bends = node.spec.dim == 2 && node.spec.elastic2d.bends();
    let welded = |v: i32| match node.vertbody[v as usize] {
        -1 => None,
        body => Some(tree.weld_root(body as usize)),
    };
    for (k, &ends) in node.edges.ends.iter().enumerate() {
        m.flex_edge.push(ends);
        m.flex_edgeflap.push(if bends { [node.flaps[k][2], node.flaps[k][3]] } else { [-1; 2] });
        let rigid = node.rigid || welded(ends[0]).is_some_and(|body| Some(body) == welded(ends[1]));
        m.flexedge_rigid.push(rigid);
    }
}

fn elements(m: &mut Rows, node: &FlexNode<'_>) {
    let flex = node.spec;
    let textured = !flex.texcoord.is_empty();
    m.flex_texcoordadr.push(if textured { m.flex_texcoord.len() as i32 } else { -1 });
    // Vertices number texture coordinates as the text has them, before tetrahedra are turned.
    m.flex_elemtexcoord.extend(match (textured, flex.elemtexcoord.is_empty()) {
        (false, _) => &node.elem,
        (true, true) => &flex.elem,
        (true, false) => &flex.elemtexcoord,
    });
    m.flex_elemtexcoord.resize(m.flex_elem.len() + node.elem.len(), 0);
    if textured {
        m.flex_texcoord.extend(flex.texcoord.as_chunks::<2>().0);
    }
    m.flex_elem.extend(&node.elem);
    m.flex_elemedge.extend(&node.edges.of_element);
    m.flex_elemlayer.extend(&node.shell.layer);
    m.flex_shell.extend(&node.shell.fragments);
    m.flex_evpair.extend(&node.shell.pairs);
}

fn elasticity(m: &mut Rows, node: &FlexNode<'_>) {
    let flex = node.spec;
    m.flex_stiffnessadr.push(address(node.stiffness.len(), m.flex_stiffness.len()));
    m.flex_stiffness.extend(&node.stiffness);
    m.flex_bendingadr.push(address(node.bending.len(), m.flex_bending.len()));
    m.flex_bending.extend(&node.bending);
    m.flex_damping.push(flex.damping);
    m.flex_edgestiffness.push(flex.edgestiffness);
    m.flex_edgedamping.push(flex.edgedamping);
}

/// The boxes of flexes move, so that only the shape of the tree is constant.
fn hierarchy(m: &mut Rows, node: &FlexNode<'_>) {
    m.flex_bvhadr.push(m.bvh_depth.len() as i32);
    m.flex_bvhnum.push(node.bvh.depth.len() as i32);
    m.bvh_depth.extend(&node.bvh.depth);
    m.bvh_child.extend(&node.bvh.child);
    m.bvh_nodeid.extend(&node.bvh.nodeid);
}

/// Sets the sizes that the arrays of flexes determine.
pub(crate) fn set_sizes(m: &mut Arrays) {
    m.nflex = m.flex_dim.len();
    m.nflexnode = m.flex_nodebodyid.len();
    m.nflexvert = m.flex_vertbodyid.len();
    m.nflexedge = m.flex_edge.len();
    m.nflexelem = m.flex_elemlayer.len();
    m.nflexelemdata = m.flex_elem.len();
    m.nflexstiffness = m.flex_stiffness.len();
    m.nflexbending = m.flex_bending.len();
    m.nflexelemedge = m.flex_elemedge.len();
    m.nflexshelldata = m.flex_shell.len();
    m.nflexevpair = m.flex_evpair.len();
    m.nflextexcoord = m.flex_texcoord.len();
}

/// Room for what `set_const` computes.
pub(crate) fn allocate_derived(m: &mut Arrays) {
    m.flex_vertedgeadr = vec![0; m.nflexvert].into();
    m.flex_vertedgenum = vec![0; m.nflexvert].into();
    m.flex_vertedge = vec![[0; 2]; m.nflexedge].into();
    m.flex_vertmetric = vec![[0.0; 4]; m.nflexvert].into();
    m.flexedge_length0 = vec![0.0; m.nflexedge].into();
    m.flexedge_invweight0 = vec![0.0; m.nflexedge].into();
    m.flexedge_J_rownnz = vec![0; m.nflexedge].into();
    m.flexedge_J_rowadr = vec![0; m.nflexedge].into();
    m.flexedge_J_colind = vec![0; m.nJfe].into();
    m.flexvert_J_rownnz = vec![[0; 2]; m.nflexvert].into();
    m.flexvert_J_rowadr = vec![[0; 2]; m.nflexvert].into();
    m.flexvert_J_colind = vec![[0; 2]; m.nJfv].into();
    m.efm0_dofid = vec![0; m.nefm0dof].into();
    m.efm0_L_rownnz = vec![0; m.nefm0dof].into();
    m.efm0_L_rowadr = vec![0; m.nefm0dof].into();
    m.efm0_L_colind = vec![0; m.nefm0L].into();
    m.efm0_L = vec![0.0; m.nefm0L].into();
}
