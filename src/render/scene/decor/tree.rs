//! Bounding volume trees, and the lattices of nodes of interpolated flexes, which are shown with them.

use crate::scene::item::Shape;
use crate::scene::options::is_visible;
use crate::scene::sink::{Form, GREY, Items, Source, UPRIGHT, unnamed};
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

/// Adds the boxes of each body's hierarchy: a leaf in the frame of its geom, an inner node in the body's inertial frame.
pub(super) fn of_bodies(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
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

/// Width of the lines of lattices \[pixel\].
const LINE: f64 = 3.0;

/// Adds the boxes of visible flexes, and all their lattices.
pub(super) fn of_flexes(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
    if !options.show.mesh_trees {
        return;
    }
    for flex in 0..m.nflex {
        let first = m.flex_bvhadr[flex].max(0) as usize;
        let count =
            if is_visible(&options.groups.flexes, m.flex_group[flex]) { m.flex_bvhnum[flex] } else { 0 };
        for node in (first..first + count as usize).filter(|&node| is_shown(from, node)) {
            let aabb = &d.flex.bvh_aabb_dyn[node - m.nbvhstatic];
            add_box(from, node, aabb, ([0.0; 3], &UPRIGHT), items);
        }
        if m.flex_interp[flex] != 0 {
            lattice(from, flex, items);
        }
    }
}

/// Adds lines between neighbouring nodes that can move; of a shell, between those at its surface.
fn lattice(from: Source<'_>, flex: usize, items: &mut Items<'_>) {
    let (m, kin) = (from.m, &from.d.kin);
    let (first, order) = (m.flex_nodeadr[flex] as usize, m.flex_interp[flex].unsigned_abs() as usize);
    let size = m.flex_cellnum[flex].map(|cells| cells as usize * order + 1);
    let number = |[i, j, k]: [usize; 3]| first + (i * size[1] + j) * size[2] + k;
    let body = |at: [usize; 3]| m.flex_nodebodyid[number(at)] as usize;
    let is_drawn = |at: [usize; 3]| {
        let inside = (0..3).all(|axis| at[axis] > 0 && at[axis] + 1 < size[axis]);
        m.body_jntnum[body(at)] > 0 && !(m.flex_interp[flex] < 0 && inside)
    };
    let place = |at: [usize; 3]| match m.flex_centered[flex] {
        true => kin.xpos[body(at)],
        false => add(mul_mat_vec(&kin.xmat[body(at)], m.flex_node[number(at)]), kin.xpos[body(at)]),
    };
    for i in 0..size[0] {
        for j in 0..size[1] {
            for at in (0..size[2]).map(|k| [i, j, k]).filter(|&at| is_drawn(at)) {
                for axis in 0..3 {
                    let mut next = at;
                    next[axis] += 1;
                    if next[axis] < size[axis] && is_drawn(next) {
                        let line = Form::connector(Shape::Line, LINE, place(at), place(next));
                        items.decor(&line, GREY, unnamed(i));
                    }
                }
            }
        }
    }
}

/// Adds the boxes of the meshes of all geoms.
pub(super) fn of_meshes(from: Source<'_>, items: &mut Items<'_>) {
    let Source { m, d, options, .. } = from;
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
