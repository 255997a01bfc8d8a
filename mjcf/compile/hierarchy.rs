//! Bounding volume hierarchies of bodies and meshes.

use super::assets::Assets;
use super::nodes::Tree;
use physics::geometry::hierarchy::{self as bvh, Bvh, Leaf};
use physics::model::Rows;

/// Bounding volume hierarchies over the geoms of each body, in its inertial frame.
pub(super) fn fill_bodies(m: &mut Rows, tree: &Tree) {
    for (id, node) in tree.bodies.iter().enumerate() {
        let first = m.body_geomadr[id];
        let leaves: Vec<Leaf> = node
            .geoms
            .iter()
            .enumerate()
            .map(|(k, g)| Leaf {
                id: first + k as i32,
                pos: g.pose.pos,
                quat: Some(g.pose.quat),
                aabb: g.aabb,
                collides: g.spec.contype != 0 || g.spec.conaffinity != 0,
            })
            .collect();
        let tree = bvh::build(&leaves, node.inertial.pos, node.inertial.quat);
        let count = tree.depth.len();
        m.body_bvhadr.push(if count == 0 { -1 } else { m.bvh_depth.len() as i32 });
        m.body_bvhnum.push(count as i32);
        append(m, &tree);
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
