//! Bounding volume hierarchies of bodies and meshes.

use super::assets::Assets;
use super::nodes::{BodyNode, GeomNode, Tree};
use physics::geometry::hierarchy::{self as bvh, Bvh, Leaf};
use physics::model::Rows;

/// Most leaves of all hierarchies that [`remember_leaves`] builds for one model: what it costs grows with the square of
/// the bodies that are fused into one.
const MOST_REMEMBERED: usize = 1 << 18;

/// Bounding volume hierarchies over the geoms of each body, in its inertial frame.
pub(super) fn fill_bodies(m: &mut Rows, tree: &Tree) {
    for (id, node) in tree.bodies.iter().enumerate() {
        let first = m.body_geomadr[id];
        let mut tree = of_body(node);
        for (index, leaf) in tree.nodeid.iter_mut().enumerate() {
            let stands_here = (*leaf >= 0).then_some(*leaf).or_else(|| former_leaf(node, index));
            *leaf = stands_here.map_or(-1, |k| first + k);
        }
        let count = tree.depth.len();
        m.body_bvhadr.push(if count == 0 { -1 } else { m.bvh_depth.len() as i32 });
        m.body_bvhnum.push(count as i32);
        append(m, &tree);
    }
}

/// The hierarchy of a body; leaves count its geoms.
fn of_body(node: &BodyNode) -> Bvh {
    let leaf = |(k, g): (usize, &GeomNode)| Leaf {
        id: k as i32,
        pos: g.pose.pos,
        quat: Some(g.pose.quat),
        aabb: g.aabb,
        collides: g.collides(),
    };
    let leaves: Vec<Leaf> = node.geoms.iter().enumerate().map(leaf).collect();
    bvh::build(&leaves, node.inertial.pos, node.inertial.quat)
}

/// Which geom of the body was the last leaf at an index of its former hierarchies.
fn former_leaf(node: &BodyNode, index: usize) -> Option<i32> {
    let former = node.former.leaves.get(index).copied().flatten()?;
    node.geoms.iter().position(|geom| std::ptr::eq(geom.spec, former)).map(|k| k as i32)
}

/// Notes the leaves of the hierarchy that a body has before or after another is fused into it.
///
/// MuJoCo builds the hierarchy of a body again with every body that is fused into it, and keeps in `bvh_nodeid` of an
/// inner node the last leaf that stood at its index. No computation reads these numbers; files and programs that compare
/// models do. They are followed up to `MOST_REMEMBERED` leaves.
pub(super) fn remember_leaves<'s>(node: &mut BodyNode<'s>, remembered: &mut usize) {
    *remembered += node.geoms.len();
    if *remembered > MOST_REMEMBERED {
        return;
    }
    let tree = of_body(node);
    let former = &mut node.former.leaves;
    former.resize(former.len().max(tree.nodeid.len()), None);
    for (entry, leaf) in former.iter_mut().zip(tree.nodeid) {
        *entry = usize::try_from(leaf).ok().map(|k| node.geoms[k].spec).or(*entry);
    }
}

/// Appends the nodes that MuJoCo counts but never fills: one for each body with a hierarchy that was fused into another
/// with one. Where flexes follow there are none, since their nodes must.
pub(super) fn fill_spare(m: &mut Rows, tree: &Tree) {
    let spare: usize = tree.bodies.iter().map(|body| body.former.spare).sum();
    for _ in 0..spare {
        m.bvh_depth.push(0);
        m.bvh_child.push([0; 2]);
        m.bvh_nodeid.push(0);
        m.bvh_aabb.push([0.0; 6]);
    }
}

/// Appends the hierarchies of meshes.
pub(super) fn fill_meshes(m: &mut Rows, assets: &Assets) {
    let nodes = assets.meshes.iter().map(|asset| asset.compiled.bvh.depth.len()).sum();
    m.bvh_depth.reserve_exact(nodes);
    m.bvh_child.reserve_exact(nodes);
    m.bvh_nodeid.reserve_exact(nodes);
    m.bvh_aabb.reserve_exact(nodes);
    for asset in &assets.meshes {
        let count = asset.compiled.bvh.depth.len();
        m.mesh_bvhadr.push(if count == 0 { -1 } else { m.bvh_depth.len() as i32 });
        m.mesh_bvhnum.push(count as i32);
        append(m, &asset.compiled.bvh);
    }
}

/// Appends the nodes of a hierarchy.
fn append(m: &mut Rows, tree: &Bvh) {
    m.bvh_depth.extend(&tree.depth);
    m.bvh_child.extend(&tree.child);
    m.bvh_nodeid.extend(&tree.nodeid);
    m.bvh_aabb.extend(&tree.aabb);
}
