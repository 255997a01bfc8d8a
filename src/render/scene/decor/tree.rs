//! Bounding volume trees.

use crate::scene::item::Shape;
use crate::scene::sink::{Form, Items, Source, unnamed};
use physics::math::{Mat3, Vec3, add, mul_mat_vec};
use physics::model::GeomType;

/// True for the nodes at the chosen depth, and for leaves above it.
fn is_shown(from: Source<'_>, node: usize) -> bool {
    let (depth, wanted) = (from.m.bvh_depth[node], from.options.tree_depth);
    depth == wanted || is_leaf(from, node) && depth < wanted
}

fn is_leaf(from: Source<'_>, node: usize) -> bool {
    from.m.bvh_child[node] == [-1, -1]
}

/// Adds the edges of a box that is given by centre and half sizes in a frame.
fn add_box(from: Source<'_>, node: usize, aabb: &[f64; 6], frame: (Vec3, &Mat3), items: &mut Items<'_>) {
    let [x, y, z, a, b, c] = *aabb;
    let (pos, mat) = frame;
    let pos = add(mul_mat_vec(mat, [x, y, z]), pos);
    let form = Form { shape: Shape::LineBox, size: [a, b, c], pos, mat: *mat };
    items.decor(&form, from.m.vis.rgba.bv, unnamed(node));
}

/// Adds the boxes of bodies: those of geoms at the leaves, else in the inertial frame.
pub(super) fn of_bodies(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options } = from;
    if !options.show.body_trees {
        return;
    }
    for body in 0..m.nbody {
        let first = m.body_bvhadr[body].max(0) as usize;
        for node in (first..first + m.body_bvhnum[body] as usize).filter(|&node| is_shown(from, node)) {
            if is_leaf(from, node) {
                let geom = m.bvh_nodeid[node] as usize;
                let frame = (d.kin.geom_xpos[geom], &d.kin.geom_xmat[geom]);
                add_box(from, node, &m.geom_aabb[geom], frame, items);
            } else {
                add_box(from, node, &m.bvh_aabb[node], (d.kin.xipos[body], &d.kin.ximat[body]), items);
            }
        }
    }
}

/// Adds the boxes of the meshes of all geoms.
pub(super) fn of_meshes(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options } = from;
    if !options.show.mesh_trees {
        return;
    }
    for geom in 0..m.ngeom {
        let Ok(mesh) = usize::try_from(m.geom_dataid[geom]) else { continue };
        if m.geom_type[geom] == GeomType::Hfield.code() || m.geom_type[geom] == GeomType::Sdf.code() {
            continue;
        }
        let first = m.mesh_bvhadr[mesh].max(0) as usize;
        for node in (first..first + m.mesh_bvhnum[mesh] as usize).filter(|&node| is_shown(from, node)) {
            let frame = (d.kin.geom_xpos[geom], &d.kin.geom_xmat[geom]);
            add_box(from, node, &m.bvh_aabb[node], frame, items);
        }
    }
}
